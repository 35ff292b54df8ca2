# SPDX-License-Identifier: BSD-3-Clause
"""What ROS 1 bags and MCAP files have in common: records in the order of recording.

Both hold chunks of messages, each chunk followed by an index of it. They are read from the front
and never through the index at the end of the file, so that a file which was cut off or never closed
is read like any other.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple


class Connection(NamedTuple):
    """Declares what the messages of `id` are."""

    id: int
    topic: str
    type: str  # as ROS 2 writes it: sensor_msgs/msg/PointCloud2
    encoding: str  # cdr or ros1, or another


class Message(NamedTuple):
    """One message in its encoding."""

    id: int
    time_ns: int  # of recording
    data: bytes | memoryview


class Index(NamedTuple):
    """Stands behind a chunk that holds `count` messages of `id`."""

    id: int
    count: int
    first_ns: int
    last_ns: int


class Chunk(NamedTuple):
    """Connections and messages, not yet decompressed."""

    open: Callable[[], Iterator["Item"]]


Item = Connection | Message | Index | Chunk


class CutOffError(Exception):
    """The data ends within a record."""


class DamagedError(Exception):
    """A record is invalid. The message is a clause without a full stop."""


@dataclass
class Tally:
    """How many messages a connection has, and when."""

    count: int = 0
    first_ns: int = 0
    last_ns: int = 0

    def add(self, count: int, first_ns: int, last_ns: int) -> None:
        """Adds `count` (not 0) messages."""
        self.first_ns = min(self.first_ns, first_ns) if self.count else first_ns
        self.last_ns = max(self.last_ns, last_ns) if self.count else last_ns
        self.count += count


def ros2_name(type_name: str) -> str:
    """The name of a message type as ROS 2 writes it."""
    package, _, name = type_name.rpartition("/")
    return type_name if not package or package.endswith("/msg") else f"{package}/msg/{name}"


def take_overview(items: Iterable[Item]) -> dict[Connection, Tally]:
    """Counts the messages of a file; decompresses only what has no index."""
    connections: dict[int, Connection] = {}
    tallies: dict[int, Tally] = {}
    samples: dict[int, Chunk] = {}  # a chunk that declares the connection, if nothing else does

    def take(item: Item) -> None:
        if isinstance(item, Connection):
            connections[item.id] = item
        elif isinstance(item, Message):
            tallies.setdefault(item.id, Tally()).add(1, item.time_ns, item.time_ns)

    for item, index in _with_index(items):
        if isinstance(item, Chunk) and not index:
            for inner in item.open():
                take(inner)
        elif isinstance(item, Chunk):
            for entry in index.values():
                tallies.setdefault(entry.id, Tally()).add(entry.count, *entry[2:])
                samples.setdefault(entry.id, item)
        else:
            take(item)
    for number, chunk in samples.items():
        if number not in connections:
            for inner in chunk.open():
                if isinstance(inner, Connection):
                    take(inner)
    return {connection: tallies.get(number, Tally()) for number, connection in connections.items()}


def take_messages(items: Iterable[Item], ids: set[int]) -> Iterator[Message]:
    """The messages of the connections `ids` in the order of recording."""
    for item, index in _with_index(items):
        if isinstance(item, Chunk):
            if not index or ids & index.keys():
                yield from take_messages(item.open(), ids)
        elif isinstance(item, Message) and item.id in ids:
            yield item


def _with_index(items: Iterable[Item]) -> Iterator[tuple[Item, dict[int, Index]]]:
    """Every item but indexes, a chunk together with its index."""
    chunk: Chunk | None = None
    index: dict[int, Index] = {}
    for item in items:
        if isinstance(item, Index):
            if item.count:
                index[item.id] = item
            continue
        if chunk:
            yield chunk, index
        chunk, index = None, {}
        if isinstance(item, Chunk):
            chunk = item
        else:
            yield item, {}
    if chunk:
        yield chunk, index
