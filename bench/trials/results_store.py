# SPDX-License-Identifier: BSD-3-Clause
"""Records of finished runs, one JSON object a line, appended by several processes at once."""

import json
import os


class Store:
    """The last line for a pair of drive and system counts."""

    def __init__(self, path):
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)

    def add(self, record):
        """One write to a file opened for appending, so that lines of others are not torn."""
        line = (json.dumps(record) + "\n").encode()
        file = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            os.write(file, line)
        finally:
            os.close(file)

    def all(self):
        """Every whole record, the oldest first; a line that was cut off is passed over."""
        if not self.path.is_file():
            return []
        records = []
        for line in self.path.read_text().splitlines():
            try:
                records.append(json.loads(line))
            except json.JSONDecodeError:
                continue
        return records
