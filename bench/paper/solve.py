# SPDX-License-Identifier: BSD-3-Clause
"""The two-step solve against the joint one: how much time does it save?"""

import csv
import json
import shutil
import statistics

from program import call, version

REPETITIONS = 5
METHOD = "lego-loam-sc-paper"


def odometry_milliseconds(scans, folder, two_step):
    """Sum over all scans of the time from scan to scan, wall clock, one thread."""
    shutil.rmtree(folder, ignore_errors=True)
    setting = f"odometry.two_step={'true' if two_step else 'false'}"
    options = ["--method", METHOD, "--set", setting, "--threads", 1, "--quiet"]
    call("run", scans, "-o", folder, *options)
    with (folder / "scans.csv").open() as file:
        milliseconds = sum(float(row["odometry_ms"]) for row in csv.DictReader(file))
    shutil.rmtree(folder)
    return milliseconds


def ensure(scans, folder):
    """Leaves solve.json in `folder`: milliseconds of each repetition, the two ways in turn."""
    path = folder / "solve.json"
    now = version()
    if path.is_file() and json.loads(path.read_text())["program"] == now:
        print("solve: times are there", flush=True)
        return
    folder.mkdir(parents=True, exist_ok=True)
    two_step, joint = [], []
    for repetition in range(REPETITIONS):
        print(f"solve: repetition {repetition + 1} of {REPETITIONS}", flush=True)
        two_step.append(odometry_milliseconds(scans, folder / "run", True))
        joint.append(odometry_milliseconds(scans, folder / "run", False))
    record = {"program": now, "two_step_ms": two_step, "joint_ms": joint}
    path.write_text(json.dumps(record, indent=2) + "\n")


def read(folder):
    """Median share of time that the two-step solve saves, with the times; None when not run."""
    path = folder / "solve.json"
    if not path.is_file():
        return None
    record = json.loads(path.read_text())
    ratios = [a / b for a, b in zip(record["two_step_ms"], record["joint_ms"], strict=True)]
    return {
        "saved": 1.0 - statistics.median(ratios),
        "two_step_ms": statistics.median(record["two_step_ms"]),
        "joint_ms": statistics.median(record["joint_ms"]),
        "repetitions": len(ratios),
    }
