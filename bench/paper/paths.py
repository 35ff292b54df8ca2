# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories over truth, figures 7 and 14, and the error by axis along the way."""

import numpy as np
import style

import trajectory

# Lines that lie on each other stay visible: each is thinner than the one below it.
WIDTHS = {"loam": 3.2, "lego-loam": 2.4, "lego-loam-sc-paper": 1.6, "lego-loam-sc": 0.8}


def onto_truth(run):
    """Truth and estimate after the alignment of the ATE, and the distance of each pose, m."""
    truth, estimate = trajectory.paired(run.world.truth, run.trajectory)
    estimate = trajectory.aligned(truth, estimate)
    return truth, estimate, np.linalg.norm(estimate.positions - truth.positions, axis=1)


def draw_paths(axes, world, title, extent=None):
    """All methods over the truth, the largest error of each in a circle."""
    true = world.truth.positions
    axes.plot(*true[:, :2].T, color=style.COLOURS["truth"], lw=5.0, alpha=0.25, label="truth")
    for method, run in world.runs.items():
        _, estimate, errors = onto_truth(run)
        worst = int(errors.argmax())
        colour = style.COLOURS[method]
        axes.plot(
            *estimate.positions[:, :2].T, color=colour, lw=WIDTHS[method], label=style.NAMES[method]
        )
        axes.plot(*estimate.positions[worst, :2], "o", ms=10, mfc="none", mec=colour, mew=1.5)
    axes.plot(*true[0, :2], "^", color="black", ms=7, ls="none", label="start")
    axes.plot(*true[-1, :2], "s", color="black", ms=4, ls="none", label="end")
    style.from_above(axes, title, extent)


def draw_errors(axes, world):
    """Distance from the truth along the way."""
    for method, run in world.runs.items():
        truth, _, errors = onto_truth(run)
        axes.plot(truth.path, errors, color=style.COLOURS[method], lw=1.0)
    axes.set_xlabel("distance (m)")
    axes.set_ylabel("error (m)")
    axes.set_xlim(0.0, world.truth.path[-1])
    axes.set_ylim(bottom=0.0)


def add_legend(result, axes):
    result.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)


def around_worst(run, half):
    """The square around the place where a run errs most, at least 2 `half` wide."""
    truth, estimate, errors = onto_truth(run)
    worst = int(errors.argmax())
    x, y = 0.5 * (truth.positions[worst, :2] + estimate.positions[worst, :2])
    half = max(half, 2.0 * errors[worst])
    return (x - half, x + half, y - half, y + half)


def city(world, folder):
    """Figure 7: the whole drive, the place where LeGO-LOAM errs most, the errors."""
    result = style.plt.figure(figsize=(10.0, 8.0))
    axes = result.subplot_mosaic("AB;CC", height_ratios=(2.6, 1.0))
    whole, part, errors = axes["A"], axes["B"], axes["C"]
    enlarged = around_worst(world.runs["lego-loam"], 8.0)
    draw_paths(whole, world, "the whole drive")
    draw_paths(part, world, "in the box: where LeGO-LOAM errs most", enlarged)
    style.frame(whole, enlarged)
    draw_errors(errors, world)
    add_legend(result, whole)
    style.save(result, folder / "fig07.png")


def car_parks(worlds, folder):
    """Figure 14: the two scenes, each with its errors below."""
    result, axes = style.figure(2, 2, panel=(5.0, 3.0), height_ratios=(2.0, 1.0))
    for column, (world, scene) in enumerate(zip(worlds, ("scene #1", "scene #2"), strict=True)):
        draw_paths(axes[column], world, scene)
        draw_errors(axes[2 + column], world)
    add_legend(result, axes[0])
    style.save(result, folder / "fig14.png")


def drift(world, folder):
    """Error along the axes of the first pose over the distance."""
    run = world.runs["lego-loam-sc"]
    result, axes = style.figure(1, 3, panel=(8.0, 1.7), sharex=True)
    for estimate, colour, label in (
        (run.odometry, style.COLOURS["lego-loam"], "odometry, before loops"),
        (run.trajectory, style.COLOURS["lego-loam-sc"], "final trajectory"),
    ):
        truth, estimate = trajectory.paired(world.truth, estimate)
        errors = trajectory.started_alike(truth, estimate).positions - truth.positions
        errors = errors @ truth.poses[0][:3, :3]
        for axis, values in zip(axes, errors.T, strict=True):
            axis.plot(truth.path, values, color=colour, lw=1.0, label=label)
    for axis, name in zip(axes, ("x, forward", "y, left", "z, up"), strict=True):
        axis.axhline(0.0, color="black", lw=0.5)
        axis.set_ylabel(f"{name} (m)")
    axes[0].set_title("error along the axes of the first pose, which is the true one")
    axes[0].legend(ncols=2)
    axes[-1].set_xlabel("distance (m)")
    axes[-1].set_xlim(0.0, world.truth.path[-1])
    style.save(result, folder / "drift.png")
