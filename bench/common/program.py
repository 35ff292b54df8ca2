# SPDX-License-Identifier: BSD-3-Clause
"""The program under test, called as a user calls it."""

import hashlib
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = ROOT / "build/release/lego-loam-sc"


def call(*arguments):
    """Runs the program and returns what it prints; its error message ends this script."""
    command = [str(argument) for argument in (PROGRAM, *arguments)]
    try:
        result = subprocess.run(command, text=True, capture_output=True)
    except FileNotFoundError:
        sys.exit(f"{PROGRAM} does not exist: build it with cmake --build --preset release")
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}: {result.stderr.strip()}")
    return result.stdout


def version():
    """Version and a hash of the program's bytes, so that a rebuilt program counts as another."""
    digest = hashlib.sha256(PROGRAM.read_bytes()).hexdigest()
    return f"{call('--version').strip()} ({digest[:12]})"


def commit():
    """The checked out commit, with a plus when files differ from it."""
    git = ["git", "-C", ROOT, "describe", "--always", "--exclude=*", "--dirty=+"]
    result = subprocess.run(git, text=True, capture_output=True)
    return result.stdout.strip() or "unknown"


def identity():
    """Of the program under test: the commit, and the hash when it is not of this build folder."""
    own = PROGRAM.resolve() == (ROOT / "build/release/lego-loam-sc").resolve()
    return commit() if own else f"unknown, {PROGRAM.name} {version()}"


def evaluate(truth, estimate):
    """What `lego-loam-sc evaluate --json` says about one estimate."""
    return json.loads(call("evaluate", truth, estimate, "--json"))[0]
