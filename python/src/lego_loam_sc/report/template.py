# SPDX-License-Identifier: BSD-3-Clause
"""Puts a page together from the files of this package."""

import json
from importlib.resources import files
from typing import Any


def asset(name: str) -> str:
    """A file of this package."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def fill(name: str, parts: dict[str, str]) -> str:
    """A template of this package with its parts, each at its place %%NAME%%."""
    # Cut at the places first: what is put in may look like one.
    pieces = asset(name).split("%%")
    return "".join(parts[piece] if k % 2 else piece for k, piece in enumerate(pieces))


def to_script(data: Any) -> str:
    """JSON that may stand inside a script."""
    return inside_script(json.dumps(data, separators=(",", ":")))


def inside_script(text: str) -> str:
    """The same to JavaScript, and no end of a script to HTML."""
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")
