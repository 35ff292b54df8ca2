# SPDX-License-Identifier: BSD-3-Clause
"""The programs under test, and what takes their output apart."""

import io
import os
import struct
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from lego_loam_sc import read as program

ROOT = Path(__file__).parents[2]
PROGRAM = Path(os.environ.get("LEGO_LOAM_SC_PROGRAM", ROOT / "build/release/lego-loam-sc"))

needs_program = pytest.mark.skipif(not PROGRAM.exists(), reason="lego-loam-sc is not built")


@pytest.fixture(scope="session")
def environment(tmp_path_factory):
    """A PATH with lego-loam-sc and the commands of the package under test."""
    folder = tmp_path_factory.mktemp("bin")
    for command, module in (("read", "read"), ("report", "report.main")):
        script = folder / f"lego-loam-sc-{command}"
        script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m lego_loam_sc.{module} "$@"\n')
        script.chmod(0o755)
    (folder / PROGRAM.name).symlink_to(PROGRAM)
    return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}


@dataclass
class ReadScan:
    stamp_ns: int
    points: np.ndarray
    intensity: np.ndarray | None
    ring: np.ndarray | None
    offset_ns: np.ndarray | None


@dataclass
class Outcome:
    exit_code: int
    messages: list[str]  # lines of standard error
    text: str = ""  # standard output of --list
    facts: str = ""
    scans: list[ReadScan] = field(default_factory=list)

    def stamps(self) -> list[int]:
        return [scan.stamp_ns for scan in self.scans]


def parse_stream(data: bytes) -> tuple[str, list[ReadScan]]:
    """As docs/scan-stream.md says; fails on anything else."""
    magic, version, length = struct.unpack_from("<8sII", data)
    assert (magic, version) == (b"LLSCSCAN", 1)
    facts, at = data[16 : 16 + length].decode(), 16 + length
    scans = []
    while at < len(data):
        marker, flags, stamp_ns, count = struct.unpack_from("<4sIqI", data, at)
        assert marker == b"SCAN" and flags <= 7
        at += 20
        arrays = []
        for present, kind, width in (
            (1, "<f4", 3),
            (flags & 1, "<f4", 1),
            (flags & 2, "<u2", 1),
            (flags & 4, "<i4", 1),
        ):
            size = count * width if present else 0
            array = np.frombuffer(data, kind, size, at)
            at += array.nbytes
            arrays.append(array if present else None)
        scans.append(ReadScan(stamp_ns, arrays[0].reshape(-1, 3), *arrays[1:]))
    assert at == len(data)
    return facts, scans


@pytest.fixture
def read(monkeypatch, capsys):
    """Runs lego-loam-sc-read with the given arguments."""

    def run(*arguments: str | Path) -> Outcome:
        words = [str(argument) for argument in arguments]
        capsys.readouterr()
        if "--list" in words:
            exit_code = program.main(words)
            captured = capsys.readouterr()
            return Outcome(exit_code, captured.err.splitlines(), captured.out)
        out = io.TextIOWrapper(io.BytesIO())
        with monkeypatch.context() as patch:
            patch.setattr(sys, "stdout", out)
            exit_code = program.main(words)
        messages = capsys.readouterr().err.splitlines()
        data = out.buffer.getvalue()
        return Outcome(exit_code, messages, "", *(parse_stream(data) if data else ("", [])))

    return run
