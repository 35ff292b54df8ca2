# SPDX-License-Identifier: BSD-3-Clause
"""MCAP files (mcap.dev/spec)."""

import struct
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple
from zlib import crc32

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

MAGIC = b"\x89MCAP0\r\n"

_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _MESSAGE_INDEX = 2, 3, 4, 5, 6, 7
_LAST_STANDARD = 0x0F


class _Record(NamedTuple):
    at: int  # byte
    op: int
    data: memoryview
    missing: int  # bytes of the data that are cut off


def walk(data: memoryview, report: Report) -> Iterator[Item]:
    """The records of the file `data`, up to its end or its first fault."""
    schemas: dict[int, str] = {}
    try:
        for record in _records(data, len(MAGIC)):
            if record.op == _CHUNK:
                yield Chunk(partial(_open_chunk, record, schemas, report))
            if record.missing:
                raise CutOffError
            if record.op == _FOOTER:
                if data[record.at + 9 + len(record.data) :] != MAGIC:
                    raise CutOffError
                return
            if record.op == _MESSAGE_INDEX:
                yield from _read_index(record)
            else:
                yield from _read_item(record, schemas)
        raise CutOffError
    except CutOffError:
        report(
            f"it is cut off at byte {len(data)} or was never closed, it has no index; all complete "
            "messages are read"
        )
    except DamagedError as error:
        report(f"{error}; all messages before it are read")


def _open_chunk(record: _Record, schemas: dict[int, str], report: Report) -> Iterator[Item]:
    try:
        fields = _Fields(record)
        _, _, size, checksum = fields.take("<QQQI")
        kind = fields.take_text()
        (compressed,) = fields.take("<Q")
        content = memoryview(decompress(kind, fields.rest()[:compressed], size))
        if not record.missing:
            if len(content) != size:
                raise DamagedError(f"it has {len(content)} of {size} bytes")
            if checksum and crc32(content) != checksum:
                raise DamagedError("its checksum is wrong")
        for inner in _records(content, 0):
            if inner.missing:
                raise CutOffError
            yield from _read_item(inner, schemas)
    except CutOffError:
        if not record.missing:  # otherwise walk() reports it
            report(f"the chunk at byte {record.at} is shorter than it says")
    except (InputError, DamagedError) as error:
        report(f"the chunk at byte {record.at} is left out: {error}")


def _records(data: memoryview, at: int) -> Iterator[_Record]:
    while at < len(data):
        if at + 9 > len(data):
            raise CutOffError
        op = data[at]
        end = at + 9 + int.from_bytes(data[at + 1 : at + 9], "little")
        if op == 0 or _LAST_STANDARD < op < 0x80:
            raise DamagedError(f"there is no record at byte {at}")
        yield _Record(at, op, data[at + 9 : end], max(0, end - len(data)))
        at = end


class _Fields:
    """Takes the fields of a record one after the other."""

    def __init__(self, record: _Record):
        self._record = record
        self._at = 0

    def take(self, layout: str) -> tuple[int, ...]:
        begin, self._at = self._at, self._at + struct.calcsize(layout)
        if self._at > len(self._record.data):
            self._fail()
        return struct.unpack_from(layout, self._record.data, begin)

    def take_text(self) -> str:
        (length,) = self.take("<I")
        begin, self._at = self._at, self._at + length
        if self._at > len(self._record.data):
            self._fail()
        return bytes(self._record.data[begin : self._at]).decode(errors="replace")

    def rest(self) -> memoryview:
        return self._record.data[self._at :]

    def _fail(self) -> None:
        if self._record.missing:
            raise CutOffError
        raise DamagedError(f"the record at byte {self._record.at} is too short")


def _read_item(record: _Record, schemas: dict[int, str]) -> Iterator[Connection | Message]:
    fields = _Fields(record)
    if record.op == _SCHEMA:
        (number,) = fields.take("<H")
        schemas[number] = fields.take_text()
    elif record.op == _CHANNEL:
        number, schema = fields.take("<HH")
        topic, encoding = fields.take_text(), fields.take_text()
        yield Connection(number, topic, ros2_name(schemas.get(schema, "unknown")), encoding)
    elif record.op == _MESSAGE:
        number, _, log_time, _ = fields.take("<HIQQ")
        yield Message(number, log_time, fields.rest())


def _read_index(record: _Record) -> Iterator[Index]:
    """Time and place in the chunk of each message."""
    fields = _Fields(record)
    (number, length) = fields.take("<HI")
    entries = fields.rest()[: length // 16 * 16]
    times = [time for time, _ in struct.iter_unpack("<QQ", entries[: len(entries) // 16 * 16])]
    if times:
        yield Index(number, len(times), min(times), max(times))
