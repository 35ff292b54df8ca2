# SPDX-License-Identifier: BSD-3-Clause
"""Bags of any kind: topics, and messages in the order of recording."""

import mmap
import re
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from lego_loam_sc import mcap, rosbag1, sqlite_bag
from lego_loam_sc.chunked import Connection, Item, Message, Tally, take_messages, take_overview
from lego_loam_sc.compression import ZSTD_MAGIC, unpack
from lego_loam_sc.errors import InputError, Report

_SUFFIXES = (".mcap", ".db3")  # of the files in the folder of a ROS 2 bag, perhaps with .zstd


class _File(Protocol):
    def overview(self) -> dict[Connection, Tally]: ...

    def messages(self, ids: set[int]) -> Iterator[Message]: ...


@dataclass
class Topic:
    """What a bag holds of one name and type."""

    name: str
    type: str
    tally: Tally

    @property
    def rate(self) -> float:
        """Messages per second."""
        seconds = (self.tally.last_ns - self.tally.first_ns) * 1e-9
        return (self.tally.count - 1) / seconds if seconds > 0 else 0.0


class Bag:
    """A ROS 1 bag, an MCAP or SQLite file, or the folder of a ROS 2 bag; close it after use.

    Faults of it are reported and reading goes on with what is whole. Raises InputError when it is
    no bag.
    """

    def __init__(self, path: Path, report: Report):
        self.path = path
        self._stack = ExitStack()
        self._files: list[tuple[_File, list[Connection]]] = []
        tallies: dict[tuple[str, str], Tally] = {}
        for file in _open_all(path, report, self._stack):
            overview = file.overview()
            self._files.append((file, list(overview)))
            for connection, tally in overview.items():
                total = tallies.setdefault((connection.topic, connection.type), Tally())
                if tally.count:
                    total.add(tally.count, tally.first_ns, tally.last_ns)
        self.topics = [Topic(*key, tally) for key, tally in sorted(tallies.items())]

    def __enter__(self) -> "Bag":
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def messages(self, topic: Topic) -> Iterator[tuple[str, Message]]:
        """Encoding and message of each message of `topic`."""
        for file, connections in self._files:
            encodings = {
                connection.id: connection.encoding
                for connection in connections
                if (connection.topic, connection.type) == (topic.name, topic.type)
            }
            if encodings:
                for message in file.messages(set(encodings)):
                    yield encodings[message.id], message


class _ChunkedFile:
    def __init__(self, walk: Callable[[], Iterable[Item]]):
        self._walk = walk

    def overview(self) -> dict[Connection, Tally]:
        return take_overview(self._walk())

    def messages(self, ids: set[int]) -> Iterator[Message]:
        return take_messages(self._walk(), ids)


def _open_all(path: Path, report: Report, stack: ExitStack) -> Iterator[_File]:
    if not path.is_dir():
        yield _open_file(path, lambda sentence: report(f"{path}: {sentence}"), stack)
        return
    files = sorted(filter(is_part_of_bag, path.iterdir()), key=_natural_key)
    if not files:
        raise InputError(f"{path} holds no {' or '.join(_SUFFIXES)} files, so it is no bag")
    for name in _missing_files(path, files):
        report(f"{path / name} is listed in metadata.yaml and is not there; the others are read")
    for file in files:
        try:
            yield _open_file(file, lambda sentence, file=file: report(f"{file}: {sentence}"), stack)
        except InputError as error:
            report(str(error))


def is_part_of_bag(path: Path) -> bool:
    """True for the files that the folder of a ROS 2 bag keeps messages in."""
    return path.name.removesuffix(".zstd").endswith(_SUFFIXES)


def _missing_files(folder: Path, files: list[Path]) -> list[str]:
    """What metadata.yaml lists beyond `files`."""
    metadata = folder / "metadata.yaml"
    if not metadata.exists():
        return []
    listed = re.findall(r"^\s*- (\S+)$", metadata.read_text(errors="replace"), re.MULTILINE)
    names = {Path(entry.strip("\"'")).name for entry in listed if is_part_of_bag(Path(entry))}
    return sorted(names - {file.name for file in files})


def _natural_key(path: Path) -> list[tuple[int, str]]:
    """bag_9.mcap stands before bag_10.mcap."""
    parts = re.split(r"(\d+)", path.name)
    return [(int(part), "") if part.isdigit() else (-1, part) for part in parts]


def _open_file(path: Path, report: Report, stack: ExitStack, packed: bool = True) -> _File:
    """`packed`: it may be compressed as a whole."""
    try:
        with path.open("rb") as file:
            magic = file.read(16)
            if not magic:
                raise InputError(f"{path} is empty")
            if packed and magic.startswith(ZSTD_MAGIC):
                return _open_file(_unpack(path, report, stack), report, stack, packed=False)
            if magic == sqlite_bag.MAGIC:
                return sqlite_bag.SqliteBag(path, report, stack)
            for kind in (rosbag1, mcap):
                if magic.startswith(kind.MAGIC):
                    data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
                    return _ChunkedFile(partial(kind.walk, data, report))
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error
    raise InputError(f"{path} is no ROS bag, MCAP file, SQLite bag or capture, or damaged at once")


def _unpack(path: Path, report: Report, stack: ExitStack) -> Path:
    """A bag that is compressed as one file, as a file of its own for the time of reading."""
    folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="lego-loam-sc-"))
    unpacked = Path(folder) / path.stem
    with path.open("rb") as packed, unpacked.open("wb") as out:
        try:
            for piece in unpack(packed):
                out.write(piece)
        except InputError as error:
            report(f"{error}; all complete messages are read")
        if not out.tell():
            raise InputError(f"{path} is cut off or damaged at its beginning")
    return unpacked
