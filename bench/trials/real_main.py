# SPDX-License-Identifier: BSD-3-Clause
"""Runs LeGO-LOAM-SC, KISS-ICP and GenZ-ICP on real recordings and writes docs/robustness.md.

FOLDER holds recordings, each a folder of .bin or .pcd scans, a KITTI sequence or a .pcap. The
peers' runs are kept as long as the scans are the same.
"""

import argparse
import hashlib
import json
import pathlib
import re
import tempfile

import entropy
import judge
import numpy as np
import outcomes
import page
import recordings
from campaign_tables import reasons

import program
from markdown_page import fixed, table
from systems import OURS, TITLES

FOLDER = program.ROOT / "build/trials"
PEERS = ("kiss-icp", "genz-icp")


def parse():
    parser = argparse.ArgumentParser(
        prog="bench/real",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folders", type=pathlib.Path, nargs="+", metavar="FOLDER")
    parser.add_argument("--only", type=re.compile, metavar="REGEX", help="names of recordings")
    parser.add_argument("--program", type=pathlib.Path, default=program.PROGRAM)
    parser.add_argument("--again", action="store_true", help="repeat the peers' runs too")
    parser.add_argument(
        "--document",
        type=pathlib.Path,
        default=program.ROOT / "docs/robustness.md",
        help="[default: docs/robustness.md]",
    )
    return parser.parse_args()


def peer_options(peer, recording):
    """Their defaults; of GenZ-ICP's tuned files the one for the surroundings."""
    preset = "kitti" if recording.is_kitti else "outdoor"
    preset = "indoor" if recording.begins(recordings.INDOOR) else preset
    settings = {"preset": f"{preset}.yaml", "deskew": False} if peer == "genz-icp" else {}
    return {"settings": settings, "deskew": False, "kitti": recording.is_kitti}


def run_ours(recording, folder):
    sensor = recording.sensor
    options = ["--sensor", sensor] if sensor else []
    return outcomes.run_ours(recording.path, folder / OURS, *options)


def run_peer(peer, recording, stream, folder):
    options = peer_options(peer, recording)
    return outcomes.run_peer(peer, stream, folder / peer, options)


def crispness(recording, outcome):
    """Mean map entropy of all scans that have a pose."""
    if not recording.scans or len(outcome.numbers) < 2:
        return np.nan
    wanted = dict(zip(outcome.numbers.tolist(), outcome.trajectory.poses, strict=False))
    scans, poses = [], []
    for number, points in enumerate(recording.points()):
        if number in wanted:
            degrees = recordings.KITTI_CORRECTION_DEG if recording.is_kitti else 0.0
            scans.append(recordings.corrected(points, degrees) if degrees else points)
            poses.append(wanted[number])
    if not np.isfinite(poses).all():
        return np.nan
    return entropy.mean_map_entropy(entropy.accumulated(scans, poses))


def figures(recording, outcome):
    """What the table says of one run, JSON."""
    truth = recording.truth
    found = None
    if truth is not None and len(outcome.numbers) > 2:
        there = recordings.truth_at(truth, outcome.numbers)
        found = judge.errors(there, outcome.trajectory)
    path = float(outcome.trajectory.path[-1]) if len(outcome.numbers) else np.nan
    statuses = {name: outcome.statuses.count(name) for name in sorted(set(outcome.statuses))}
    scans = len(outcome.statuses) or len(recording.scans)
    return {
        "code": outcome.code,
        "scans": scans,
        "cpu_ms": 1000.0 * outcome.cpu_seconds / max(scans, 1),
        "path": path,
        "ate": found.ate if found else np.nan,
        "true_path": found.true_path if found else np.nan,
        "entropy": crispness(recording, outcome),
        "statuses": statuses,
        "verdict": outcome.summary.get("verdict", ""),
        "reasons": outcome.summary.get("verdict_reasons", []),
        "message": outcome.message if outcome.code != 0 else "",
    }


def peer_figures(peer, recording, stream, folder, kept):
    """Kept from an earlier time when scans, settings and the measure are the same."""
    digest = hashlib.blake2b(json.dumps(peer_options(peer, recording)).encode())
    digest.update(pathlib.Path(entropy.__file__).read_bytes())
    with stream.open("rb") as file:
        digest.update(hashlib.file_digest(file, "blake2b").digest())
    key = f"{recording.name} {peer} {digest.hexdigest()[:16]}"
    if key not in kept:
        kept[key] = figures(recording, run_peer(peer, recording, stream, folder))
    return kept[key]


def measure(recording, kept):
    with tempfile.TemporaryDirectory(prefix="real-", dir=FOLDER) as scratch:
        folder = pathlib.Path(scratch)
        runs = {OURS: figures(recording, run_ours(recording, folder))}
        if recording.scans:
            stream = folder / "scans"
            recording.write_stream(stream)
            for peer in PEERS:
                runs[peer] = peer_figures(peer, recording, stream, folder, kept)
    return runs


def cells(recording, system, run, best):
    statuses = ", ".join(f"{count} {name}" for name, count in run["statuses"].items())
    verdict = ": ".join(filter(None, [run["verdict"], reasons(run["reasons"])]))
    if run["code"] != 0:
        statuses = "no end" if run["code"] is None else f"exit code {run['code']}"
    path = "" if np.isnan(run["true_path"]) else f" of {run['true_path']:.2f}"
    path = " of 0" if recording.begins(recordings.STATIC) else path
    ate = fixed([run["ate"]], 3)[0] + (" (coarse)" if recording.begins(recordings.COARSE) else "")
    crisp = fixed([run["entropy"]], 3)[0]
    if system == OURS and run["entropy"] > best:
        crisp = f"**{crisp}**"
    length = fixed([run["path"]], 2)[0] + path
    cpu = fixed([run["cpu_ms"]], 1)[0]
    return [TITLES[system], str(run["scans"]), length, ate, crisp, cpu, statuses, verdict]


def tables(measured, known):
    header = ["recording", "system", "scans", "path (m)", "ATE (m)", "map entropy", "CPU (ms)"]
    header += ["statuses", "verdict"]
    rows = []
    for name, runs in measured.items():
        others = [r["entropy"] for s, r in runs.items() if s != OURS]
        best = np.nanmin(others) if np.isfinite(others).any() else np.inf
        for system, run in runs.items():
            title = f"`{name}`" if system == OURS else ""
            rows.append([title, *cells(known[name], system, run, best)])
    return table(header, rows)


def main():
    options = parse()
    program.PROGRAM = options.program.resolve()
    known = recordings.found(options.folders)
    for peer in PEERS:
        outcomes.peer_python(peer)
    FOLDER.mkdir(parents=True, exist_ok=True)
    store = FOLDER / "real-peers.json"
    kept = json.loads(store.read_text()) if store.is_file() and not options.again else {}
    measured = {}
    for name, recording in known.items():
        if options.only and not options.only.search(name):
            continue
        measured[name] = measure(recording, kept)
        store.write_text(json.dumps(kept, indent=1))
        print(tables({name: measured[name]}, known).split("\n", 2)[2], flush=True)
    page.keep({"recordings": tables(measured, known), "real_commit": program.identity()})
    page.write(options.document)


if __name__ == "__main__":
    main()
