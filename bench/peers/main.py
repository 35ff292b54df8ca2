# SPDX-License-Identifier: BSD-3-Clause
"""Runs LeGO-LOAM-SC and its peers on the same scans and writes docs/peers.md.

Runs that are there already are not repeated, unless the program, the settings or the scans have
changed: after a rebuild, only lego-loam-sc runs again. The document is made of all runs there.
"""

import argparse
import pathlib

import document
import runs
from inputs import inputs

from program import ROOT
from systems import PEERS, SYSTEMS


def parse():
    parser = argparse.ArgumentParser(
        prog="bench/peers/run",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real sequences")
    parser.add_argument("--route", type=pathlib.Path, help="KITTI poses, the route of kitti00")
    parser.add_argument("--inputs", nargs="+", metavar="INPUT", help="run these [default: all]")
    parser.add_argument(
        "--systems", nargs="+", choices=SYSTEMS, default=SYSTEMS, help="run these [default: all]"
    )
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2], help="[default: 1 2]")
    parser.add_argument(
        "--again", nargs="+", choices=SYSTEMS, default=[], help="repeat the runs of these"
    )
    parser.add_argument(
        "--work",
        type=pathlib.Path,
        default=ROOT / "build/peers",
        help="folder of the scans of one world at a time, up to 13 GB [default: build/peers]",
    )
    parser.add_argument("--document-only", action="store_true", help="run nothing")
    options = parser.parse_args()
    known = inputs(options.data, options.route)
    if unknown := set(options.inputs or known) - set(known):
        parser.error(f"--inputs: there is no {', '.join(unknown)}, but {', '.join(known)}")
    return options, known


def main():
    options, known = parse()
    store = runs.Store(ROOT / "build/peers/results")
    for peer in [] if options.document_only else set(options.systems) & set(PEERS):
        store.peer_python(peer)
    for name in [] if options.document_only else options.inputs or known:
        if known[name].is_at_hand:
            systems, again = options.systems, options.again
            runs.ensure(store, known[name], systems, options.threads, options.work, again)
        else:
            print(f"{name}: left out, it needs --data")
    document.write(store, known.values(), ROOT / "docs/peers.md")


if __name__ == "__main__":
    main()
