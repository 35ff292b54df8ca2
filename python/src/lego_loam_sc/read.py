# SPDX-License-Identifier: BSD-3-Clause
"""lego-loam-sc-read: a recording in, a scan stream out."""

import argparse
import os
import re
import signal
import sys
from collections.abc import Callable, Iterator
from importlib.metadata import version
from itertools import chain, islice
from pathlib import Path

import numpy as np

from lego_loam_sc import bag_scans, capture, point_times
from lego_loam_sc.bag import Bag
from lego_loam_sc.errors import Faults, InputError, Report, say
from lego_loam_sc.point_cloud import RawScan
from lego_loam_sc.scan_stream import Scan, ScanStreamWriter

_UNIT_SCANS = 10  # the first ones may be too short to show the unit of time
_LONGEST_FACTS = 65536  # bytes, of a scan stream

Note = Callable[[str], None]


def main(arguments: list[str] | None = None) -> int:
    """The program. Returns 0, or 1 when anything of the input could not be read."""
    options = _parse(arguments)
    faults = Faults()
    try:
        if options.list:
            _list(options.input, faults)
        else:
            _stream(options, faults)
    except InputError as error:
        faults(str(error))
    except BrokenPipeError:  # the reader of the stream has closed it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    faults.finish()
    return 1 if faults else 0


def _parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="lego-loam-sc-read",
        description="Writes the scans of a recording to standard output as a scan stream.",
    )
    parser.add_argument(
        "input",
        metavar="INPUT",
        type=Path,
        help="ROS 1 .bag, ROS 2 folder, .mcap, .db3 or Velodyne .pcap",
    )
    parser.add_argument("--topic", help="topic to read, when several hold PointCloud2")
    parser.add_argument("--list", action="store_true", help="print the topics, write no scans")
    parser.add_argument("--first", type=_number, default=0, help="first scan to write, from 0")
    parser.add_argument("--count", type=_number, help="number of scans to write")
    parser.add_argument("--quiet", action="store_true", help="print faults only")
    parser.add_argument("--version", action="version", version=version("lego-loam-sc"))
    return parser.parse_args(arguments)


def _number(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text} is no number of scans")
    return int(text)


def _list(path: Path, faults: Faults) -> None:
    if _is_capture(path):
        raise InputError(f"{path} is a capture, it has no topics; leave --list out")
    with Bag(path, faults) as bag:
        print("\n".join(bag_scans.describe_bag(bag)))


def _stream(options: argparse.Namespace, faults: Faults) -> None:
    if sys.stdout.isatty():
        raise InputError("a scan stream is binary; pipe it into: lego-loam-sc run -")
    facts = _read_facts(options.input)
    note: Note = (lambda sentence: None) if options.quiet else say
    writer = ScanStreamWriter(sys.stdout.buffer, facts)
    unit = _asked_unit(facts)
    interrupted = _catch_interrupts()
    for scan in islice(_read_scans(options, unit, faults, note), options.count):
        writer.write(scan)
        if interrupted():
            break
    sys.stdout.buffer.flush()


def _read_scans(
    options: argparse.Namespace, unit: str | None, faults: Faults, note: Note
) -> Iterator[Scan]:
    path, first = options.input, options.first
    if _is_capture(path):
        if options.topic:
            raise InputError(f"{path} is a capture, it has no topics; leave --topic out")
        raws = islice(capture.read_scans(path, faults), first, None)
        yield from _with_times(raws, path, unit, faults, note)
        return
    with Bag(path, faults) as bag:
        if not bag.topics and faults:
            return  # the fault is the reason
        topic = bag_scans.choose_topic(bag, options.topic)
        for sentence in bag_scans.static_transforms(bag):
            note(sentence)
        raws = bag_scans.read_topic(bag, topic, first, faults, note)
        yield from _with_times(raws, path, unit, faults, note)


def _is_capture(path: Path) -> bool:
    if path.is_dir():
        return False
    try:
        with path.open("rb") as file:
            return capture.is_capture(file.read(4))
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error


def _read_facts(path: Path) -> str:
    """What dataset.yaml in the folder of a ROS 2 bag, or beside a file, says."""
    file = (path if path.is_dir() else path.parent) / "dataset.yaml"
    if not file.exists():
        return ""
    if file.stat().st_size > _LONGEST_FACTS:
        raise InputError(f"{file} is longer than {_LONGEST_FACTS} bytes")
    return file.read_text(errors="replace")


def _asked_unit(facts: str) -> str | None:
    """The unit of time that the facts name; None when they name none."""
    match = re.search(r"^point_times:\s*(\S+)", facts, re.MULTILINE)
    if not match:
        return None
    if match[1] not in (*point_times.UNITS_NS, "none"):
        raise InputError(
            f"point_times is {match[1]} in dataset.yaml, it must be s, ms, us, ns or none"
        )
    return match[1]


def _with_times(
    raws: Iterator[RawScan], path: Path, unit: str | None, report: Report, note: Note
) -> Iterator[Scan]:
    """The scans with the times of their points. Raises InputError when these make no sense."""
    head = list(islice(raws, _UNIT_SCANS))
    if unit != "none":
        unit = _decide_unit(head, path, unit, note)
    stray_noted = False
    for raw in chain(head, raws):
        scan = Scan(raw.stamp_ns, raw.points, raw.intensity, raw.ring)
        try:
            if raw.times is not None and unit in point_times.UNITS_NS:
                times = point_times.interpret(raw.times, raw.returned(), raw.stamp_ns, unit)
                scan.offset_ns = times.offset_ns if times else None
                if times and times.stray.any():
                    scan.points = np.where(times.stray[:, None], np.float32(np.nan), scan.points)
                    if not stray_noted:
                        note(
                            f"the scan at {raw.stamp_ns} ns: {np.count_nonzero(times.stray)} "
                            "points are left out, their times are far outside of the sweep; so "
                            "are those of further scans"
                        )
                    stray_noted = True
        except InputError as error:
            report(f"the scan at {raw.stamp_ns} ns is left out: {error}")
            continue
        yield scan


def _decide_unit(head: list[RawScan], path: Path, unit: str | None, note: Note) -> str | None:
    """The unit that the first scan with times shows; one driver wrote all scans."""
    undecided = None
    equal = None
    for raw in head:
        try:
            if raw.times is None:
                continue
            times = point_times.interpret(raw.times, raw.returned(), raw.stamp_ns, unit)
        except InputError as error:
            undecided = undecided or InputError(f"{path}: field {raw.time_field}: {error}")
            continue
        if times:
            note(f"field {raw.time_field}: {times.decision}")
            return times.unit
        equal = equal or raw.time_field
    if undecided:
        raise undecided
    if head:
        why = f": field {equal} is the same for all of them" if equal else ""
        note(f"the points have no times{why}")
    return None


def _catch_interrupts() -> Callable[[], bool]:
    """Ends the stream after a complete scan; a second signal ends the program at once."""
    caught = []

    def catch(number: int, _: object) -> None:
        caught.append(number)
        signal.signal(number, signal.SIG_DFL)

    for number in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, catch)
    return lambda: bool(caught)


if __name__ == "__main__":
    sys.exit(main())
