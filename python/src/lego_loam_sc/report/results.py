# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a run left; docs/output.md says what that is."""

import csv
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from lego_loam_sc.errors import InputError
from lego_loam_sc.report.ply import positions_of, read_ply


@dataclass
class Cloud:
    positions: np.ndarray  # (n, 3) m
    intensity: np.ndarray  # (n,)
    key_frame: np.ndarray  # (n,) number of the key frame that saw the point

    def __len__(self) -> int:
        return len(self.positions)


@dataclass
class Results:
    """A run that was killed has no summary, trajectory, map and loop scans."""

    folder: Path
    scans: dict[str, np.ndarray]  # columns of scans.csv
    loops: list[dict[str, str]]  # rows of loops.csv
    odometry: np.ndarray  # (n, 8) rows of odometry.tum
    trajectory: np.ndarray | None  # the same of trajectory.tum
    map: Cloud | None
    loop_scans: Cloud | None
    summary: dict | None
    settings: str
    sensor: str

    @property
    def poses(self) -> np.ndarray:
        """The best poses that there are."""
        return self.odometry if self.trajectory is None else self.trajectory

    @property
    def corrected(self) -> bool:
        """True when loops make a difference between odometry and trajectory."""
        accepted = any(row["verdict"] == "accepted" for row in self.loops)
        return self.trajectory is not None and accepted

    @property
    def start(self) -> float:
        """Stamp of the first pose, s."""
        return float(self.odometry[0, 0])

    @cached_property
    def pose_of_scan(self) -> np.ndarray:
        """The row of `poses` for each scan; one out of order has none and gets the one before."""
        posed = self.scans["status"] != "out_of_order"
        return np.minimum(np.maximum(np.cumsum(posed) - 1, 0), len(self.odometry) - 1)

    @cached_property
    def pose_of_key_frame(self) -> np.ndarray:
        """The row of `poses` for each key frame, by its number."""
        numbers = self.scans["key_frame"].astype(int)
        taken = np.flatnonzero(numbers >= 0)
        rows = np.zeros(numbers.max(initial=-1) + 1, int)
        rows[numbers[taken]] = self.pose_of_scan[taken]
        return rows


def read_results(folder: Path) -> Results:
    if not (folder / "scans.csv").is_file():
        raise InputError(f"{folder} is no folder of a run, scans.csv is missing; give one")
    scans = _read_scans(folder / "scans.csv")
    odometry = _read_tum(folder / "odometry.tum")
    if len(odometry) == 0:
        raise InputError(f"{folder} holds no pose, so there is nothing to report; run more scans")
    whole = (folder / "summary.json").is_file()
    trajectory = _read_tum(folder / "trajectory.tum") if whole else None
    if trajectory is not None and len(trajectory) != len(odometry):
        raise InputError(f"{folder}: trajectory.tum and odometry.tum are of different runs")
    return Results(
        folder,
        scans,
        _read_rows(folder / "loops.csv"),
        odometry,
        trajectory,
        _read_cloud(folder / "map.ply") if whole else None,
        _read_cloud(folder / "loop_scans.ply") if whole else None,
        read_json(folder / "summary.json") if whole else None,
        _read_text(folder / "settings.yaml"),
        _read_text(folder / "sensor.yaml"),
    )


def _read_text(path: Path) -> str:
    try:
        return path.read_text(errors="replace")
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error


def read_json(path: Path) -> dict:
    try:
        return json.loads(_read_text(path))
    except ValueError as error:
        raise InputError(f"{path} is no JSON: {error}; run again") from error


def _read_rows(path: Path) -> list[dict[str, str]]:
    """The whole rows; the last line of a killed run may be cut off."""
    rows = list(csv.DictReader(_read_text(path).splitlines()))
    return [row for row in rows if None not in row and None not in row.values()]


_WORDS = (
    "status",
    "warnings",
    "errors",
    "delay_level",
)  # columns of scans.csv, the rest are numbers


def _read_scans(path: Path) -> dict[str, np.ndarray]:
    rows = _read_rows(path)
    if not rows:
        raise InputError(f"{path} has no scan; run more scans")
    try:
        return {
            name: np.array([row[name] for row in rows], str if name in _WORDS else float)
            for name in rows[0]
        }
    except ValueError as error:
        raise InputError(f"{path}: {error}; run again") from error


def _read_tum(path: Path) -> np.ndarray:
    rows = [line.split() for line in _read_text(path).splitlines()]
    try:
        return np.array([row for row in rows if len(row) == 8], float).reshape(-1, 8)
    except ValueError as error:
        raise InputError(f"{path}: {error}; run again") from error


def _read_cloud(path: Path) -> Cloud:
    points = read_ply(path)
    try:
        return Cloud(positions_of(points), points["intensity"], points["key_frame"])
    except ValueError as error:
        raise InputError(f"{path} is not as this version writes it; run again") from error
