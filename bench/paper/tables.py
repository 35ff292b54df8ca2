# SPDX-License-Identifier: BSD-3-Clause
"""Tables 1 to 4 as the paper prints them, its figures first, then ours; all in Markdown."""

import math

import published
import style
from worlds import OURS

from markdown_page import fixed, table

SCENES = {"parking1": "#1", "parking2": "#2"}


def paper(method):
    return f"{style.NAMES[method]} (the paper)"


def ours(method):
    return f"**`{method}`**" if method == OURS else f"`{method}`"


def lengths(world):
    """Table 1."""
    header = ["method", "path length (m)", "deviation (m)", "CPU (%)", "CPU time (s)"]
    rows = []
    for method, (length, deviation, share, seconds) in published.TABLE_1.items():
        rows.append([paper(method), *fixed((length, deviation), 3), f"{share}", f"{seconds:.3f}"])
    for method, run in world.runs.items():
        values = fixed((run.length, run.length_deviation), 3)
        share = f"{100 * run.cpu_share:.0f}"
        rows.append([ours(method), *values, share, f"{run.cpu_seconds:.1f}"])
    return table(header, rows)


def errors(world):
    """Table 2."""
    header = ["method", "error", "maximum", "minimum", "RMSE"]
    rows = []
    for method, both in published.TABLE_2.items():
        for name, values in both.items():
            unit = " m" if name == "ATE" else ""
            rows.append([paper(method), name, *(f"{value:.3f}{unit}" for value in values)])
    for method, run in world.runs.items():
        for name, measured in (("ATE", run.ate), ("RPE", run.rpe)):
            values = fixed((measured[key] for key in ("max", "min", "rmse")), 4)
            rows.append([ours(method), name, *(f"{value} m" for value in values)])
    return table(header, rows)


def returns(worlds):
    """Table 3."""
    header = ["scene", "method", "x (m)", "y (m)", "z (m)", "total (m)"]
    header += ["pitch (°)", "yaw (°)", "roll (°)", "total (°)"]
    rows = []
    for world in worlds:
        scene = SCENES[world.name]
        for method, values in published.TABLE_3[world.name].items():
            rows.append([scene, paper(method), *fixed(values, 2)])
        for method, run in world.runs.items():
            end = run.end
            metres = fixed((end.x, end.y, end.z, end.translation), 3)
            degrees = fixed((end.pitch, end.yaw, end.roll, end.rotation), 2)
            rows.append([scene, ours(method), *metres, *degrees])
    return table(header, rows)


def scene_lengths(worlds):
    """Table 4."""
    header = ["scene", "method", "path length (m)", "CPU time (s)"]
    rows = []
    for world in worlds:
        scene = SCENES[world.name]
        for method, (length, seconds) in published.TABLE_4[world.name].items():
            rows.append([scene, paper(method), f"{length:.3f}", f"{seconds:.3f}"])
        if world.runs:
            rows.append([scene, "truth", f"{world.length:.3f}", ""])
        for method, run in world.runs.items():
            rows.append([scene, ours(method), f"{run.length:.3f}", f"{run.cpu_seconds:.1f}"])
    return table(header, rows)


def loops(worlds):
    """Loops of every run that looks for them."""
    header = ["world", "method", "accepted", "false", "stretches of revisit", "found"]
    rows = []
    for world in worlds:
        for method, run in world.runs.items():
            if method == "loam":
                continue
            score = run.loop_score
            counts = (score.accepted, score.false, score.stretches, score.found)
            rows.append([f"`{world.name}`", ours(method), *map(str, counts)])
    return table(header, rows)


def summary(worlds):
    """The other errors of our method on every world."""
    header = ["world", "scans", "path (m)", "ATE RMSE (m)", "ATE maximum (m)"]
    header += ["odometry t_rel (%)", "CPU per scan (ms)", "memory (MiB)"]
    rows = []
    for world in worlds:
        if not world.runs:
            continue
        run = world.runs[OURS]
        kitti = run.odometry_evaluation["kitti"]
        timing = run.summary["timing"]
        values = fixed((run.ate["rmse"], run.ate["max"]), 3)
        values += fixed((kitti["t_rel_percent"] if kitti else math.nan,), 3)
        values += [f"{timing['cpu_ms_per_scan']:.1f}", f"{timing['peak_memory_mb']:.0f}"]
        rows.append([f"`{world.name}`", str(run.summary["scans"]), f"{world.length:.1f}", *values])
    return table(header, rows)
