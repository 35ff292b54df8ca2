# SPDX-License-Identifier: BSD-3-Clause
"""The page of `lego-loam-sc inspect`."""

import json
import os
import re
import shutil
import subprocess

import numpy as np
import pytest

from conftest import PROGRAM, needs_program
from lego_loam_sc.report.main import main
from lego_loam_sc.report.ply import positions_of, read_ply

pytestmark = needs_program


@pytest.fixture(scope="module")
def scans(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drive") / "scans"
    command = [PROGRAM, "simulate", "parking", "--sensor", "rs16", "--count", "1", "-o", folder]
    subprocess.run(command, check=True, capture_output=True)
    return folder


@pytest.fixture(scope="module")
def folder(scans, environment, tmp_path_factory):
    folder = tmp_path_factory.mktemp("look") / "<script>"
    command = [PROGRAM, "inspect", scans, "-o", folder]
    outcome = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.splitlines()[-1].startswith(f"report in {folder}/report.html")
    return folder


def data_of(page: str) -> dict:
    return json.loads(
        re.search(r'<script type="application/json" id="data">(.*?)</script>', page)[1]
    )


def test_the_page_shows_the_nearest_point_of_each_pixel_in_every_stage(folder):
    data = data_of((folder / "report.html").read_text())
    points = read_ply(folder / "rows.ply")
    assert (data["rows"], data["columns"]) == (16, 1800)
    assert sum(data["points"]) == len(points)
    ranges = np.linalg.norm(positions_of(points), axis=1)
    pixels = points["row"].astype(int) * data["columns"] + points["column"]
    for pixel in np.unique(pixels)[::500]:
        there = np.flatnonzero(pixels == pixel)
        nearest = there[np.argmin(ranges[there])]
        assert data["range"][pixel] == pytest.approx(1000 * ranges[nearest], abs=1)
        for name in ("ground", "cluster", "feature"):
            assert data[name][pixel] == points[name][nearest]
    seen = [value is not None for value in data["range"]]
    assert sum(seen) == len(np.unique(pixels))
    for name in ("intensity", "ground", "cluster", "sharpness", "feature"):
        assert len(data[name]) == len(seen)


def test_the_page_holds_what_inspect_printed_and_needs_nothing_else(folder):
    page = (folder / "report.html").read_text()
    assert json.loads((folder / "stages.json").read_text())["summary"].splitlines()[0] in page
    assert not re.search(r"""(src|href)=["']?http""", page)


def test_a_folder_that_lacks_the_cloud_ends_in_one_sentence(folder, tmp_path, capsys):
    shutil.copy(folder / "stages.json", tmp_path)
    assert main([str(tmp_path)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert "rows.ply cannot be read" in line


def test_inspect_without_the_companion_leaves_the_clouds_and_says_so(scans, tmp_path):
    lonely = tmp_path / "bin" / "lego-loam-sc"
    lonely.parent.mkdir()
    shutil.copy(PROGRAM, lonely)
    result = tmp_path / "result"
    command = [lonely, "inspect", scans, "-o", result]
    outcome = subprocess.run(
        command, env={**os.environ, "PATH": "/nowhere"}, capture_output=True, text=True
    )
    assert outcome.returncode == 0
    (sentence,) = outcome.stderr.splitlines()
    assert "scripts/setup" in sentence and f"lego-loam-sc report {result}" in sentence
    assert (result / "rows.ply").exists() and not (result / "report.html").exists()
