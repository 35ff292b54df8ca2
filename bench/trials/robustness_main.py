# SPDX-License-Identifier: BSD-3-Clause
"""Runs a seeded campaign of short drives with troubles and writes docs/robustness.md.

Drives that have run already are not repeated unless the program or the campaign has changed; the
runs of KISS-ICP are kept as long as the scans are the same. The page is made of all runs there.
"""

import argparse
import collections
import concurrent.futures
import multiprocessing
import os
import pathlib
import re

import campaign
import campaign_tables
import outcomes
import page
import trial
from results_store import Store

import program
from systems import OURS

FOLDER = program.ROOT / "build/trials"


def parse():
    parser = argparse.ArgumentParser(
        prog="bench/robustness",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=int, default=320, help="drives [default: 320]")
    parser.add_argument("--only", type=re.compile, metavar="REGEX", help="names of drives to run")
    parser.add_argument("--seed", type=int, default=1, help="of the whole campaign [default: 1]")
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count(), help="drives at a time [default: all cores]"
    )
    parser.add_argument("--program", type=pathlib.Path, default=program.PROGRAM)
    parser.add_argument(
        "--simulator", type=pathlib.Path, help="program that simulates [default: the same]"
    )
    parser.add_argument("--again", action="store_true", help="repeat runs of ours that are there")
    parser.add_argument(
        "--keep", type=pathlib.Path, help="keep the scans, the truth and the results in a folder"
    )
    parser.add_argument(
        "--without-peer", action="store_true", help="run KISS-ICP on no more drives than it has"
    )
    parser.add_argument("--list", action="store_true", help="print the drives and run nothing")
    parser.add_argument("--document-only", action="store_true", help="run nothing")
    parser.add_argument(
        "--document",
        type=pathlib.Path,
        default=program.ROOT / "docs/robustness.md",
        help="[default: docs/robustness.md]",
    )
    return parser.parse_args()


def run(options, drives, store, made_with):
    records = store.all()
    peers = {(r["drive"], r["scans"]): r for r in records if r["system"] == trial.PEER}
    done = {
        r["drive"]
        for r in records
        if r["system"] == OURS
        and r["made_with"] == made_with
        and (options.without_peer or (r["drive"], r["scans"]) in peers)
    }
    wanted = collections.defaultdict(list)
    for drive in drives:
        if options.again or drive.name not in done:
            wanted[drive.simulation].append(drive)
    if not options.without_peer:
        outcomes.peer_python(trial.PEER)
    fork = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(options.jobs, mp_context=fork) as pool:
        simulator = (options.simulator or program.PROGRAM).resolve()
        running = [
            pool.submit(
                trial.run_all,
                *(simulation, some, simulator, peers, store, made_with),
                *(not options.without_peer, FOLDER, options.keep),
            )
            for simulation, some in wanted.items()
        ]
        for future in concurrent.futures.as_completed(running):
            future.result()


def main():
    options = parse()
    program.PROGRAM = options.program.resolve()
    drives = campaign.drives(options.seed, options.count)
    if options.only:
        drives = [drive for drive in drives if options.only.search(drive.name)]
    if options.list:
        for drive in drives:
            print(drive.name, dict(drive.troubles))
        return
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    store = Store(FOLDER / f"robustness-{options.seed}.jsonl")
    made_with = {"program": program.version(), "campaign": trial.definition()}
    if not options.document_only:
        run(options, drives, store, made_with)
    found = campaign_tables.results(store.all(), drives, made_with)
    print(campaign_tables.summary(found))
    page.keep(
        {
            "campaign": campaign_tables.by_class(found),
            "campaign_goals": campaign_tables.goals(found),
            "campaign_commit": f"{program.identity()}, seed {options.seed}, {len(found)} drives",
            "silent": campaign_tables.silent(found, options.seed),
            "doubted": campaign_tables.doubted(found),
            "troubles": campaign_tables.troubles(),
        }
    )
    page.write(options.document)


if __name__ == "__main__":
    main()
