# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong with an input, and how it is told."""

import sys
from collections.abc import Callable

Report = Callable[[str], None]  # takes a fault as one sentence; reading goes on behind it


class InputError(Exception):
    """An input cannot be used. One sentence: what, where and what to change."""


class Faults:
    """Tells the first faults of an input, as they come and each once, and counts all."""

    TOLD = 5

    def __init__(self) -> None:
        self._seen: set[str] = set()

    def __call__(self, sentence: str) -> None:
        if sentence not in self._seen and len(self._seen) < self.TOLD:
            say(sentence)
        self._seen.add(sentence)

    def __bool__(self) -> bool:
        return bool(self._seen)

    def finish(self) -> None:
        """Tells how many were not told one by one."""
        if len(self._seen) > self.TOLD:
            say(f"and {len(self._seen) - self.TOLD} faults more of this input")


def say(sentence: str) -> None:
    """One line on standard error; standard output is for scans."""
    print(f"lego-loam-sc-read: {sentence}", file=sys.stderr, flush=True)
