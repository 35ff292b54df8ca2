# SPDX-License-Identifier: BSD-3-Clause
"""The rows that are left in a damaged SQLite file (sqlite.org/fileformat2.html).

SQLite finds rows through a tree whose root stands at the front of the file and points to pages that
were written later: when the end of the file is missing, rows at its front may be out of reach. Here
every page that holds rows is looked at by itself.
"""

from collections.abc import Iterator
from typing import Any

_LEAF = 0x0D  # a page with rows of a table
_FILE_HEADER = 100  # bytes, on the first page
_INTEGER_SIZES = {1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8}
_CONSTANTS = {0: None, 8: 0, 9: 1}


def find_rows(data: memoryview) -> Iterator[tuple[int, list[Any]]]:
    """Row id and columns of every whole row of any table, in the order of row ids."""
    size = int.from_bytes(data[16:18], "big")
    size = 65536 if size == 1 else size
    if size < 512:
        return
    usable = size - data[20]
    cells = []
    for page_at in range(0, len(data) - size + 1, size):
        cells.extend(_find_cells(data, page_at, size))
    for row_id, length, at in sorted(cells):
        payload = _join(data, at, length, size, usable)
        columns = _read_columns(payload) if payload else None
        if columns is not None:
            yield row_id, columns


def _find_cells(data: memoryview, page_at: int, size: int) -> Iterator[tuple[int, int, int]]:
    """Row id, length and place of the payload of each row on a page."""
    page = data[page_at : page_at + size]
    header = _FILE_HEADER if page_at == 0 else 0
    if page[header] != _LEAF:
        return
    count = int.from_bytes(page[header + 3 : header + 5], "big")
    for k in range(min(count, size // 4)):
        pointer = header + 8 + 2 * k
        at = int.from_bytes(page[pointer : pointer + 2], "big")
        length, at = _read_varint(page, at)
        row_id, at = _read_varint(page, at)
        if 0 < length <= len(data):
            yield row_id, length, page_at + at


def _join(data: memoryview, at: int, length: int, size: int, usable: int) -> bytes | None:
    """The payload of a row: the beginning on its own page, the rest in a chain of others."""
    local = length
    if length > usable - 35:
        least = (usable - 12) * 32 // 255 - 23
        local = least + (length - least) % (usable - 4)
        local = local if local <= usable - 35 else least
    parts = [data[at : at + local]]
    missing = length - local
    link = at + local
    while missing:
        number = int.from_bytes(data[link : link + 4], "big")
        link = (number - 1) * size
        part = data[link + 4 : link + min(usable, 4 + missing)] if number else b""
        if len(part) != min(usable - 4, missing):
            return None
        parts.append(part)
        missing -= len(part)
    return b"".join(parts)


def _read_columns(record: bytes) -> list[Any] | None:
    """Integers, texts and blobs of a record; None when it contradicts itself."""
    end, at = _read_varint(record, 0)
    place = end
    columns: list[Any] = []
    while at < end <= len(record):
        kind, at = _read_varint(record, at)
        if kind in _CONSTANTS:
            columns.append(_CONSTANTS[kind])
            continue
        length = _INTEGER_SIZES.get(kind, 8 if kind == 7 else (kind - 12) // 2)
        value = record[place : place + length]
        place += length
        if kind in _INTEGER_SIZES:
            columns.append(int.from_bytes(value, "big", signed=True))
        elif kind >= 13 and kind % 2:
            columns.append(value.decode(errors="replace"))
        else:
            columns.append(value)
    return columns if place == len(record) else None


def _read_varint(data: bytes | memoryview, at: int) -> tuple[int, int]:
    """A number of at most 9 bytes and the place behind it; 0 beyond the end."""
    value = 0
    for k, byte in enumerate(bytes(data[at : at + 9])):
        if k == 8:
            return value << 8 | byte, at + 9
        value = value << 7 | byte & 0x7F
        if byte < 0x80:
            return value, at + k + 1
    return 0, len(data)
