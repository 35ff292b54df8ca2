# SPDX-License-Identifier: BSD-3-Clause
"""Every command and every piece of Python on the pages is executed, on drives of a few scans."""

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from conftest import PROGRAM, ROOT, needs_program, parse_stream
from made_bags import storage_file, write_scans
from test_capture import pcap

SCANS = 12
PAGES = ["README.md", "CONTRIBUTING.md", *sorted(f"docs/{p.name}" for p in ROOT.glob("docs/*.md"))]

# What is not executed here, and why.
ELSEWHERE = {
    r"scripts/(test|docs|fuzz)\b": ".ci/run does",
    r"scripts/build\b|cmake --preset release &&": "scripts/test does",
    r"cmake --preset release -D|build/release/bench|scripts/(bench|lint)": "compiles for minutes",
    r"bench/(paper|peers)/run": "takes hours",
    r"bench/(robustness|real)": "takes most of an hour, on recordings that are elsewhere",
    r"pip install": "scripts/setup does for the readers, scripts/bindings for the rest",
    r"pipx run": "downloads its tools",
}
# What the reader of a page has, for its Python.
GIVEN = {
    "docs/library.md": """
import lego_loam_sc
my_scans = [(s.points, s.offsets, s.rings, s.stamp) for s in lego_loam_sc.open_scans("vlp16.scans")]
""",
    "docs/scan-stream.md": """
from conftest import parse_stream
scans = [(s.stamp_ns, s.points, s.ring) for s in parse_stream(open("vlp16.scans", "rb").read())[1]]
""",
}

pytestmark = needs_program


class Block(NamedTuple):
    language: str
    text: str


def blocks_of(page: str) -> list[Block]:
    fenced = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    return [Block(*match) for match in fenced.findall((ROOT / page).read_text())]


def commands_of(page: str) -> list[str]:
    """The lines of its shell blocks, without comments, joined where they go on."""
    text = "".join(block.text for block in blocks_of(page) if block.language == "sh")
    lines = (
        re.sub(r"(^|\s)#.*", "", line).strip() for line in text.replace("\\\n", "").splitlines()
    )
    return [line for line in lines if line]


def is_elsewhere(command: str) -> bool:
    return any(re.search(pattern, command) for pattern in ELSEWHERE)


def cut(command: str) -> str:
    """The same command on few scans."""
    command = re.sub(r"--first \d+", "--first 2", command)
    command = re.sub(r" --count \d+", "", command)
    command = re.sub(r"simulate \w+", rf"\g<0> --count {SCANS}", command)
    return re.sub(r"scripts/demo", rf"\g<0> {SCANS}", command)


def simulate(world: str, sensor: str, output: Path | str) -> bytes:
    command = [PROGRAM, "simulate", world, "--sensor", sensor, "--count", str(SCANS), "-o", output]
    return subprocess.run(command, check=True, capture_output=True).stdout


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    """A folder with the recordings, and the earlier run, that the pages name."""
    folder = tmp_path_factory.mktemp("stage")
    simulate("parking", "rs16", folder / "scans")
    command = [PROGRAM, "run", folder / "scans", "-o", folder / "result"]
    subprocess.run(command, check=True, capture_output=True)
    for name in ("vlp16_corridor", "hdl32_outdoor"):
        (folder / name).symlink_to("scans")
    stream = simulate("parking", "vlp16", "-")
    (folder / "vlp16.scans").write_bytes(stream)
    for name, kind in (("drive.bag", "ros1"), ("drive.mcap", "mcap")):
        bag = write_scans(folder, kind, "/velodyne_points", parse_stream(stream)[1])
        (folder / name).symlink_to(storage_file(bag))
    (folder / "drive.pcap").write_bytes(pcap())

    simulate("street", "kitti", folder / "kitti_odometry_04")
    (folder / "sequences").mkdir()
    (folder / "sequences/00").symlink_to("../kitti_odometry_04")
    (folder / "poses").mkdir()
    shutil.copy(folder / "kitti_odometry_04/poses.txt", folder / "poses/00.txt")
    route = "".join(f"1 0 0 0 0 1 0 0 0 0 1 {z}\n" for z in range(60))  # m, straight ahead
    (folder / "poses.txt").write_text(route)
    for number, name in enumerate(("000720", "001500", "000094", "000095")):
        scan = folder / f"kitti_odometry_04/velodyne/00000{number}.bin"
        (folder / f"{name}.bin").symlink_to(scan)

    (folder / "bin").mkdir()
    (folder / "bin/driver").write_text("#!/bin/sh\nexec cat vlp16.scans\n")
    (folder / "bin/driver").chmod(0o755)
    return folder


@pytest.fixture
def desk(stage, tmp_path):
    """What the reader of a page has before the first command."""
    for path in stage.iterdir():
        (tmp_path / path.name).symlink_to(path)
    return tmp_path


def remove(path: Path) -> None:
    if path.is_symlink() or path.is_file():
        path.unlink()
    elif path.exists():
        shutil.rmtree(path)


def execute(command: str, desk: Path, environment: dict[str, str]) -> None:
    for output in re.findall(r"-o (\w\S*)", command):
        remove(desk / output)
    in_checkout = command.startswith(("scripts/", "cmake "))
    environment = {**environment, "HOME": str(desk)}
    environment["PATH"] = f"{desk}/bin:{environment['PATH']}"
    words = ["bash", "-euo", "pipefail", "-c", cut(command)]
    place = ROOT if in_checkout else desk
    done = subprocess.run(words, cwd=place, env=environment, capture_output=True, text=True)
    for folder in re.findall(r"demo/\d+(?=/scans )", done.stdout):
        remove(ROOT / folder)
    assert done.returncode == 0, f"{command}\n{done.stderr}"


@pytest.mark.parametrize("page", [page for page in PAGES if commands_of(page)])
def test_every_command_of_a_page_works(page, desk, environment):
    files = [block.text for block in blocks_of(page) if block.language == "yaml"]
    if files:  # the page's first file is the reader's own
        (desk / "mine.yaml").write_text(files[0])
    for command in commands_of(page):
        if not is_elsewhere(command):
            execute(command, desk, environment)


def anchors_of(page: Path) -> set[str]:
    """As GitHub makes them of the headings."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", [*PAGES, "python/README.md"])
def test_the_links_of_a_page_lead_somewhere(page):
    for target in re.findall(r"\]\((?!https?:)([^)\s]+)\)", (ROOT / page).read_text()):
        path, _, anchor = target.partition("#")
        found = (ROOT / page).parent / path if path else ROOT / page
        assert found.exists(), target
        assert not anchor or anchor in anchors_of(found), target


@pytest.mark.parametrize("page", PAGES)
def test_the_sources_that_a_page_names_exist(page):
    for name in re.findall(r"`(\w[\w/]+/\w+\.(?:cpp|hpp|py|sh))`", (ROOT / page).read_text()):
        assert any((ROOT / place / name).exists() for place in ("", "src")), name


def test_the_tour_leads_to_what_is_there():
    rows = re.findall(
        r"^\|.*\| (`.*/.*`) \| (`.*`).* \|$", (ROOT / "docs/tour.md").read_text(), re.M
    )
    assert len(rows) > 25
    for files, names in rows:
        sources = [ROOT / "src" / file for file in re.findall(r"`(.*?)`", files)]
        text = "".join(source.read_text() for source in sources)
        for name in re.findall(r"`(.*?)`", names):
            assert re.search(rf"\b{name.split('::')[-1]}\b", text), (files, name)


def test_settings_that_a_page_names_exist():
    known = set(
        re.findall(r"^\| `(\w+\.[\w.]+)` \|", (ROOT / "docs/settings.md").read_text(), re.M)
    )
    groups = {name.rsplit(".", 1)[0] for name in known}
    of_a_group = re.compile(rf"`((?:{'|'.join(groups)})\.[a-z_.]+)`")
    for page in PAGES:
        for name in of_a_group.findall((ROOT / page).read_text()):
            is_file = name.endswith((".md", ".cpp", ".hpp", ".tum", ".g2o"))
            assert is_file or name in known | groups, (page, name)


def test_what_is_executed_elsewhere_is_on_a_page():
    commands = [command for page in PAGES for command in commands_of(page)]
    for pattern in ELSEWHERE:
        assert any(re.search(pattern, command) for command in commands), pattern
    assert sum(not is_elsewhere(command) for command in commands) > 40


@pytest.mark.parametrize("page", ["docs/library.md", "docs/report.md", "docs/scan-stream.md"])
def test_the_python_of_a_page_works(page, desk, environment):
    (code,) = (block.text for block in blocks_of(page) if block.language == "python")
    if "import lego_loam_sc as" in code and not importlib.util.find_spec("lego_loam_sc._core"):
        pytest.skip("the bindings are not built")
    words = [sys.executable, "-c", GIVEN.get(page, "") + code]
    environment = {**environment, "PYTHONPATH": str(Path(__file__).parent)}
    done = subprocess.run(words, cwd=desk, env=environment, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    if page == "docs/scan-stream.md":
        (desk / "written.scans").write_bytes(done.stdout)
        execute("lego-loam-sc run written.scans -o again --quiet", desk, environment)
        assert len((desk / "again/trajectory.tum").read_text().splitlines()) == SCANS
