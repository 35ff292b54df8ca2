# SPDX-License-Identifier: BSD-3-Clause
"""`lego-loam-sc report`: the page itself, and what it does in headless Chromium."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from conftest import PROGRAM, needs_program
from lego_loam_sc.report import geometry
from lego_loam_sc.report.main import main
from lego_loam_sc.report.results import read_results

CHROMIUM = shutil.which("chromium")
# Software WebGL, and nothing that asks the network.
FLAGS = (
    "--no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync --use-gl=angle --use-angle=swiftshader "
    "--enable-unsafe-swiftshader"
).split()
LOOPY = [
    *("--set", "loop.min_travel=3"),
    *("--set", "loop.spacing=0.5"),
    *("--set", "key_frames.distance=1"),
]

pytestmark = needs_program


@pytest.fixture(scope="module")
def scans(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drive") / "scans"
    command = [PROGRAM, "simulate", "parking", "--sensor", "rs16", "--count", "60", "-o", folder]
    subprocess.run(command, check=True, capture_output=True)
    return folder


@pytest.fixture(scope="module")
def run(scans, environment, tmp_path_factory):
    """A run with loops, and its report."""
    folder = tmp_path_factory.mktemp("run") / "a <run>"
    command = [PROGRAM, "run", scans, "-o", folder, "--truth", scans / "truth.tum", "--report"]
    outcome = subprocess.run([*command, *LOOPY], env=environment, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.splitlines()[-1].startswith(f"report in {folder}/report.html")
    return folder


def copy_run(run: Path, folder: Path, *without: str) -> Path:
    shutil.copytree(run, folder, ignore=shutil.ignore_patterns("report.html", *without))
    return folder


def test_the_page_needs_nothing_but_itself(run):
    page = (run / "report.html").read_text()
    outside_scripts = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert len(outside_scripts) < 100_000
    assert not re.search(r"(src|href)\s*=|@import|url\(", outside_scripts)
    assert not re.search(r"<script[^>]*\bsrc", page)


def test_the_page_tells_the_run_its_errors_and_its_settings(run):
    page = (run / "report.html").read_text()
    for text in ("<h1>scans</h1>", "60 in 5.9 s", "Errors against the truth", "ATE, RMSE (m)"):
        assert text in page
    assert "min_travel: 3 " in page  # of settings.yaml
    assert "rs16, " in page
    health = json.loads((run / "summary.json").read_text())["health"]
    assert health["inliers"]["warnings"] > 0
    assert f"inliers: {health['inliers']['warnings']} warnings, " in page
    assert "error at the end, z (m)" in page


def test_the_same_run_gives_the_same_page(run, tmp_path):
    assert main([str(run), "--quiet", "-o", str(tmp_path / "again.html")]) == 0
    assert (tmp_path / "again.html").read_bytes() == (run / "report.html").read_bytes()


def test_the_map_is_thinned_to_what_is_asked_for(run):
    results = read_results(run)
    assert len(results.map) > 5000
    part = geometry.scene(results, 5000)["map"]
    assert (part["count"], part["total"]) == (5000, len(results.map))


def test_a_loop_is_drawn_as_the_truth_has_it_after_icp_and_as_guessed_before(run, scans):
    truth = np.loadtxt(scans / "truth.tum")
    accepted = [loop for loop in geometry.loops(read_results(run)) if loop["accepted"]]
    assert {loop["detector"] for loop in accepted} == {"scan_context", "radius"}
    for loop in accepted:
        match, query = (truth[int(loop[name])] for name in ("match_scan", "query_scan"))
        before, after = (np.reshape(loop[name], (4, 4)).T for name in ("before", "after"))
        error = np.linalg.inv(geometry.relative(match, query)) @ after
        assert np.linalg.norm(error[:3, 3]) < 0.1
        assert np.trace(error[:3, :3]) > 1 + 2 * np.cos(np.radians(1.5))
        guessed = np.linalg.inv(before) @ after
        # Scan Context guesses; what looks alike from both directions it may turn round, and ICP has
        # then started from the pose graph.
        angle = np.arccos(np.clip((np.trace(guessed[:3, :3]) - 1) / 2, -1, 1))
        assert min(angle, np.pi - angle) < np.radians(15.0)
        if loop["detector"] == "radius":  # as the odometry has it
            assert np.linalg.norm(guessed[:3, 3]) < 0.2
        else:  # one on the other
            assert not before[:3, 3].any()


def test_a_killed_run_is_shown_as_far_as_it_went(run, tmp_path):
    ended = ("summary.json", "trajectory*", "map.*", "loop_scans.ply", "graph.g2o")
    folder = copy_run(run, tmp_path / "killed", *ended)
    table = (folder / "scans.csv").read_text()
    (folder / "scans.csv").write_text(table[: len(table) - 40])  # in the middle of a line
    assert main([str(folder)]) == 0
    page = (folder / "report.html").read_text()
    assert "<h1>killed (ended early)</h1>" in page
    assert "59 in 5.9 s" in page


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("scans.csv", None, "scans.csv is missing"),
        ("scans.csv", "scan,stamp,status\n", "has no scan"),
        ("odometry.tum", "", "holds no pose"),
        ("trajectory.tum", "0 0 0 0 0 0 0 1\n", "are of different runs"),
        ("map.ply", "ply\nend_header\n", "map.ply is not as this version writes it"),
        ("map.ply", None, "map.ply cannot be read"),
        ("summary.json", "{", "summary.json is no JSON"),
        ("summary.json", "{}", "do not fit together"),
        ("loops.csv", "query_scan,match_scan,verdict\n7000,1,accepted\n", "do not fit together"),
    ],
)
def test_a_folder_that_is_no_whole_run_is_refused_in_one_sentence(
    run, tmp_path, capsys, name, content, sentence
):
    folder = copy_run(run, tmp_path / "bad", name)
    if content is not None:
        (folder / name).write_text(content)
    assert main([str(folder)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("lego-loam-sc-report: ") and sentence in line
    assert not (folder / "report.html").exists()


def test_a_run_without_the_companion_is_whole_but_for_the_report(scans, tmp_path):
    lonely = tmp_path / "bin" / "lego-loam-sc"
    lonely.parent.mkdir()
    shutil.copy(PROGRAM, lonely)
    result = tmp_path / "result"
    command = [lonely, "run", scans, "--count", "2", "--quiet", "--report", "-o", result]
    outcome = subprocess.run(command, env={"PATH": "/nowhere"}, capture_output=True, text=True)
    assert outcome.returncode == 1
    (sentence,) = outcome.stderr.splitlines()
    assert "scripts/setup" in sentence and f"lego-loam-sc report {result}" in sentence
    assert (result / "summary.json").exists()


@pytest.fixture(scope="module")
def page(run, tmp_path_factory):
    """The report in Chromium, loaded; what it complained about is in `page.complaints`."""
    if CHROMIUM is None:
        pytest.skip("chromium is not installed; scripts/setup tests installs it")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        context = playwright.chromium.launch_persistent_context(
            tmp_path_factory.mktemp("profile"),
            executable_path=CHROMIUM,
            args=FLAGS,
            offline=True,
            viewport={"width": 900, "height": 700},
        )
        page = context.pages[0]
        page.complaints = []
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.on(
            "console",
            lambda message: message.type == "error" and page.complaints.append(message.text),
        )
        page.on(
            "request",
            lambda request: (
                request.url.startswith(("file:", "data:", "blob:"))
                or page.complaints.append(request.url)
            ),
        )
        page.set_default_timeout(120_000)  # however busy the machine is
        page.goto((run / "report.html").as_uri())
        page.wait_for_selector("body[data-ready]")
        yield page
        context.close()


def inked(page, canvas: str, left: float = 0.0, right: float = 1.0) -> int:
    """How many pixels of a part of a canvas are not white."""
    return page.evaluate(
        """([selector, left, right]) => {
          const canvas = document.querySelector(selector), copy = document.createElement("canvas");
          [copy.width, copy.height] = [canvas.width, canvas.height];
          const context = copy.getContext("2d");
          context.drawImage(canvas, 0, 0);
          const begin = Math.round(left * copy.width), end = Math.round(right * copy.width);
          const { data } = context.getImageData(begin, 0, end - begin, copy.height);
          let count = 0;
          for (let i = 0; i < data.length; i += 4)
            count += data[i] + data[i + 1] + data[i + 2] < 740 ? 1 : 0;
          return count;
        }""",
        [canvas, left, right],
    )


def test_the_page_loads_without_a_complaint_and_draws_the_map(page):
    assert page.complaints == []
    assert inked(page, "#map canvas") > 20_000
    assert page.locator("#charts .xy, #charts .x2y2, #charts .x3y3, #charts .x4y4").count() >= 4
    assert page.complaints == []


def test_the_map_can_be_coloured_in_other_ways(page):
    pictures = set()
    for colour in ("height", "height over the LiDAR", "intensity", "time"):
        page.select_option("#colour", label=colour)
        page.wait_for_timeout(300)
        pictures.add(page.evaluate("document.querySelector('#map canvas').toDataURL()"))
    assert len(pictures) == 4


def test_dragging_turns_the_map(page):
    before = page.evaluate("view.camera.position.toArray()")
    page.locator("#map").scroll_into_view_if_needed()
    box = page.locator("#map canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 120, y + 40, steps=3)
    page.mouse.up()
    assert page.evaluate("view.camera.position.toArray()") != before


def test_a_click_on_a_loop_shows_its_two_scans(page):
    rows = page.locator("#loops tbody tr")
    assert rows.count() >= 2
    for row in (rows.nth(0), rows.nth(1)):
        row.click()
        query, match = (row.locator("td").nth(k).inner_text() for k in (0, 1))
        facts = page.locator("#pairFacts").inner_text()
        assert facts.startswith(f"Key frame {query} ") and f"key frame {match} " in facts
        page.wait_for_timeout(300)
        assert inked(page, "#pair canvas", 0.0, 0.5) > 1000
        assert inked(page, "#pair canvas", 0.5, 1.0) > 1000
    assert page.complaints == []


def test_a_click_on_a_loop_in_the_map_selects_it(page):
    page.locator("#loops tbody tr").last.click()
    page.locator("#top").click()
    page.locator("#map").scroll_into_view_if_needed()
    x, y = page.evaluate(
        """() => {
          const spot = new THREE.Vector3(...accepted[0].place[1]).project(view.camera);
          const { x, y, width, height } = mapCanvas.getBoundingClientRect();
          return [x + (spot.x + 1) / 2 * width, y + (1 - spot.y) / 2 * height];
        }"""
    )
    page.mouse.click(x, y)
    expected = page.locator("#loops tbody tr").first.get_attribute("data-loop")
    assert page.locator("tr.selected").get_attribute("data-loop") == expected


def test_refused_candidates_are_listed_with_the_reason(page):
    refused = page.locator("#refused tbody tr")
    assert refused.count() > 0
    page.locator("#refused summary").click()
    assert refused.first.locator("td").last.inner_text() != ""
