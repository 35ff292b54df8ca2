# SPDX-License-Identifier: BSD-3-Clause
"""ROS 2 bags in SQLite (rosbag2_storage_sqlite3)."""

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from urllib.parse import quote

import apsw  # hands out the last good row before an error, which the standard sqlite3 does not

from lego_loam_sc.chunked import Connection, Message, Tally
from lego_loam_sc.errors import InputError, Report

MAGIC = b"SQLite format 3\0"  # 16 bytes

# SQLite does not hold columns to their types, and damage may change them.
_TOPICS = """
    SELECT id, CAST(name AS BLOB), CAST(type AS BLOB), CAST(serialization_format AS BLOB)
    FROM topics"""
_TIMES = """
    SELECT topic_id, timestamp FROM messages
    WHERE typeof(topic_id) = 'integer' AND typeof(timestamp) = 'integer' ORDER BY id"""
_MESSAGES = """
    SELECT id, topic_id, timestamp, data FROM messages
    WHERE topic_id IN ({}) AND id > ? AND typeof(topic_id) = 'integer'
      AND typeof(timestamp) = 'integer' AND typeof(data) = 'blob' ORDER BY id"""

_TABLES = """
    CREATE TABLE IF NOT EXISTS topics(id INTEGER PRIMARY KEY, name, type, serialization_format);
    CREATE TABLE IF NOT EXISTS messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);"""
# Rows whose table is unknown, because the page that lists the pages of the table is lost. Of the
# tables of a bag only messages has four columns with a blob in the last; its id is the row id.
_LOST_MESSAGES = """
    INSERT OR IGNORE INTO messages(id, topic_id, timestamp, data)
    SELECT id, c1, c2, c3 FROM lost_and_found WHERE nfield = 4 AND typeof(c3) = 'blob'"""


class SqliteBag:
    """One .db3 file. Messages come in the order of recording; of a damaged file those that SQLite's
    own `.recover` finds, which needs the command sqlite3 and room for a copy until `stack` is
    closed."""

    def __init__(self, path: Path, report: Report, stack: ExitStack):
        self._path = path
        self._report = report
        self._stack = stack
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
            return self._overview()
        except apsw.Error as error:
            self._recover(error)
        try:
            return self._overview()
        except apsw.Error as error:
            raise InputError(f"{self._path} is no SQLite bag: {error}") from error

    def messages(self, ids: set[int]) -> Iterator[Message]:
        """The messages of the topics `ids`."""
        query = _MESSAGES.format(", ".join(map(str, sorted(ids))))
        last = -1
        try:
            for row_id, *message in self._database.execute(query, (last,)):
                last = row_id
                yield Message(*message)
        except apsw.Error as error:
            self._recover(error)
            for _, *message in self._database.execute(query, (last,)):
                yield Message(*message)

    def _overview(self) -> dict[Connection, Tally]:
        tallies: dict[int, Tally] = {}
        for topic, time_ns in self._database.execute(_TIMES):
            tallies.setdefault(topic, Tally()).add(1, time_ns, time_ns)
        return {
            Connection(number, *(str(text, errors="replace") for text in texts)): tallies.get(
                number, Tally()
            )
            for number, *texts in self._database.execute(_TOPICS)
        }

    def _recover(self, error: apsw.Error) -> None:
        """Goes on with a copy of what can be recovered, for the time of reading."""
        folder = self._stack.enter_context(tempfile.TemporaryDirectory(prefix="lego-loam-sc-"))
        copy = Path(folder) / "recovered.db3"
        recovered = _copy_what_is_whole(self._path, copy)
        what = "all messages that SQLite recovers are read"
        if not recovered:
            what = "install the command sqlite3, 3.41 or later, to recover the rest"
        reason = " ".join(str(error).split())  # it may quote what is damaged
        self._report(f"it is cut off or damaged ({reason}); {what}")
        self._database = apsw.Connection(str(copy))
        self._database.execute(_TABLES)
        try:
            self._database.execute(_LOST_MESSAGES)
        except apsw.SQLError:
            pass  # nothing was lost and found


def _copy_what_is_whole(path: Path, copy: Path) -> bool:
    """False when the command sqlite3 is missing or cannot recover. `-safe` because the file may be
    anybody's: no command that it holds reaches beyond the copy."""
    shell = shutil.which("sqlite3")
    if shell is None:
        return False
    safe = [shell, "-init", "/dev/null", "-batch", "-safe"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    recover = [*safe, "-readonly", str(path.absolute()), ".recover"]
    with subprocess.Popen(recover, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as source:
        subprocess.run([*safe, str(copy)], stdin=source.stdout, check=False, **quiet)
    return source.returncode == 0
