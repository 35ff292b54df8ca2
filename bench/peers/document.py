# SPDX-License-Identifier: BSD-3-Clause
"""Fills document_text.md and writes it as docs/peers.md."""

import pathlib

import goals
import tables
from results import Compared

from machine import processor
from markdown_page import filled
from systems import OURS

HERE = pathlib.Path(__file__).resolve().parent


def commits(compared):
    """Of the runs of ours."""
    ours = [runs[OURS] for one in compared for runs in one.runs.values() if OURS in runs]
    return " and ".join(sorted({run.record["commit"] for run in ours})) or "none"


def write(store, recordings, path):
    compared = [Compared(store, recording) for recording in recordings]
    parts = {
        "machine": processor(),
        "commit": commits(compared),
        "goals": goals.goals_table(compared),
        "cpu": tables.ratios(compared, lambda result: result.cpu_ms),
        "ate": tables.ratios(compared, lambda result: result.ate),
        "memory": tables.ratios(compared, lambda result: result.peak_mib),
        "stages": tables.stages(compared),
        "settings": tables.settings(),
        "absolutes": tables.absolutes(compared),
        "notes": (HERE / "notes.md").read_text().strip(),
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(filled((HERE / "document_text.md").read_text(), parts))
    print(f"written to {path}", flush=True)
