#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that each room of the source tree includes only the rooms below it.

usage: include_graph.py [SOURCE_FOLDER]

Prints file, line and include of each violation and exits with 1 when there is one.
"""

import re
import sys
from pathlib import Path

# The rooms that the headers and sources of a room may include, besides its own. Data flows
# downwards; odometry, mapping and loop are siblings that do not know each other.
ALLOWED = {
    "core": [],
    "sensor": ["core"],
    "segmentation": ["core", "sensor"],
    "features": ["core", "segmentation"],
    "registration": ["core", "features"],
    "map": ["core", "features", "registration"],
    "odometry": ["core", "features", "registration"],
    "mapping": ["core", "features", "registration", "map"],
    "key_frames": ["core", "segmentation", "features", "registration", "map"],
    "graph": ["core", "registration"],
    "tracking": ["core", "segmentation", "features", "registration", "map", "odometry", "mapping",
                 "key_frames"],
    "loop": ["core", "features", "registration", "map", "key_frames", "graph"],
    "slam": ["core", "segmentation", "features", "registration", "map", "odometry", "mapping",
             "tracking", "key_frames", "loop", "graph"],
    "io": ["core", "sensor"],
    "eval": ["core", "io"],
    "sim": ["core", "io"],
}  # fmt: skip

# Single headers that a room may include besides.
ALLOWED_HEADERS = {
    "io": ["slam/settings.hpp"],  # settings_yaml reads and writes all settings
}

# The command line stands on top of everything.
UNRESTRICTED = {"app"}

INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')


def violations(room: str, file: Path) -> list[str]:
    allowed = [room, *ALLOWED[room]]
    found = []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match or match[1] in ALLOWED_HEADERS.get(room, []):
            continue
        if match[1].split("/")[0] not in allowed:
            found.append(
                f"{file}:{number}: {room}/ may not include {match[1]}; "
                f"allowed are {', '.join(allowed)}"
            )
    return found


def main() -> int:
    source = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent)
    folders = [f for f in sorted((source / "src").iterdir()) if f.is_dir()] + [source / "sim"]
    messages = []
    for folder in folders:
        if folder.name in UNRESTRICTED:
            continue
        if folder.name not in ALLOWED:
            messages.append(f"{folder}: add this room to ALLOWED in {Path(__file__).name}")
            continue
        for file in sorted([*folder.glob("*.hpp"), *folder.glob("*.cpp")]):
            messages += violations(folder.name, file)
    print("\n".join(messages) or "every room includes only rooms below it")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
