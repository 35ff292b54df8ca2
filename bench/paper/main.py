# SPDX-License-Identifier: BSD-3-Clause
"""Repeats the paper's experiments and writes docs/paper.md and docs/figures.

Runs that are in the work folder already, made by the same program with the same arguments, are not
repeated. With --count everything stays in a folder of its own in the work folder.
"""

import argparse
import pathlib
import sys

import document
import loop_frames
import maps
import paths
import runs
import solve
import stages
from evo_tool import EvoError
from measured import World
from worlds import experiments

from program import ROOT


def parse():
    parser = argparse.ArgumentParser(
        prog="bench/paper/run",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    names = [*experiments(), "solve"]
    parser.add_argument(
        "--work",
        type=pathlib.Path,
        default=ROOT / "build/paper",
        help="folder of the runs, which are kept; takes 8 GB [default: build/paper]",
    )
    parser.add_argument("--only", choices=names, help="run nothing but this")
    parser.add_argument("--kitti", type=pathlib.Path, help="real sequence 00, as kitti00")
    parser.add_argument("--route", type=pathlib.Path, help="KITTI poses, the route of kitti00")
    parser.add_argument("--count", type=int, help="scans of each world, for a quick trial")
    parser.add_argument(
        "--figures-only", action="store_true", help="draw the figures of the runs that are there"
    )
    options = parser.parse_args()
    if options.count:
        options.work /= f"first-{options.count}"
    return options


def run_all(options):
    for name, experiment in experiments(options.kitti, options.route).items():
        if options.only in (None, name):
            runs.ensure(experiment, options.work / name, options.count)
    if options.only in (None, "solve"):
        scans = options.work / "parking1/scans"
        if not scans.is_dir():
            runs.ensure(experiments()["parking1"], options.work / "parking1", options.count)
        solve.ensure(scans, options.work / "solve")


def draw_all(worlds, folder):
    """The figures of those worlds that have run."""
    kitti, first, second = (worlds[name] for name in ("kitti00", "parking1", "parking2"))
    if kitti.runs:
        maps.city(kitti, folder)
        paths.city(kitti, folder)
        paths.drift(kitti, folder)
    if first.runs:
        stages.figure(first.scan_folder, folder)
        loop_frames.figure(first, folder)
    if first.runs and second.runs:
        maps.car_parks(first, second, folder)
        paths.car_parks((first, second), folder)


def main():
    options = parse()
    if not options.figures_only:
        run_all(options)
    worlds = {
        name: World(experiment, options.work / name)
        for name, experiment in experiments(options.kitti, options.route).items()
    }
    output = options.work / "docs" if options.count else ROOT / "docs"
    print("figures", flush=True)
    draw_all(worlds, output / "figures")
    if not options.figures_only:
        print("tables", flush=True)
        document.write(worlds, solve.read(options.work / "solve"), output / "paper.md")
    print(f"written to {output}", flush=True)


if __name__ == "__main__":
    try:
        main()
    except EvoError as error:
        sys.exit(str(error))
