# SPDX-License-Identifier: BSD-3-Clause
"""Tables and prose of the documents that the scripts of bench/ write."""

import math
import textwrap

WIDTH = 120


def table(header, rows):
    lines = [f"| {' | '.join(header)} |", f"|{'|'.join('---' for _ in header)}|"]
    return "\n".join(lines + [f"| {' | '.join(row)} |" for row in rows])


def fixed(values, digits):
    """Texts; never -0.0, and a dash for what could not be measured."""
    return [
        "–" if math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}" for value in values
    ]


def filled(text, parts):
    """`text` with each `<!-- name -->` replaced by parts[name], its prose in lines of one width."""
    for name, part in parts.items():
        text = text.replace(f"<!-- {name} -->", part)
    return "\n\n".join(wrapped(paragraph) for paragraph in text.split("\n\n"))


def wrapped(paragraph):
    """Tables, lists, code and headings stay as they are."""
    if paragraph.startswith(("|", "-", "```", "#", "!", "<!--")):
        return paragraph
    return textwrap.fill(" ".join(paragraph.split()), WIDTH, break_on_hyphens=False)
