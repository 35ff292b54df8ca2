# SPDX-License-Identifier: BSD-3-Clause
"""Fills robustness_text.md with what both commands left and writes it as docs/robustness.md."""

import pathlib

import program
from machine import processor
from markdown_page import filled

HERE = pathlib.Path(__file__).resolve().parent
PARTS = program.ROOT / "build/trials/parts"
NOT_RUN = "not run yet"
NAMES = (
    *("campaign", "campaign_goals", "campaign_commit", "silent", "doubted", "troubles"),
    *("recordings", "real_commit"),
)


def keep(parts):
    """Keeps texts by name for the page; those of the other command stay."""
    PARTS.mkdir(parents=True, exist_ok=True)
    for name, text in parts.items():
        (PARTS / f"{name}.md").write_text(text)


def write(path):
    parts = {"machine": processor()}
    for name in NAMES:
        file = PARTS / f"{name}.md"
        parts[name] = file.read_text() if file.is_file() else NOT_RUN
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(filled((HERE / "robustness_text.md").read_text(), parts))
    print(f"written to {path}", flush=True)
