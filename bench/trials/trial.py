# SPDX-License-Identifier: BSD-3-Clause
"""The drives of one simulation: simulates it, makes the scans of each, runs and judges."""

import dataclasses
import hashlib
import pathlib
import shutil
import subprocess
import tempfile

import judge
import numpy as np
import outcomes
import sensor_facts
from campaign import SENSOR_FILES, WORLDS
from troubles import Moment

import scan_stream
from systems import OURS
from trajectory import Trajectory, read_tum

PEER = "kiss-icp"
HERE = pathlib.Path(__file__).resolve().parent


def definition():
    """A hash of all that decides the scans of a drive but the simulator."""
    files = [HERE / "campaign.py", HERE / "troubles.py", *sorted(SENSOR_FILES.glob("*"))]
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:12]


@dataclasses.dataclass(frozen=True)
class Simulated:
    """The first scans of a simulation that would have `count`, as many as its drives need."""

    count: int
    stream: scan_stream.Stream
    truth: Trajectory
    compensated: bool
    sweep: float  # s


def simulate(simulation, drives, simulator, folder):
    scans, truth, sensor = folder / "all.scans", folder / "all.tum", simulation.sensor_argument
    lidar = sensor_facts.lidar(sensor)
    count = simulation.scans(sensor_facts.beams(sensor) * lidar.columns)
    needed = 1 + max(drive.sources(count)[-1] for drive in drives)
    command = [simulator, "simulate", *world(simulation, count, folder), "--seed"]
    command += [simulation.seed, "--count", needed, "--truth", truth, "-o", "-", "--sensor"]
    if simulation.is_tilted:
        tilted = folder / "tilted.yaml"
        tilted.write_text(sensor_facts.tilted(sensor, simulation.roll_deg, simulation.pitch_deg))
        command.append(tilted)
    else:
        command.append(sensor)
    with scans.open("wb") as stream:
        subprocess.run([str(word) for word in command], stdout=stream, check=True)
    compensated = sensor_facts.is_compensated(sensor)
    return Simulated(count, scan_stream.Stream(scans), read_tum(truth), compensated, lidar.period)


def world(simulation, count, folder):
    road = WORLDS[simulation.world]
    if road is None:
        return [simulation.world]
    path = folder / "route.tum"
    np.savetxt(path, road.poses(0.1 * count + 3.0), fmt="%.6f")
    return ["city", "--route", path]


def write_scans(drive, simulated, frames, path):
    """The scans of the drive with their troubles; returns a hash of the file."""
    stream, lidar = simulated.stream, sensor_facts.lidar(drive.simulation.sensor_argument)
    first = simulated.truth.stamps[frames[0].source]

    def scans():
        for frame in frames:
            seconds = simulated.truth.stamps[frame.source] - first
            scan = drive.changed(stream[frame.source], Moment(frame, seconds, lidar))
            yield dataclasses.replace(scan, stamp_ns=frame.stamp_ns)

    facts = [line for line in stream.facts.splitlines() if not line.startswith("sensor:")]
    text = "".join(line + "\n" for line in facts)
    with np.errstate(invalid="ignore"):
        scan_stream.write(path, drive.facts(text), scans())
    with path.open("rb") as file:
        return hashlib.file_digest(file, "blake2b").hexdigest()[:16]


def compared(outcome, frames, moments, truth):
    """The errors of a run, the share of the scans with a pose, and which scans were judged.

    `moments` are those of the true poses, one for each frame.
    """
    counts = np.array([frame.counts for frame in frames])
    judged = counts[outcome.numbers] if len(outcome.numbers) else np.empty(0, bool)
    numbers = outcome.numbers[judged]
    there = Trajectory(moments[numbers], truth.at(moments[numbers])) if len(numbers) else None
    estimate = judge.picked(outcome.trajectory, judged)
    found = judge.errors(there or truth.first(0), estimate)
    return found, len(numbers) / counts.sum(), numbers


def judged_ours(outcome, frames, truth):
    """The part of a record that says how ours did."""
    moments = np.array([truth.stamps[frame.source] for frame in frames])
    found, share, numbers = compared(outcome, frames, moments, truth)
    fine = judge.is_fine(found, share)
    verdict = outcome.summary.get("verdict", "")
    ends = [outcome.statuses[k] for k in numbers[1:]] or outcome.statuses
    said = judge.how_it_was_said(outcome.code, verdict, ends, found.steps)
    statuses = {name: outcome.statuses.count(name) for name in sorted(set(outcome.statuses))}
    return figures(outcome, found, share, len(frames)) | {
        "class": judge.classify(outcome.code, fine, said),
        "said": "" if fine else said,
        "verdict": verdict,
        "reasons": outcome.summary.get("verdict_reasons", []),
        "statuses": statuses,
    }


def judged_peer(outcome, frames, simulated, deskewed):
    """The same of the peer, which is fine or not."""
    truth = simulated.truth
    share_of_sweep = outcomes.REFERENCE[PEER] if deskewed else 0.5
    shift = 0.0 if simulated.compensated else share_of_sweep * simulated.sweep
    moments = np.array([truth.stamps[frame.source] + shift for frame in frames])
    found, share, _ = compared(outcome, frames, moments, truth)
    fine = outcome.code == 0 and judge.is_fine(found, share)
    return figures(outcome, found, share, len(frames)) | {
        "class": judge.FINE if fine else judge.SILENT
    }


def figures(outcome, found, share, scans):
    return {
        "code": outcome.code,
        "cpu_ms": 1000.0 * outcome.cpu_seconds / scans,
        "scans_read": scans,
        "poses": share,
        "ate": found.ate,
        "path": found.path,
        "true_path": found.true_path,
        "message": outcome.message if outcome.code != 0 else "",
    }


def run_drive(drive, simulated, have, store, made_with, with_peer, folder):
    """Runs ours on one drive, and the peer when it is wanted and not in `have`; keeps records."""
    scans = folder / f"{drive.name}.scans"
    frames = drive.frames(simulated.count, [round(1e9 * s) for s in simulated.truth.stamps])
    fingerprint = write_scans(drive, simulated, frames, scans)
    sensor = drive.simulation.sensor_argument
    head = {"drive": drive.name, "scans": fingerprint}
    outcome = outcomes.run_ours(scans, folder / f"{drive.name}-{OURS}", "--sensor", sensor)
    ours = judged_ours(outcome, frames, simulated.truth)
    store.add(head | {"system": OURS, "made_with": made_with} | ours)
    peer = have.get((drive.name, fingerprint))
    if peer is None and with_peer:
        deskewed = drive.deskew and not simulated.compensated
        kitti = drive.simulation.sensor == "kitti"
        options = {"settings": {}, "deskew": deskewed, "kitti": kitti}
        outcome = outcomes.run_peer(PEER, scans, folder / f"{drive.name}-{PEER}", options)
        peer = judged_peer(outcome, frames, simulated, deskewed)
        store.add(head | {"system": PEER} | peer)
    said = ours["verdict"] or ours["said"]
    line = f"{drive.name}: {ours['class']}{f' ({said})' if said else ''}, ATE {ours['ate']:.3f} m"
    line += f" of {ours['true_path']:.1f} m"
    print(line + (f"; {PEER} {peer['ate']:.3f} m" if peer else ""), flush=True)


def run_all(simulation, drives, simulator, have, store, made_with, with_peer, work, keep):
    """The drives of one simulation, in a folder that goes afterwards unless it is to be kept."""
    with tempfile.TemporaryDirectory(prefix="trial-", dir=work) as scratch:
        folder = pathlib.Path(scratch)
        simulated = simulate(simulation, drives, simulator, folder)
        for drive in drives:
            run_drive(drive, simulated, have, store, made_with, with_peer, folder)
            for path in folder.glob(f"{drive.name}*"):
                if keep is not None:
                    remove(keep / path.name)
                    shutil.move(path, keep / path.name)
                else:
                    remove(path)
        if keep is not None:
            shutil.move(folder / "all.tum", keep / f"{simulation.name}.tum")


def remove(path):
    """A file, a folder, or nothing when there is none."""
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
