# SPDX-License-Identifier: BSD-3-Clause
"""The scans of a bag: which topic, and its messages as scans."""

from collections.abc import Callable, Iterator
from itertools import islice

from lego_loam_sc.bag import Bag, Topic
from lego_loam_sc.errors import InputError, Report
from lego_loam_sc.messages import (
    POINT_CLOUD,
    TRANSFORMS,
    decode,
    describe_transforms,
    stamp_ns,
)
from lego_loam_sc.point_cloud import RawScan, describe, pick_fields, view_cloud

_MOST_TRANSFORM_MESSAGES = 50  # they stand at the beginning or are repeated

_REASONS = {
    "CustomMsg": "Livox's own message, of sensors that do not scan in rings",
    "VelodyneScan": "raw packets; record the driver's points, or give a .pcap",
    "PandarScan": "raw packets; record the driver's points",
    "RslidarPacket": "raw packets; record the driver's points",
    "PacketMsg": "raw packets; record the driver's points",
}


def choose_topic(bag: Bag, asked: str | None) -> Topic:
    """The topic `asked` for or the only one of PointCloud2.

    Raises InputError, with what there is, when that does not decide.
    """
    clouds = _clouds(bag)
    named = [topic for topic in clouds if topic.name == asked]
    if asked and not named:
        others = [topic.type for topic in bag.topics if topic.name == asked]
        what = f"holds {others[0]}" if others else "is not there"
        raise InputError(f"{bag.path}: the topic {asked} {what}; {_describe_choice(bag)}")
    if not clouds or (not asked and len(clouds) > 1):
        raise InputError(f"{bag.path}: {_describe_choice(bag)}")
    return named[0] if asked else clouds[0]


def describe_bag(bag: Bag) -> list[str]:
    """A line for each topic of PointCloud2 and each static transform.

    Raises InputError, with what there is, when there are no such topics.
    """
    clouds = _clouds(bag)
    if not clouds:
        raise InputError(f"{bag.path}: {_describe_choice(bag)}")
    return [*(_describe_topic(bag, topic) for topic in clouds), *static_transforms(bag)]


def static_transforms(bag: Bag) -> list[str]:
    """A sentence for each transform on the topics named tf_static."""
    sentences: dict[str, None] = {}  # in order, each once
    for topic in bag.topics:
        if topic.type != TRANSFORMS or topic.name.rsplit("/", 1)[-1] != "tf_static":
            continue
        for encoding, message in islice(bag.messages(topic), _MOST_TRANSFORM_MESSAGES):
            try:
                transforms = decode(TRANSFORMS, encoding, message.data)
            except InputError:
                continue  # they are printed for information only
            sentences.update(dict.fromkeys(describe_transforms(transforms)))
    return list(sentences)


def read_topic(
    bag: Bag, topic: Topic, first: int, report: Report, note: Callable[[str], None]
) -> Iterator[RawScan]:
    """The scans of a topic from number `first` on; what is wrong with one is reported."""
    stampless = False
    for number, (encoding, message) in enumerate(islice(bag.messages(topic), first, None), first):
        try:
            decoded = decode(POINT_CLOUD, encoding, message.data)
            cloud = view_cloud(decoded)
            scan = pick_fields(cloud, stamp_ns(decoded.header))
        except InputError as error:
            report(f"message {number} of {topic.name} is left out: {error}")
            continue
        if number == first:
            note(
                f"{topic.name}: {_describe_tally(topic)}, frame {decoded.header.frame_id}, "
                f"{describe(cloud)}"
            )
        if scan.stamp_ns == 0 != message.time_ns:
            scan.stamp_ns = message.time_ns
            if not stampless:
                note(f"{topic.name} has no stamps: the times of recording are used instead")
            stampless = True
        yield scan


def _clouds(bag: Bag) -> list[Topic]:
    clouds = [topic for topic in bag.topics if topic.type == POINT_CLOUD]
    return [topic for topic in clouds if topic.tally.count] or clouds


def _describe_tally(topic: Topic) -> str:
    return f"{topic.tally.count} messages at {topic.rate:.1f} Hz"


def _describe_topic(bag: Bag, topic: Topic) -> str:
    try:
        encoding, message = next(bag.messages(topic))
        points = describe(view_cloud(decode(POINT_CLOUD, encoding, message.data)))
    except (StopIteration, InputError):
        points = "the first message cannot be read"
    return f"--topic {topic.name}   {_describe_tally(topic)}, {points}"


def _describe_choice(bag: Bag) -> str:
    lines = [_describe_topic(bag, topic) for topic in _clouds(bag)]
    if lines:
        return "choose one of its PointCloud2 topics:\n  " + "\n  ".join(lines)
    others = ", ".join(_describe_other(topic) for topic in bag.topics) or "no topics at all"
    return f"it holds no {POINT_CLOUD} messages, but {others}"


def _describe_other(topic: Topic) -> str:
    reason = _REASONS.get(topic.type.rsplit("/", 1)[-1])
    return f"{topic.name} ({topic.type}{': ' + reason if reason else ''})"
