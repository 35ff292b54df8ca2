# SPDX-License-Identifier: BSD-3-Clause
"""Are the loops true, and were the true revisits found?

A revisit is a key frame within RADIUS of an earlier one, which was passed at least SECONDS and
TRAVEL before. Consecutive revisits are cut into stretches of about STRETCH metres of path; a
stretch counts as found when a true accepted loop has its query in it.
"""

import csv
import dataclasses

import numpy as np
from scipy.spatial.transform import Rotation

from trajectory import inverse, pose, rotations

RADIUS = 4.0  # m
HEIGHT = 2.0  # m of it at most upwards or downwards: another floor is no revisit
SECONDS = 30.0
TRAVEL = 50.0  # m
STRETCH = 10.0  # m
TRANSLATION_TOLERANCE = 0.5  # m
ROTATION_TOLERANCE = 2.0  # deg


@dataclasses.dataclass(frozen=True)
class Loop:
    """An accepted loop between two scans, numbered from 0."""

    query: int
    match: int
    detector: str
    T_match_query: np.ndarray  # 4 x 4, m


@dataclasses.dataclass(frozen=True)
class LoopScore:
    accepted: int
    false: int
    stretches: int  # revisits in the truth
    found: int

    @property
    def precision(self):
        return 1.0 - self.false / self.accepted if self.accepted else 1.0

    @property
    def recall(self):
        return self.found / self.stretches if self.stretches else 1.0


def read_accepted(path):
    """The accepted loops of a loops.csv."""
    with path.open() as file:
        return [read_loop(row) for row in csv.DictReader(file) if row["verdict"] == "accepted"]


def read_loop(row):
    angles = [float(row[name]) for name in ("loop_yaw_deg", "pitch_deg", "roll_deg")]
    T_match_query = pose(
        [float(row[name]) for name in "xyz"], Rotation.from_euler("ZYX", angles, degrees=True)
    )
    return Loop(int(row["query_scan"]), int(row["match_scan"]), row["detector"], T_match_query)


def is_true(loop, poses):
    """Does the measured transform agree with the true poses of the scans, (n, 4, 4)?"""
    expected = inverse(poses[loop.match]) @ poses[loop.query]
    error = inverse(expected) @ loop.T_match_query
    return bool(
        np.linalg.norm(error[:3, 3]) <= TRANSLATION_TOLERANCE
        and np.degrees(rotations(error).magnitude()) <= ROTATION_TOLERANCE
    )


def revisits(positions, stamps, path):
    """For each key frame: does it come back to an earlier one? All arrays are of key frames."""
    back = np.zeros(len(positions), dtype=bool)
    for index, (here, stamp, travelled) in enumerate(zip(positions, stamps, path, strict=True)):
        earlier = (stamps <= stamp - SECONDS) & (path <= travelled - TRAVEL)
        apart = positions[earlier] - here
        near = (np.linalg.norm(apart, axis=1) <= RADIUS) & (np.abs(apart[:, 2]) <= HEIGHT)
        back[index] = near.any()
    return back


def cut_into_stretches(back, path):
    """Groups of consecutive revisiting key frames, each about STRETCH of path, as index arrays."""
    indices = np.flatnonzero(back)
    stretches = []
    for visit in np.split(indices, np.flatnonzero(np.diff(indices) > 1) + 1):
        if len(visit) == 0:
            continue
        length = path[visit[-1]] - path[visit[0]]
        pieces = max(1, round(length / STRETCH))
        piece = np.minimum((path[visit] - path[visit[0]]) / max(length, 1e-9) * pieces, pieces - 1)
        stretches += [visit[piece.astype(int) == k] for k in range(pieces)]
    return [stretch for stretch in stretches if len(stretch) > 0]


def score(loops, key_scans, poses, stamps, path):
    """The loops of one run against the truth.

    `key_scans` are the numbers of the scans that became key frames; `poses`, `stamps` and `path`
    are true and have an entry for each scan.
    """
    true = [loop for loop in loops if is_true(loop, poses)]
    back = revisits(poses[key_scans, :3, 3], stamps[key_scans], path[key_scans])
    queries = {loop.query for loop in true}
    stretches = cut_into_stretches(back, path[key_scans])
    found = sum(any(scan in queries for scan in key_scans[stretch]) for stretch in stretches)
    return LoopScore(len(loops), len(loops) - len(true), len(stretches), found)
