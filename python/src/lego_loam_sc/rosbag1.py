# SPDX-License-Identifier: BSD-3-Clause
"""ROS 1 bags, format 2.0 (wiki.ros.org/Bags/Format/2.0)."""

import struct
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

from lego_loam_sc.chunked import (
    Chunk,
    Connection,
    CutOffError,
    DamagedError,
    Index,
    Item,
    Message,
    ros2_name,
)
from lego_loam_sc.compression import decompress
from lego_loam_sc.errors import InputError, Report

MAGIC = b"#ROSBAG V2.0\n"

_MESSAGE, _FILE_HEADER, _INDEX, _CHUNK, _CHUNK_INFO, _CONNECTION = 2, 3, 4, 5, 6, 7


class _Record(NamedTuple):
    at: int  # byte
    header: dict[bytes, bytes]
    data: memoryview
    missing: int  # bytes of the data that are cut off

    def number(self, field: bytes) -> int:
        """An integer of the header."""
        if field not in self.header:
            raise DamagedError(f"the record at byte {self.at} has no field {field.decode()}")
        return int.from_bytes(self.header[field], "little")

    def time_ns(self) -> int:
        """The field `time`: seconds and nanoseconds."""
        time = self.number(b"time")
        return (time & 0xFFFFFFFF) * 1_000_000_000 + (time >> 32)


def walk(data: memoryview, report: Report) -> Iterator[Item]:
    """The records of the bag `data`, up to its end or its first fault."""
    index_at = chunks = infos = 0
    try:
        for record in _records(data, len(MAGIC)):
            op = record.number(b"op")
            if op == _CHUNK:
                yield Chunk(partial(_open_chunk, record, report))
            if record.missing:
                raise CutOffError
            if op == _FILE_HEADER:
                index_at = record.number(b"index_pos")
                chunks = record.number(b"chunk_count")
            elif op == _INDEX:
                yield from _read_index(record)
            elif op == _CHUNK_INFO:
                infos += 1
            elif op in (_CONNECTION, _MESSAGE):
                yield _read_item(op, record)
        if index_at == 0:
            report(
                "the recording was never closed, it has no index; all complete messages are read"
            )
        elif infos < chunks:
            raise CutOffError
    except CutOffError:
        report(f"it is cut off at byte {len(data)}; all complete messages are read")
    except DamagedError as error:
        report(f"{error}; all messages before it are read")


def _open_chunk(record: _Record, report: Report) -> Iterator[Item]:
    try:
        kind = record.header.get(b"compression", b"").decode("ascii", "replace")
        content = memoryview(decompress(kind, record.data, record.number(b"size")))
        for inner in _records(content, 0):
            op = inner.number(b"op")
            if inner.missing:
                raise CutOffError
            if op in (_CONNECTION, _MESSAGE):
                yield _read_item(op, inner)
    except CutOffError:
        if not record.missing:  # otherwise walk() reports it
            report(f"the chunk at byte {record.at} is shorter than it says")
    except (InputError, DamagedError) as error:
        report(f"the chunk at byte {record.at} is damaged: {error}; the others are read")


def _records(data: memoryview, at: int) -> Iterator[_Record]:
    while at < len(data):
        header_at = at + 4
        data_at = header_at + _u32(data, at) + 4
        if data_at > len(data):
            raise CutOffError
        end = data_at + _u32(data, data_at - 4)
        header = _read_fields(data[header_at : data_at - 4], at)
        yield _Record(at, header, data[data_at:end], max(0, end - len(data)))
        at = end


def _read_fields(data: memoryview, record_at: int) -> dict[bytes, bytes]:
    fields = {}
    at = 0
    while at + 4 <= len(data):
        end = at + 4 + _u32(data, at)
        name, equals, value = bytes(data[at + 4 : end]).partition(b"=")
        if not equals or end > len(data):
            raise DamagedError(f"there is no record at byte {record_at}")
        fields[name] = value
        at = end
    return fields


def _read_item(op: int, record: _Record) -> Connection | Message:
    number = record.number(b"conn")
    if op == _MESSAGE:
        return Message(number, record.time_ns(), record.data)
    type_name = _read_fields(record.data, record.at).get(b"type", b"")
    return Connection(
        number,
        record.header.get(b"topic", b"").decode(errors="replace"),
        ros2_name(type_name.decode(errors="replace")),
        "ros1",
    )


def _read_index(record: _Record) -> Iterator[Index]:
    """Index version 1: seconds, nanoseconds and place in the chunk of each message."""
    if record.number(b"ver") != 1:
        return
    usable = len(record.data) // 12 * 12
    times = [
        seconds * 1_000_000_000 + nanoseconds
        for seconds, nanoseconds, _ in struct.iter_unpack("<III", record.data[:usable])
    ]
    if times:
        yield Index(record.number(b"conn"), len(times), min(times), max(times))


def _u32(data: memoryview, at: int) -> int:
    if at + 4 > len(data):
        raise CutOffError
    return int.from_bytes(data[at : at + 4], "little")
