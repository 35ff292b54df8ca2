# SPDX-License-Identifier: BSD-3-Clause
"""Faults of an input, and how they are reported."""

import sys
from collections.abc import Callable

Report = Callable[[str], None]  # takes a fault as one sentence; reading goes on after it


class InputError(Exception):
    """An input cannot be used. One sentence: what, where and what to change."""


class Faults:
    """Prints the first faults of an input as they occur, each once, and counts all."""

    PRINTED = 5

    def __init__(self) -> None:
        self._seen: set[str] = set()

    def __call__(self, sentence: str) -> None:
        if sentence not in self._seen and len(self._seen) < self.PRINTED:
            say(sentence)
        self._seen.add(sentence)

    def __bool__(self) -> bool:
        return bool(self._seen)

    def finish(self) -> None:
        """Prints how many more there were."""
        if len(self._seen) > self.PRINTED:
            say(f"and {len(self._seen) - self.PRINTED} more faults of this input")


def say(sentence: str) -> None:
    """One line on standard error; standard output is for scans."""
    print(f"lego-loam-sc-read: {sentence}", file=sys.stderr, flush=True)
