# SPDX-License-Identifier: BSD-3-Clause
"""Runs of ours and of the peers on scans in a file or a folder, and what they leave behind."""

import csv
import dataclasses
import json
import pathlib

import numpy as np
import processes

import environment
import program
from systems import OURS, PEERS
from trajectory import Trajectory, read_tum

PEERS_FOLDER = program.ROOT / "build/peers"
DRIVE = pathlib.Path(__file__).resolve().parent.parent / "peers/drivers/drive.py"
# Where in the sweep the pose of a peer that de-skews belongs, see its driver.
REFERENCE = {"kiss-icp": 1.0, "genz-icp": 0.5}
NOTHING = Trajectory(np.empty(0), np.empty((0, 4, 4)))


@dataclasses.dataclass(frozen=True)
class Outcome:
    """One run: `numbers` (n,) are those of the scans that `trajectory` has poses of."""

    code: int | None  # exit code; None when it was ended after too long
    cpu_seconds: float  # without what a peer needs before the first scan
    trajectory: Trajectory
    numbers: np.ndarray
    statuses: list[str]  # of all scans, ours only
    summary: dict  # summary.json, ours only
    message: str  # the last that it printed


def peer_python(peer):
    """Of the peer's own environment, the one of bench/peers."""
    requirements = "\n".join(PEERS[peer].requirements) + "\n"
    PEERS_FOLDER.mkdir(parents=True, exist_ok=True)
    return environment.ensure(PEERS_FOLDER / f"venv-{peer}", requirements)


def run_ours(scans, folder, *options):
    """`folder` is made; it gets the results and log.txt."""
    folder.mkdir(parents=True)
    output, log = folder / OURS, folder / "log.txt"
    command = [program.PROGRAM, "run", scans, "-o", output, "--threads", 1, *options]
    ended = processes.run(command, log)
    rows = csv_rows(output / "scans.csv")
    summary = output / "summary.json"
    trajectory = poses(output / "trajectory.tum")
    stamps = np.array([float(row["stamp"]) for row in rows])
    return Outcome(
        ended.code,
        ended.cpu_seconds,
        trajectory,
        numbered(trajectory.stamps, stamps),
        [row["status"] for row in rows],
        json.loads(summary.read_text()) if summary.is_file() else {},
        last_line(log),
    )


def run_peer(peer, scans, folder, options):
    """`options` are those of drivers/drive.py but for the threads: one."""
    folder.mkdir(parents=True)
    log = folder / "log.txt"
    words = json.dumps({**options, "threads": 1})
    ended = processes.run([peer_python(peer), DRIVE, peer, scans, folder, words], log)
    process = folder / "process.json"
    start = json.loads(process.read_text())["start_cpu_seconds"] if process.is_file() else 0.0
    trajectory = poses(folder / "trajectory.tum")
    count = len(trajectory.stamps)
    cpu = ended.cpu_seconds - start
    return Outcome(ended.code, cpu, trajectory, np.arange(count), [], {}, last_line(log))


def csv_rows(path):
    if not path.is_file():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def poses(path):
    return read_tum(path) if path.is_file() and path.stat().st_size else NOTHING


def numbered(stamps, all_stamps):
    """The index in `all_stamps` of each of `stamps`: those of the scans as they came."""
    order = np.argsort(all_stamps, kind="stable")
    found = np.searchsorted(all_stamps[order], stamps - 1e-6)
    return order[np.minimum(found, len(order) - 1)] if len(order) else np.empty(0, int)


def last_line(log):
    lines = [line.strip() for line in log.read_text(errors="replace").splitlines()]
    return next((line for line in reversed(lines) if line), "")[:300]
