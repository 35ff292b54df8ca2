# SPDX-License-Identifier: BSD-3-Clause
"""The compiled part, when it is built: scripts/bindings or pip install . builds it."""

import ast
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import lego_loam_sc as sc
from conftest import PROGRAM, ROOT

CORE = importlib.util.find_spec("lego_loam_sc._core")

pytestmark = pytest.mark.skipif(CORE is None, reason="the bindings are not built")


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    """One and a quarter rounds on a circle of 60 m with a VLP-16: the simulator's folder."""
    if not PROGRAM.exists():
        pytest.skip("lego-loam-sc is not built")
    folder = tmp_path_factory.mktemp("drive")
    seconds = np.arange(0.0, 12.6, 0.1)
    angle = seconds * 6.0 / (60.0 / (2.0 * np.pi))
    radius, zero = 60.0 / (2.0 * np.pi), np.zeros_like(angle)
    rows = [seconds, radius * np.sin(angle), radius * (1 - np.cos(angle)), zero + 1.7]
    rows += [zero, zero, np.sin(angle / 2), np.cos(angle / 2)]
    np.savetxt(folder / "round.tum", np.stack(rows, axis=1), fmt="%.9f")
    command = [PROGRAM, "simulate", "city", "--route", folder / "round.tum", "--sensor", "vlp16"]
    subprocess.run([*command, "-o", folder / "scans"], check=True, capture_output=True)
    return folder / "scans"


@pytest.fixture(scope="module")
def run(drive):
    """The SLAM after the drive, and its reports; scans went in as plain arrays."""
    source = sc.open_scans(str(drive))
    slam, reports = None, []
    for scan in source:
        slam = slam or sc.Slam(sc.recognise_sensor(scan, source.facts), threads=2)
        report = slam.process(
            scan.points,
            stamp=scan.stamp,
            offsets=scan.offsets,
            rings=scan.rings,
            intensity=scan.intensity,
        )
        reports.append(report)
    return slam, reports


def hall(turn=0.0):
    """A scan of a VLP-16 in an empty hall of 30 x 20 m, and the ring of each point."""
    elevation = np.radians(np.arange(-15.0, 16.0, 2.0))
    azimuth = np.pi - (np.arange(1800) + 0.5) * 2 * np.pi / 1800
    elevation, azimuth = np.meshgrid(elevation, azimuth)

    def direction_to(azimuth):
        flat = np.cos(elevation)
        parts = [flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)]
        return np.stack(parts, axis=-1)

    direction = direction_to(azimuth + turn)
    low, high = np.array([-10.0, -8.0, -1.5]), np.array([20.0, 12.0, 4.5])
    distance = (np.where(direction > 0, high, low) / direction).min(axis=-1, keepdims=True)
    rings = np.broadcast_to(np.arange(16), elevation.shape)
    return (distance * direction_to(azimuth)).reshape(-1, 3), rings.ravel()


def test_the_results_are_those_of_the_program_byte_for_byte(drive, run, tmp_path):
    slam, reports = run
    subprocess.run([PROGRAM, "run", drive, "-o", tmp_path / "run", "--quiet"], check=True)
    slam.trajectory().write_tum(tmp_path / "trajectory.tum")
    assert (tmp_path / "trajectory.tum").read_bytes() == (
        tmp_path / "run" / "trajectory.tum"
    ).read_bytes()
    loops = [loop for report in reports for loop in report.loops if loop.verification.accepted]
    added = [loop for loop in loops if loop.added]
    assert len(loops) >= len(added) == len(slam.loops()) > 0
    assert added[0].match == slam.loops()[0].match


def test_poses_stand_beside_their_stamps_and_are_views(run):
    slam, reports = run
    trajectory = slam.trajectory()
    assert len(trajectory) == len(reports)
    assert trajectory.poses.shape == (len(reports), 4, 4)
    np.testing.assert_array_equal(trajectory.stamps, [report.stamp for report in reports])
    np.testing.assert_array_equal(trajectory.poses[:, 3], np.tile([0, 0, 0, 1], (len(reports), 1)))
    rotations = trajectory.poses[:, :3, :3]
    identity = np.broadcast_to(np.eye(3), rotations.shape)
    np.testing.assert_allclose(rotations @ rotations.swapaxes(1, 2), identity, atol=1e-9)
    np.testing.assert_array_equal(slam.odometry().poses[-1], reports[-1].T_odom_lidar)
    view = trajectory.poses
    assert not view.flags.owndata and not view.flags.writeable
    del trajectory
    assert np.isfinite(view).all()  # it keeps its poses alive


def test_the_map_is_made_of_the_key_frames(run):
    slam, _ = run
    poses = slam.key_frames().poses
    points = [slam.key_frame_points(k) for k in range(len(poses))]
    assert all(cloud.dtype == np.float32 and cloud.shape[1] == 4 for cloud in points)
    pairs = zip(points, poses, strict=True)
    placed = np.concatenate([c[:, :3] @ p[:3, :3].T + p[:3, 3] for c, p in pairs])
    everything = slam.map(voxel_size=0.5)
    assert 0 < len(everything) < len(placed)
    np.testing.assert_allclose(everything[:, :3].min(0), placed.min(0), atol=0.5)
    np.testing.assert_allclose(everything[:, :3].max(0), placed.max(0), atol=0.5)
    with pytest.raises(IndexError, match="no number"):
        slam.key_frame_points(len(poses))
    with pytest.raises(ValueError, match="voxel_size"):
        slam.map(voxel_size=0.0)


def test_a_scan_gives_back_what_it_was_made_of():
    cloud = np.arange(40.0).reshape(10, 4)  # double, and columns of a larger array
    offsets = np.linspace(0.0, 0.1, 10)
    offsets[3] = np.nan
    rings = np.arange(10, dtype=np.uint8)
    scan = sc.Scan(cloud[:, :3], stamp=1.5, offsets=offsets, rings=rings, intensity=cloud[:, 3])
    np.testing.assert_array_equal(scan.points, cloud[:, :3].astype(np.float32))
    np.testing.assert_array_equal(scan.intensity, cloud[:, 3])
    np.testing.assert_array_equal(scan.rings, np.arange(10))
    np.testing.assert_allclose(scan.offsets, np.nan_to_num(offsets), atol=1e-9)
    assert (scan.stamp, len(scan)) == (1.5, 10)
    assert not scan.points.flags.owndata
    bare = sc.Scan(cloud[:, :3])
    assert bare.rings is None and bare.offsets is None and bare.intensity is None


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"offsets": np.zeros(9)}, "offsets has 9 entries for 10 points"),
        ({"offsets": np.full(10, 1e9)}, "offsets must be seconds"),
        ({"rings": np.full(10, -1)}, "rings must be between 0 and 65535"),
        ({"stamp": float("nan")}, "stamp must be a number of seconds"),
    ],
)
def test_arrays_that_do_not_fit_are_refused_with_the_reason(arguments, sentence):
    with pytest.raises(ValueError, match=sentence):
        sc.Scan(np.zeros((10, 3)), **arguments)


def test_points_of_another_shape_are_refused():
    with pytest.raises(TypeError):
        sc.Scan(np.zeros((10, 4)))


def test_a_bad_scan_is_a_status():
    slam = sc.Slam(sc.load_sensor("vlp16"))
    assert slam.process(np.zeros((0, 3)), stamp=0.0).status == sc.Status.too_few_points
    assert slam.process(np.full((5, 3), np.nan), stamp=0.1).status == sc.Status.too_few_points
    points, rings = hall()
    assert slam.process(points, stamp=0.1, rings=rings).status == sc.Status.out_of_order


def test_settings_are_attributes_and_are_checked():
    settings = sc.Settings()
    settings.loop.scan_context.threshold = 0.25
    assert "threshold: 0.25" in str(settings)
    assert str(sc.load_settings()) == str(sc.Settings())
    assert not sc.load_settings("lego-loam").loop.scan_context.enabled
    settings.mapping.voxel_size = -1.0
    with pytest.raises(ValueError, match="mapping.voxel_size"):
        sc.Slam(sc.load_sensor("vlp16"), settings)
    with pytest.raises(AttributeError):
        settings.loop.scan_context.no_such_setting = 0.3
    with pytest.raises(sc.InputError, match="vlp16"):
        sc.load_sensor("vlp17")


def test_every_setting_of_the_yaml_is_an_attribute():
    groups = [sc.Settings()]
    for line in str(sc.Settings()).splitlines():
        depth = (len(line) - len(line.lstrip())) // 2
        name, value = line.split("#")[0].split(":")
        owner = groups[depth]
        found = getattr(owner, name.strip())
        if value.strip():
            assert str(found).lower().removesuffix(".0") == value.strip()
        else:
            groups[depth + 1 :] = [found]


def test_a_turned_scan_context_is_recognised_with_its_turn():
    points, _ = hall()
    turned, _ = hall(turn=np.pi / 3)  # ten columns
    settings = sc.ScanContextSettings()
    a = sc.ScanContext(points, 1.5, settings)
    b = sc.ScanContext(turned, sensor_height=1.5, settings=settings)
    assert a.columns.shape == (settings.sectors, settings.rings)
    assert a.ring_key.shape == (settings.rings,)
    match = b.compare(a)
    assert match.distance < 0.1
    assert np.degrees(match.yaw) == pytest.approx(60.0, abs=6.0)
    settings.sectors = 30
    with pytest.raises(ValueError, match="same settings"):
        b.compare(sc.ScanContext(points, 1.5, settings))


def test_match_finds_the_transform_between_two_visits(drive):
    scans = list(sc.open_scans(str(drive)))
    match = sc.match(scans[2], scans[103], sc.load_sensor("vlp16"))  # a round and 0.6 m later
    assert match.verification.verdict == sc.Verdict.accepted
    assert match.scan_context.distance < 0.3
    pose = match.verification.T_match_query
    np.testing.assert_allclose(pose[:3, 3], [0.6, 0.0, 0.0], atol=0.1)
    assert np.degrees(np.arctan2(pose[1, 0], pose[0, 0])) == pytest.approx(3.6, abs=0.5)
    elsewhere = sc.match(scans[2], scans[52], sc.load_sensor("vlp16"))
    assert not elsewhere.verification.accepted


def test_where_the_bindings_are_missing_their_names_say_how_to_get_them(monkeypatch):
    monkeypatch.setitem(sys.modules, "lego_loam_sc._core", None)
    with pytest.raises(ImportError, match="pip install"):
        sc.Slam  # noqa: B018
    with pytest.raises(AttributeError):
        sc.no_such_name  # noqa: B018


def test_the_stubs_name_all_that_the_package_offers():
    stub = Path(CORE.origin).with_name("_core.pyi")
    names = {getattr(node, "name", None) for node in ast.parse(stub.read_text()).body}
    assert set(sc.__all__) <= names
    assert stub.with_name("py.typed").exists()
    for name in sc.__all__:
        assert getattr(sc, name) is not None


def test_the_example_plots_the_run(drive, tmp_path):
    image = pytest.importorskip("matplotlib.image")
    script = ROOT / "examples" / "04_plot_run.py"
    command = [sys.executable, script, drive, tmp_path / "run.png"]
    environment = {**os.environ, "MPLBACKEND": "agg"}
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
    assert "126 scans, 0 lost" in done.stdout
    assert "from key frame" in done.stdout
    picture = image.imread(tmp_path / "run.png")
    assert picture.shape[0] > 500 and picture[..., :3].std() > 0.02
