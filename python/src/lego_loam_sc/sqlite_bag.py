# SPDX-License-Identifier: BSD-3-Clause
"""ROS 2 bags in SQLite (rosbag2_storage_sqlite3)."""

import mmap
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import apsw  # hands out the last good row before an error, which the standard sqlite3 does not

from lego_loam_sc.chunked import Connection, Message, Tally
from lego_loam_sc.errors import Report
from lego_loam_sc.sqlite_pages import find_rows

MAGIC = b"SQLite format 3\0"  # 16 bytes

_TOPICS = "SELECT id, name, type, serialization_format FROM topics"
_TIMES = "SELECT id, topic_id, timestamp FROM messages ORDER BY id"
_MESSAGES = "SELECT id, topic_id, timestamp, data FROM messages WHERE topic_id IN ({}) ORDER BY id"

_DAMAGE = (apsw.Error, UnicodeDecodeError)


class SqliteBag:
    """One .db3 file. Messages come in the order of recording; of a damaged file those left."""

    def __init__(self, path: Path, report: Report):
        self._path = path
        self._report = report
        # Without a log of changes beside it, the file is read as it lies: its folder may be
        # read-only.
        as_it_lies = "" if Path(f"{path}-wal").exists() else "&immutable=1"
        self._database = apsw.Connection(
            f"file:{quote(str(path))}?mode=ro{as_it_lies}",
            flags=apsw.SQLITE_OPEN_READONLY | apsw.SQLITE_OPEN_URI,
        )

    def overview(self) -> dict[Connection, Tally]:
        """All topics, and how many messages they have."""
        try:
            topics = list(self._database.execute(_TOPICS))
            times = list(self._database.execute(_TIMES))
        except _DAMAGE as error:
            self._report_damage(error)
            topics = [
                (row_id, *columns[1:4]) for row_id, columns in self._left() if _is_topic(columns)
            ]
            times = [(row_id, *row[1:3]) for row_id, row in self._left() if _is_message(row)]
        tallies: dict[int, Tally] = {}
        for _, topic, time_ns in times:
            if isinstance(time_ns, int):  # SQLite does not hold columns to their types
                tallies.setdefault(topic, Tally()).add(1, time_ns, time_ns)
        return {
            Connection(number, *map(str, rest)): tallies.get(number, Tally())
            for number, *rest in topics
        }

    def messages(self, ids: set[int]) -> Iterator[Message]:
        """The messages of the topics `ids`."""
        last = -1
        try:
            query = _MESSAGES.format(", ".join(map(str, sorted(ids))))
            for row_id, *row in self._database.execute(query):
                last = row_id
                if _is_message([None, *row]):
                    yield Message(*row)
        except _DAMAGE as error:
            self._report_damage(error)
            for row_id, columns in self._left():
                if row_id > last and _is_message(columns) and columns[1] in ids:
                    yield Message(*columns[1:])

    def _report_damage(self, error: Exception) -> None:
        self._report(f"it is cut off or damaged ({error}); all that is whole is read")

    def _left(self) -> Iterator[tuple[int, list[Any]]]:
        with self._path.open("rb") as file:
            data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        return find_rows(data)


def _is_topic(columns: list[Any]) -> bool:
    """id (which stands in the row id), name, type, serialization format, and more."""
    texts = columns[1:4]
    return len(texts) == 3 and all(isinstance(text, str) for text in texts) and texts[0][:1] == "/"


def _is_message(columns: list[Any]) -> bool:
    """id (which stands in the row id), topic, time, data."""
    kinds = [type(column) for column in columns[1:]]
    return kinds == [int, int, bytes]
