# SPDX-License-Identifier: BSD-3-Clause
"""How far a run is off, and whether it said so."""

import dataclasses
import math

import numpy as np

from trajectory import Trajectory, aligned, inverse

SHARE, LEAST = 0.01, 0.1  # of the path, m: a run is fine when its ATE is below either
HALF_A_RUN = 0.5  # share of the scans that must have a pose
FINE, SAID, SILENT, CRASHED = "fine", "said", "silent", "crashed"
WARNING_VERDICTS = ("doubtful", "failed")


@dataclasses.dataclass(frozen=True)
class Errors:
    """Of an estimate beside the truth at the same moments."""

    ate: float  # m, RMSE of the positions after SE(3) alignment; NaN with fewer than three poses
    path: float  # m, of the estimate
    true_path: float  # m
    steps: np.ndarray  # (n - 1,) m, error of each motion from one pose to the next

    @property
    def limit(self):
        return max(LEAST, SHARE * self.true_path)


def errors(truth, estimate):
    """Both trajectories have the same moments, one pose for each."""
    true_path = float(truth.path[-1]) if len(truth.stamps) else 0.0
    if len(estimate.stamps) < 3 or not np.isfinite(estimate.poses).all():
        return Errors(math.nan, math.nan, true_path, np.empty(0))
    moved = aligned(truth, estimate)
    squares = ((moved.positions - truth.positions) ** 2).sum(axis=1)
    there, here = steps(truth), steps(estimate)
    apart = np.linalg.norm((inverse(there) @ here)[:, :3, 3], axis=1)
    return Errors(float(np.sqrt(squares.mean())), float(estimate.path[-1]), true_path, apart)


def steps(trajectory):
    """The motion from each pose to the next, (n - 1, 4, 4)."""
    return inverse(trajectory.poses[:-1]) @ trajectory.poses[1:]


def carriers(step_errors):
    """The fewest steps that make up half of all the error, as indices."""
    order = np.argsort(-step_errors, kind="stable")
    sums = np.cumsum(step_errors[order])
    return order[: np.searchsorted(sums, 0.5 * sums[-1]) + 1] if len(order) else order


def is_fine(found, share_of_scans):
    return share_of_scans >= HALF_A_RUN and found.ate <= found.limit


def how_it_was_said(code, verdict, statuses, step_errors):
    """What the program said of a wrong run: "exit", "verdict", "status" or "" for nothing.

    `statuses` are those of the scans at the ends of the steps. The status counts when most of the
    scans that carry the error have another than ok.
    """
    if code == 1:
        return "exit"
    if verdict in WARNING_VERDICTS:
        return "verdict"
    bad = [statuses[k] != "ok" for k in carriers(step_errors)]
    if not bad:  # no poses to blame
        bad = [status != "ok" for status in statuses]
    return "status" if 2 * sum(bad) > len(bad) else ""


def classify(code, fine, said):
    """One word for a run; `code` is the exit code, None when it had to be ended."""
    if code not in (0, 1):
        return CRASHED
    if code == 0 and fine:
        return FINE
    return SAID if said else SILENT


def picked(trajectory, indices):
    return Trajectory(trajectory.stamps[indices], trajectory.poses[indices])
