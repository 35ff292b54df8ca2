# SPDX-License-Identifier: BSD-3-Clause
"""`lego-loam-sc run BAG`, when the program is built."""

import os
import signal
import subprocess
import time

import pytest

from conftest import PROGRAM, needs_program, parse_stream
from made_bags import copy_bag, write_scans

SCANS = 12

pytestmark = needs_program


@pytest.fixture(scope="module")
def simulated(tmp_path_factory):
    """A simulated drive as a scan stream and as a bag of the same scans."""
    folder = tmp_path_factory.mktemp("drive")
    command = [PROGRAM, "simulate", "parking", "--sensor", "rs16", "--count", str(SCANS), "-o", "-"]
    stream = subprocess.run(command, check=True, capture_output=True).stdout
    (folder / "drive.scans").write_bytes(stream)
    facts, scans = parse_stream(stream)
    (folder / "dataset.yaml").write_text(facts)
    return folder, write_scans(folder, "ros1", "/points", scans)


def run(environment, *words):
    command = [PROGRAM, "run", *words]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=50)


def test_a_bag_gives_the_same_trajectory_as_the_stream_of_its_scans(
    simulated, environment, tmp_path
):
    folder, bag = simulated
    for source, result in ((folder / "drive.scans", "a"), (bag, "b")):
        outcome = run(environment, source, "--quiet", "-o", tmp_path / result)
        assert (outcome.returncode, outcome.stderr) == (0, "")
    trajectories = [(tmp_path / name / "trajectory.tum").read_text() for name in "ab"]
    assert trajectories[0] == trajectories[1]
    assert len(trajectories[0].splitlines()) == SCANS


def test_a_bag_that_is_cut_off_is_run_as_far_as_it_goes(simulated, environment, tmp_path):
    _, bag = simulated
    data = bag.read_bytes()
    cut = copy_bag(bag, tmp_path / "cut", data[: len(data) * 3 // 4])
    (tmp_path / "cut/dataset.yaml").write_text((bag.parent / "dataset.yaml").read_text())
    outcome = run(environment, cut, "--quiet", "-o", tmp_path / "result")
    assert outcome.returncode == 1
    (sentence,) = outcome.stderr.splitlines()
    assert "cut off" in sentence
    poses = (tmp_path / "result/trajectory.tum").read_text().splitlines()
    assert SCANS // 2 < len(poses) < SCANS
    assert "was not read in full" in (tmp_path / "result/summary.json").read_text()


def test_a_refusal_of_the_reader_is_the_only_sentence(simulated, environment, tmp_path):
    _, bag = simulated
    outcome = run(environment, bag, "--quiet", "--topic", "/none", "-o", tmp_path / "result")
    assert outcome.returncode == 1
    assert outcome.stderr.startswith(f"lego-loam-sc-read: {bag}: the topic /none is not there;")
    assert "lego-loam-sc: " not in outcome.stderr
    assert not (tmp_path / "result").exists()


def test_a_missing_companion_is_told_with_the_way_to_install_it(simulated, tmp_path):
    _, bag = simulated
    lonely = tmp_path / "bin" / "lego-loam-sc"
    lonely.parent.mkdir()
    lonely.write_bytes(PROGRAM.read_bytes())
    lonely.chmod(0o755)
    command = [lonely, "run", bag, "-o", tmp_path / "result"]
    outcome = subprocess.run(command, env={"PATH": "/nowhere"}, capture_output=True, text=True)
    assert outcome.returncode == 1
    (sentence,) = outcome.stderr.splitlines()
    assert "scripts/setup" in sentence and "pip install ." in sentence


def test_a_reader_that_breaks_off_is_told_and_its_scans_count(simulated, tmp_path):
    folder, bag = simulated
    script = tmp_path / "lego-loam-sc-read"
    script.write_text(f'#!/bin/sh\ncat "{folder / "drive.scans"}"\nkill -9 $$\n')
    script.chmod(0o755)
    copy = tmp_path / "bin"
    copy.mkdir()
    program = copy / "lego-loam-sc"
    program.write_bytes(PROGRAM.read_bytes())
    program.chmod(0o755)
    environment = {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    command = [program, "run", bag, "--quiet", "-o", tmp_path / "result"]
    outcome = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert outcome.returncode == 1
    (sentence,) = outcome.stderr.splitlines()
    assert "failed with code 137" in sentence
    assert len((tmp_path / "result/trajectory.tum").read_text().splitlines()) == SCANS


def test_an_interrupt_finishes_the_files_and_ends_the_reader(simulated, environment, tmp_path):
    folder, bag = simulated
    # A reader that goes quiet behind the scans, as on a slow disk.
    waiting = tmp_path / "lego-loam-sc-read"
    waiting.write_text(f'#!/bin/sh\ncat "{folder / "drive.scans"}"\nexec sleep 30\n')
    waiting.chmod(0o755)
    program = tmp_path / "bin" / "lego-loam-sc"
    program.parent.mkdir()
    program.write_bytes(PROGRAM.read_bytes())
    program.chmod(0o755)
    process = subprocess.Popen(
        [program, "run", bag, "--quiet", "-o", tmp_path / "result"],
        env={"PATH": f"{tmp_path}:{os.environ['PATH']}"},
        stderr=subprocess.PIPE,
        text=True,
    )
    trajectory = tmp_path / "result/scans.csv"
    while not trajectory.exists() or len(trajectory.read_text().splitlines()) <= SCANS:
        assert process.poll() is None
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=20) == 0
    assert len((tmp_path / "result/trajectory.tum").read_text().splitlines()) == SCANS
