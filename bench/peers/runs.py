# SPDX-License-Identifier: BSD-3-Clause
"""Runs what is missing and keeps what came out, one small folder for each run."""

import dataclasses
import hashlib
import json
import pathlib
import shutil
import subprocess
import tempfile

import measure
import numpy as np
import stages

import environment
import program
import trajectory
from systems import OURS, PEERS, options

DRIVE = pathlib.Path(__file__).resolve().parent / "drivers/drive.py"
RECORD = "run.json"
FINGERPRINT_BYTES = 1 << 24


class Store:
    """The folder of results: INPUT/truth.tum, INPUT/scans.json, INPUT/SYSTEM-tTHREADS/..."""

    def __init__(self, folder):
        self.folder = folder

    def peer_python(self, peer):
        """Of the peer's own environment, which is made when it is not there."""
        requirements = "\n".join(PEERS[peer].requirements) + "\n"
        return environment.ensure(self.folder.parent / f"venv-{peer}", requirements)

    def input_folder(self, recording):
        return self.folder / recording.name

    def truth(self, recording):
        """Path of the true trajectory; None when the recording has none."""
        path = self.input_folder(recording) / "truth.tum"
        return path if path.is_file() else None

    def scans(self, recording):
        """What was noted about the scans of the last runs; None before the first."""
        return read_json(self.input_folder(recording) / "scans.json")

    def run_folder(self, recording, system, threads):
        return self.input_folder(recording) / f"{system}-t{threads}"

    def record(self, recording, system, threads):
        """The finished run, when it was on the same scans as the last runs of others; or None."""
        record = read_json(self.run_folder(recording, system, threads) / RECORD)
        scans = self.scans(recording)
        return record if record and scans and record["scans_of"] == scans["fingerprint"] else None

    def is_current(self, recording, system, threads):
        record = self.record(recording, system, threads)
        return record is not None and record["made_with"] == made_with(system, recording)


def read_json(path):
    return json.loads(path.read_text()) if path.is_file() else None


def made_with(system, recording):
    """All that decides a run but its scans and its threads."""
    if system == OURS:
        return {"program": program.version()}
    return {
        "requirements": list(PEERS[system].requirements),
        "options": options(system, recording),
    }


def ensure(store, recording, systems, threads, work, again=()):
    """Runs each of `systems` at each number of `threads`, in turn, unless its run is there.

    The scans of a made world are in `work` meanwhile. Runs of the systems in `again` are repeated.
    """
    wanted = [(system, count) for count in threads for system in systems]
    if all(
        system not in again and store.is_current(recording, system, count)
        for system, count in wanted
    ):
        return
    print(f"{recording.name}: scans", flush=True)
    with tempfile.TemporaryDirectory(prefix="peers-", dir=work) as scratch:
        scans = prepare(store, recording, pathlib.Path(scratch))
        for system, count in wanted:
            if system in again or not store.is_current(recording, system, count):
                run(store, recording, scans, system, count, pathlib.Path(scratch))


def prepare(store, recording, scratch):
    """Makes the scans and the truth, and notes what they are; returns where the scans lie."""
    folder = store.input_folder(recording)
    folder.mkdir(parents=True, exist_ok=True)
    if recording.recording:
        scans = recording.recording
        if (scans / "poses.txt").is_file():
            trajectory.write_tum(folder / "truth.tum", trajectory.read_kitti(scans))
        first = sorted((scans / "velodyne").glob("*.bin"))[0]
    else:
        scans = first = scratch / "scans"
        with scans.open("wb") as stream:
            command = [program.PROGRAM, "simulate", *recording.simulate, "-o", "-"]
            subprocess.run([*command, "--truth", folder / "truth.tum"], stdout=stream, check=True)
    with first.open("rb") as file:
        digest = hashlib.sha256(file.read(FINGERPRINT_BYTES))
    if store.truth(recording):
        digest.update(store.truth(recording).read_bytes())
    note = {"fingerprint": digest.hexdigest()[:16]}
    (folder / "scans.json").write_text(json.dumps(note) + "\n")
    return scans


def run(store, recording, scans, system, threads, scratch):
    print(f"{recording.name}: {system}, {threads} thread{'s' * (threads > 1)}", flush=True)
    output = scratch / f"{system}-t{threads}"
    if system == OURS:
        command = [program.PROGRAM, "run", scans, "-o", output, "--threads", threads, "--quiet"]
    else:
        output.mkdir()
        arguments = {**options(system, recording), "threads": threads}
        command = [store.peer_python(system), DRIVE, system, scans, output, json.dumps(arguments)]
    kept = store.run_folder(recording, system, threads)
    shutil.rmtree(kept, ignore_errors=True)
    kept.mkdir()
    try:
        usage = measure.run(command, threads, kept / "output.txt")
    except measure.ProcessError as error:
        print(f"{recording.name}: {system} failed, {error}", flush=True)
        return
    shutil.copy(output / "trajectory.tum", kept)
    poses = trajectory.read_tum(kept / "trajectory.tum")
    process = read_json(output / "process.json") or {"start_cpu_seconds": 0.0}
    record = {
        "made_with": made_with(system, recording),
        "scans_of": store.scans(recording)["fingerprint"],
        "commit": program.commit(),
        "scans": len(poses.stamps),
        **dataclasses.asdict(usage),
        "start_cpu_seconds": process["start_cpu_seconds"],
        "errors": errors(store.truth(recording), poses, scratch),
    }
    if system == OURS:
        record["stages"] = stages.of_run(output / "scans.csv")
    (kept / RECORD).write_text(json.dumps(record, indent=2) + "\n")


def errors(truth_path, estimate, scratch):
    """What `evaluate` says; None without a truth.

    A pose belongs to the moment that its points were moved to, which need not be the stamp of a
    scan: the truth is interpolated at the estimate's own stamps. Those after its end are left out.
    """
    if truth_path is None:
        return None
    truth = trajectory.read_tum(truth_path)
    known = np.count_nonzero(estimate.stamps <= truth.stamps[-1] + 1e-6)
    estimate = estimate.first(known)
    paths = scratch / "truth_there.tum", scratch / "estimate.tum"
    there = trajectory.Trajectory(estimate.stamps, truth.at(estimate.stamps))
    for path, poses in zip(paths, (there, estimate), strict=True):
        trajectory.write_tum(path, poses)
    report = program.evaluate(*paths)
    del report["estimate"]  # a path on this machine
    return report
