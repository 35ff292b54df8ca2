# SPDX-License-Identifier: BSD-3-Clause
"""Fills document_text.md and writes it as docs/paper.md."""

import pathlib

import agreement
import goals
import published
import solve
import tables

from machine import processor
from markdown_page import filled

HERE = pathlib.Path(__file__).resolve().parent

MADE_CITY = (
    "`kitti00` is made: a city around {route}, with traffic, seen by an HDL-64E whose beams, ranges"
    " and noise are those of a used one."
)
OWN_ROUTE = "a route of the simulator's own"
GIVEN_ROUTE = "the poses given with `--route`"
REAL_CITY = "`kitti00` is the real sequence."
AT_ONCE = "The four methods read one stream at the same time and share the machine."
IN_TURN = "The four methods ran one after the other."


def programs(worlds):
    """Version and hash of the program that made the runs, or of several."""
    return " and ".join(sorted({world.made_with["program"] for world in worlds if world.runs}))


def solve_sentence(times):
    if times is None:
        return "Not run."
    seconds = [f"{times[name] / 1000:.2f} s" for name in ("two_step_ms", "joint_ms")]
    change = "less" if times["saved"] > 0 else "more"
    return (
        f"Scan-to-scan odometry takes {seconds[0]} on `parking1` with the two-step solve and"
        f" {seconds[1]} with the joint one: {100 * abs(times['saved']):.0f} % {change} (median of"
        f" {times['repetitions']} pairs of runs in turn, `{solve.METHOD}`, one thread). The paper"
        " claims about 35 % less."
    )


def kitti_parts(world):
    """What the text says about the recording `kitti00`."""
    if not world.runs:
        return {"kitti00": "`kitti00` was not run.", "timing": ""}
    length = f"The true path is {world.length:.3f} m long; the paper's is {published.LENGTH} m."
    if world.made_with["recording"]:
        return {"kitti00": REAL_CITY, "timing": f"{IN_TURN} {length}"}
    route = GIVEN_ROUTE if "--route" in world.made_with["simulate"] else OWN_ROUTE
    return {"kitti00": MADE_CITY.format(route=route), "timing": f"{AT_ONCE} {length}"}


def write(worlds, solve_times, path):
    scenes = [worlds["parking1"], worlds["parking2"]]
    parts = {
        "made_with": f"lego-loam-sc {programs(worlds.values())} on {processor()}",
        "agreement": agreement.sentence(worlds.values()),
        "goals": goals.goals_table(worlds),
        "table1": tables.lengths(worlds["kitti00"]),
        "table2": tables.errors(worlds["kitti00"]),
        "table3": tables.returns(scenes),
        "table4": tables.scene_lengths(scenes),
        "solve": solve_sentence(solve_times),
        "loops": tables.loops([worlds["kitti00"], *scenes, worlds["mine"]]),
        "worlds": tables.summary(worlds.values()),
        **kitti_parts(worlds["kitti00"]),
    }
    text = (HERE / "document_text.md").read_text()
    text = filled(text, parts)
    text = text.replace("<!-- notes -->", (HERE / "notes.md").read_text().strip())
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
