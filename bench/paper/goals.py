# SPDX-License-Identifier: BSD-3-Clause
"""What must come out of the experiments, and what did."""

import math

import numpy as np
from worlds import OURS

from markdown_page import table

REACHED, ENOUGH, MISSED, NOT_RUN = "goal reached", "must reached", "**missed**", "not run"
NO_MEASURE = "path too short or too straight"
FREEZE_SECONDS = 5.0


def verdict(must, goal):
    """The words for two comparisons."""
    return REACHED if must and goal else ENOUGH if must else MISSED


def at_most(what, value, must, goal, unit, digits=3):
    """A row for a measured value with its two limits."""
    limits = [f"≤ {must} {unit}", f"≤ {goal} {unit}"]
    if math.isnan(value):
        return [what, *limits, "", NO_MEASURE]
    return [what, *limits, f"{value:.{digits}f} {unit}", verdict(value <= must, value <= goal)]


# A function for each world: its rows of the table.


def kitti00(world):
    run = world.runs[OURS]
    deviation = abs(run.length_deviation)
    kitti = run.odometry_evaluation["kitti"]
    t_rel = kitti["t_rel_percent"] if kitti else math.nan
    on = "`kitti00`"
    return [
        at_most(f"{on}: ATE RMSE", run.ate["rmse"], 0.7, 0.3, "m"),
        at_most(f"{on}: ATE maximum", run.ate["max"], 1.7, 0.7, "m"),
        at_most(f"{on}: path length deviation", deviation, 3, 1, "m"),
        at_most(f"{on}: t_rel of the odometry, 100 to 800 m", t_rel, 0.5, 0.35, "%"),
        order(world, on),
        loops(run, on),
    ]


def order(world, on):
    """LOAM > LeGO-LOAM > LeGO-LOAM-SC in ATE RMSE."""
    errors = [world.runs[method].ate["rmse"] for method in ("loam", "lego-loam", OURS)]
    measured = ", ".join(f"{error:.3f}" for error in errors) + " m"
    holds = errors[0] > errors[1] > errors[2]
    what = f"{on}: ATE RMSE of LOAM > LeGO-LOAM > LeGO-LOAM-SC"
    return [what, "holds", "", measured, "holds" if holds else MISSED]


def loops(run, on):
    score = run.loop_score
    words = verdict(score.false == 0 and score.recall >= 0.8, score.recall >= 0.95)
    measured = f"{score.precision:.3f} / {score.recall:.3f}"
    return [f"{on}: precision / recall of loops", "1.0 / ≥ 0.8", "1.0 / ≥ 0.95", measured, words]


def back_at_start(world):
    end = world.runs[OURS].end
    words = verdict(end.translation <= 0.2, end.translation <= 0.05 and end.rotation <= 0.2)
    measured = f"{end.translation:.3f} m, {end.rotation:.2f}°"
    return [f"`{world.name}`: error on return", "≤ 0.2 m", "≤ 0.05 m, 0.2°", measured, words]


def parking1(world):
    return [back_at_start(world)]


def parking2(world):
    run = world.runs[OURS]
    score = run.loop_score
    measured = f"{score.false} of {score.accepted}"
    words = "holds" if score.false == 0 else MISSED
    return [
        back_at_start(world),
        at_most("`parking2`: ATE RMSE", run.ate["rmse"], 0.15, 0.05, "m"),
        ["`parking2`: false loops", "0", "", measured, words],
    ]


def mine(world):
    return [at_most("`mine`: ATE RMSE", world.runs[OURS].ate["rmse"], 0.2, 0.08, "m")]


def tunnel(world):
    run = world.runs[OURS]
    degenerate = np.mean([int(row["degenerate_translations"]) > 0 for row in run.scans])
    moves = not freezes(run)
    error = abs(run.length_deviation) / world.length
    words = verdict(degenerate > 0.5 and moves, error <= 0.03)
    measured = f"degenerate in {100 * degenerate:.0f} % of the scans, "
    measured += f"{'no freeze' if moves else 'freezes'}, {100 * error:.1f} %"
    what = "`tunnel`: degenerate along its axis, no freeze; length error"
    return [[what, "yes", "≤ 3 %", measured, words]]


def freezes(run):
    """Does the estimate, over any FREEZE_SECONDS, move less than half as far as the truth?"""
    starts = np.arange(run.trajectory.stamps[0], run.trajectory.stamps[-1] - FREEZE_SECONDS)

    def moved(trajectory):
        begin, end = trajectory.at(starts), trajectory.at(starts + FREEZE_SECONDS)
        return np.linalg.norm(end[:, :3, 3] - begin[:, :3, 3], axis=1)

    true = moved(run.world.truth)
    return bool(np.any((moved(run.trajectory) < 0.5 * true) & (true > 0.5)))


def goals_table(worlds):
    rows = []
    for rows_of in (kitti00, parking1, parking2, mine, tunnel):
        world = worlds[rows_of.__name__]
        rows += rows_of(world) if world.runs else [[f"`{world.name}`", "", "", "", NOT_RUN]]
    return table(["what", "must", "goal", "measured", ""], rows)
