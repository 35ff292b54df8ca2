# SPDX-License-Identifier: BSD-3-Clause
"""Makes the runs of an experiment, unless they are in the work folder already."""

import json
import shutil
import sys

import fan_out

import trajectory
from program import PROGRAM, call, version

RECORD = "made_with.json"


def ensure(experiment, folder, count):
    """Leaves `truth.tum` and one run folder for each method in `folder`.

    `count` scans are used, None = all. The record says which program and arguments made the runs
    and whether all of them are there; when it says the same as now, nothing is done.
    """
    record = {
        "program": version(),
        "simulate": list(experiment.simulate),
        "recording": str(experiment.recording) if experiment.recording else None,
        "methods": list(experiment.methods),
        "count": count,
        "finished": True,
    }
    if folder.exists():
        if not (folder / RECORD).is_file():
            sys.exit(f"{folder} is not of this script: move it away or give another --work")
        if read_record(folder) == record:
            print(f"{experiment.name}: runs are there", flush=True)
            return
        shutil.rmtree(folder)
    folder.mkdir(parents=True)
    write_record(folder, {**record, "finished": False})
    if experiment.recording:
        run_recording(experiment, folder, count)
    elif experiment.streamed:
        run_stream(experiment, folder, count)
    else:
        run_folder(experiment, folder, count)
    write_record(folder, record)


def read_record(folder):
    return json.loads((folder / RECORD).read_text())


def write_record(folder, record):
    (folder / RECORD).write_text(json.dumps(record, indent=2) + "\n")


def finished(folder):
    return (folder / RECORD).is_file() and read_record(folder)["finished"]


def limit(count):
    return [] if count is None else ["--count", count]


def run_methods(experiment, folder, scans, count):
    for method in experiment.methods:
        print(f"{experiment.name}: {method}", flush=True)
        call("run", scans, "-o", folder / method, "--method", method, "--quiet", *limit(count))


def run_folder(experiment, folder, count):
    """A world that is small enough for the disk; its scans stay for the figures."""
    print(f"{experiment.name}: simulate", flush=True)
    scans = folder / "scans"
    call("simulate", *experiment.simulate, "-o", scans, *limit(count))
    shutil.copy(scans / "truth.tum", folder / "truth.tum")
    run_methods(experiment, folder, scans, None)


def run_recording(experiment, folder, count):
    """A real KITTI sequence; its truth is the camera's, ours is to be the LiDAR's."""
    truth = trajectory.read_kitti(experiment.recording)
    trajectory.write_tum(folder / "truth.tum", truth.first(count))
    run_methods(experiment, folder, experiment.recording, count)


def run_stream(experiment, folder, count):
    """The simulator's output goes to all methods at once and never to the disk."""
    print(f"{experiment.name}: simulate, {len(experiment.methods)} methods at once", flush=True)
    truth = folder / "truth.tum"
    source = ["simulate", *experiment.simulate, "-o", "-", "--truth", truth, *limit(count)]
    sinks = [
        ["run", "-", "-o", folder / method, "--method", method, "--quiet"]
        for method in experiment.methods
    ]
    fault = fan_out.fan_out([PROGRAM, *source], [[PROGRAM, *sink] for sink in sinks], folder)
    if fault:
        sys.exit(fault)
