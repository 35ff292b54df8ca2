# SPDX-License-Identifier: BSD-3-Clause
"""Whole bags of every kind, and which of their topics is read."""

import numpy as np
import pytest

from made_bags import (
    KINDS,
    Messages,
    stamp_of,
    storage_file,
    sweep,
    write_bag,
    write_sweeps,
)


def assert_sweeps(scans, numbers):
    assert [scan.stamp_ns for scan in scans] == [stamp_of(number) for number in numbers]
    for scan, number in zip(scans, numbers, strict=True):
        expected = sweep(number)
        for axis, name in enumerate("xyz"):
            np.testing.assert_array_equal(scan.points[:, axis], expected[name])
        np.testing.assert_array_equal(scan.intensity, expected["intensity"])
        np.testing.assert_array_equal(scan.ring, expected["ring"])
        np.testing.assert_allclose(scan.offset_ns, expected["time"] * 1e9, atol=1)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_bag_gives_the_scans_that_were_written(tmp_path, read, kind):
    outcome = read(write_sweeps(tmp_path, kind, 12))
    assert outcome.exit_code == 0
    assert_sweeps(outcome.scans, range(12))


@pytest.mark.parametrize("kind", ["mcap", "mcap_chunks", "sqlite", "sqlite_file"])
def test_the_file_of_a_ros_2_bag_is_read_without_its_folder(tmp_path, read, kind):
    outcome = read(storage_file(write_sweeps(tmp_path, kind, 3)))
    assert outcome.exit_code == 0
    assert_sweeps(outcome.scans, range(3))


@pytest.mark.parametrize("kind", ["ros1_lz4", "mcap_chunks", "sqlite"])
def test_the_only_cloud_among_other_topics_is_taken_and_described(tmp_path, read, kind):
    make = Messages(kind.startswith("ros1"))

    def messages():
        yield "/tf_static", stamp_of(0), make.static_transform("base", "lidar", 1.25, np.pi / 2)
        for k in range(5):
            yield "/chatter", stamp_of(k), make.text("hello")
            yield "/points", stamp_of(k), make.cloud(stamp_of(k), sweep(k))

    outcome = read(write_bag(tmp_path, kind, messages()))
    assert outcome.exit_code == 0
    assert_sweeps(outcome.scans, range(5))
    said = "\n".join(outcome.messages)
    assert "static transform base to lidar: x 1.250 y 0.000 z 0.500 m" in said
    assert "yaw 90.00 degrees" in said
    assert "/points: 5 messages at 10.0 Hz, frame lidar, 200 points, fields x float32" in said
    assert (
        "field time: seconds relative to the stamp of the scan; a sweep runs from 0.0 to 99.0"
        in said
    )
    assert read(tmp_path / outcome_name(kind), "--quiet").messages == []


def outcome_name(kind):
    return f"{kind}.bag" if kind.startswith("ros1") else kind


@pytest.fixture(params=["ros1", "mcap"])
def two_lidars(tmp_path, request):
    make = Messages(request.param == "ros1")

    def messages():
        for k in range(4):
            yield "/left/points", stamp_of(k), make.cloud(stamp_of(k), sweep(k))
            yield "/note", stamp_of(k), make.text("hello")
            if k % 2 == 0:
                yield "/right/points", stamp_of(k), make.cloud(stamp_of(k), sweep(k + 50, 30))

    return write_bag(tmp_path, request.param, messages())


def test_several_clouds_are_listed_as_flags_to_paste(two_lidars, read):
    outcome = read(two_lidars)
    assert (outcome.exit_code, outcome.scans) == (1, [])
    said = "\n".join(outcome.messages)
    assert "--topic /left/points   4 messages at 10.0 Hz, 200 points" in said
    assert "--topic /right/points   2 messages at 5.0 Hz, 30 points" in said
    assert "/note" not in said


def test_the_topic_that_is_asked_for_is_read(two_lidars, read):
    outcome = read(two_lidars, "--topic", "/left/points")
    assert outcome.exit_code == 0
    assert_sweeps(outcome.scans, range(4))


@pytest.mark.parametrize(
    ("topic", "words"),
    [("/note", "/note holds std_msgs/msg/String"), ("/middle", "/middle is not there")],
)
def test_a_topic_that_is_no_cloud_is_refused_with_those_that_are(two_lidars, read, topic, words):
    outcome = read(two_lidars, "--topic", topic)
    assert (outcome.exit_code, outcome.scans) == (1, [])
    said = "\n".join(outcome.messages)
    assert words in said and "--topic /left/points" in said


def test_the_list_of_topics_goes_to_standard_output(two_lidars, read):
    outcome = read(two_lidars, "--list")
    assert outcome.exit_code == 0
    assert [line.split()[1] for line in outcome.text.splitlines()] == [
        "/left/points",
        "/right/points",
    ]


def test_first_and_count_choose_scans(tmp_path, read):
    bag = write_sweeps(tmp_path, "mcap_chunks", 8)
    assert_sweeps(read(bag, "--first", "3", "--count", "2").scans, [3, 4])
    assert read(bag, "--first", "8").scans == []


def test_a_bag_without_clouds_says_what_it_holds_and_why_that_does_not_do(tmp_path, read):
    make = Messages(False)
    messages = [("/livox/lidar", 1, make.custom()), ("/chatter", 2, make.text("hello"))]
    outcome = read(write_bag(tmp_path, "mcap", messages))
    assert (outcome.exit_code, outcome.scans) == (1, [])
    (sentence,) = outcome.messages
    assert "Livox's own message, of sensors that do not scan in rings" in sentence
    assert "/chatter (std_msgs/msg/String)" in sentence


def test_a_topic_with_messages_of_two_types_gives_its_clouds(tmp_path, read):
    make = Messages(True)
    messages = [
        ("/points", stamp_of(0), make.text("warming up")),
        ("/points", stamp_of(1), make.cloud(stamp_of(1), sweep(1))),
    ]
    outcome = read(write_bag(tmp_path, "ros1", messages))
    assert outcome.exit_code == 0
    assert_sweeps(outcome.scans, [1])


def test_the_parts_of_a_split_bag_are_read_in_the_order_of_their_numbers(tmp_path, read):
    make = Messages(False)
    split = tmp_path / "split"
    split.mkdir()
    for part in range(11):
        folder = tmp_path / str(part)
        folder.mkdir()
        cloud = make.cloud(stamp_of(part), sweep(part))
        bag = write_bag(folder, "mcap", [("/points", stamp_of(part), cloud)])
        storage_file(bag).rename(split / f"split_{part}.mcap")
    outcome = read(split)
    assert outcome.exit_code == 0
    assert_sweeps(outcome.scans, range(11))


def test_a_part_that_metadata_lists_and_that_is_gone_is_told(tmp_path, read):
    bag = write_sweeps(tmp_path, "sqlite", 3)
    metadata = bag / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("- sqlite.db3", "- sqlite.db3\n  - b_1.db3"))
    outcome = read(bag, "--quiet")
    assert outcome.exit_code == 1
    assert_sweeps(outcome.scans, range(3))
    (sentence,) = outcome.messages
    assert "b_1.db3" in sentence


def test_a_bag_without_stamps_gets_the_times_of_recording(tmp_path, read):
    make = Messages(False)
    messages = [("/points", stamp_of(k), make.cloud(0, sweep(k))) for k in range(3)]
    outcome = read(write_bag(tmp_path, "mcap", messages))
    assert outcome.stamps() == [stamp_of(k) for k in range(3)]
    assert sum("has no stamps" in message for message in outcome.messages) == 1


def test_dataset_yaml_beside_the_bag_travels_in_the_stream(tmp_path, read):
    bag = write_sweeps(tmp_path, "ros1", 2)
    (tmp_path / "dataset.yaml").write_text("sensor: vlp16\npoint_times: none\n")
    outcome = read(bag)
    assert outcome.facts == "sensor: vlp16\npoint_times: none\n"
    assert all(scan.offset_ns is None for scan in outcome.scans)
    (tmp_path / "dataset.yaml").write_text("point_times: minutes\n")
    refused = read(bag)
    assert refused.exit_code == 1
    assert "s, ms, us, ns or none" in refused.messages[0]


def test_what_is_no_recording_is_refused_in_one_sentence(tmp_path, read):
    (tmp_path / "text.bag").write_text("this is no bag")
    (tmp_path / "empty.mcap").write_bytes(b"")
    (tmp_path / "folder").mkdir()
    for name, words in (
        ("text.bag", "is no ROS bag"),
        ("empty.mcap", "is empty"),
        ("folder", "so it is no bag"),
        ("nowhere.bag", "cannot be read"),
    ):
        outcome = read(tmp_path / name)
        assert outcome.exit_code == 1 and outcome.scans == []
        (sentence,) = outcome.messages
        assert words in sentence and name in sentence


def test_reading_leaves_nothing_beside_a_bag(tmp_path, read):
    bag = write_sweeps(tmp_path, "sqlite", 2)
    before = sorted(tmp_path.rglob("*"))
    assert_sweeps(read(bag).scans, range(2))
    assert sorted(tmp_path.rglob("*")) == before
