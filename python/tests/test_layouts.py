# SPDX-License-Identifier: BSD-3-Clause
"""Clouds as the drivers of the makers lay them out."""

import numpy as np
import pytest

from made_bags import START_NS, Messages, stamp_of, write_bag

RINGS, COLUMNS = 16, 90


def layout(step, **fields):
    """A dtype from name = (type, offset)."""
    return np.dtype(
        {
            "names": list(fields),
            "formats": [kind for kind, _ in fields.values()],
            "offsets": [offset for _, offset in fields.values()],
            "itemsize": step,
        }
    )


XYZ = {"x": ("<f4", 0), "y": ("<f4", 4), "z": ("<f4", 8)}
SECONDS = START_NS * 1e-9
# name: layout, field of the time, time of column c as a share of the sweep, is it organised
DRIVERS = {
    "velodyne": (
        layout(22, **XYZ, intensity=("<f4", 12), ring=("<u2", 16), time=("<f4", 18)),
        ("time", lambda share: share * 0.1 - 0.1),
        False,
    ),
    "ouster": (
        layout(
            48,
            **XYZ,
            intensity=("<f4", 16),
            t=("<u4", 20),
            reflectivity=("<u2", 24),
            ring=("<u2", 26),
            ambient=("<u2", 28),
            range=("<u4", 32),
        ),
        ("t", lambda share: share * 1e8),
        True,
    ),
    "hesai": (
        layout(32, **XYZ, intensity=("<f4", 12), timestamp=("<f8", 16), ring=("<u2", 24)),
        ("timestamp", lambda share: SECONDS + share * 0.1),
        False,
    ),
    "hesai_packed": (
        layout(26, **XYZ, intensity=("<f4", 12), ring=("<u2", 16), timestamp=("<f8", 18)),
        ("timestamp", lambda share: SECONDS + share * 0.1),
        True,
    ),
    "ouster_before_2020": (
        layout(
            48,
            **XYZ,
            intensity=("<f4", 16),
            t=("<u4", 20),
            reflectivity=("<u2", 24),
            ring=("u1", 26),
            noise=("<u2", 28),
            range=("<u4", 32),
        ),
        ("t", lambda share: share * 1e8),
        True,
    ),
    "robosense": (
        layout(26, **XYZ, intensity=("<f4", 12), ring=("<u2", 16), timestamp=("<f8", 18)),
        ("timestamp", lambda share: SECONDS - 0.1 + share * 0.1),
        True,
    ),
    "livox": (
        layout(
            26,
            **XYZ,
            intensity=("<f4", 12),
            tag=("u1", 16),
            line=("u1", 17),
            timestamp=("<f8", 18),
        ),
        ("timestamp", lambda share: START_NS + share * 1e8),
        False,
    ),
    "livox_custom_fields": (
        layout(19, **XYZ, reflectivity=("u1", 12), line=("u1", 13), offset_time=("<u4", 15)),
        ("offset_time", lambda share: share * 1e5),
        False,
    ),
    "channels": (
        layout(24, **XYZ, i=("<f4", 12), channel=("<i4", 16), t=("<f4", 20)),
        ("t", lambda share: share * 100),
        False,
    ),
}
BEGIN_MS = {"velodyne": -100, "robosense": -100}


def make_cloud(dtype, time_field, time_of):
    """(RINGS, COLUMNS) points; a few of them are NaN with a nonsensical time."""
    cloud = np.zeros((RINGS, COLUMNS), dtype)
    rows, columns = np.indices(cloud.shape)
    cloud["x"] = 10 + rows
    cloud["y"] = columns / 8
    cloud["z"] = rows / 4
    intensities = [name for name in ("intensity", "reflectivity", "i") if name in dtype.names]
    for rank, name in enumerate(intensities):
        cloud[name] = 10 + rows if rank == 0 else 99  # the first counts
    for name in ("ring", "line", "channel"):
        if name in dtype.names:
            cloud[name] = rows
    cloud[time_field] = time_of(columns / COLUMNS)
    for axis in "xyz":
        cloud[axis][3, 5] = np.nan
    cloud[time_field][3, 5] = 0
    return cloud


def read_cloud(tmp_path, read, cloud, **options):
    message = Messages(False).cloud(START_NS, cloud, **options)
    return read(write_bag(tmp_path, "mcap", [("/points", START_NS, message)]))


@pytest.mark.parametrize("big_endian", [False, True])
@pytest.mark.parametrize("driver", DRIVERS)
def test_the_layout_of_a_driver_is_understood(tmp_path, read, driver, big_endian):
    dtype, (time_field, time_of), organised = DRIVERS[driver]
    cloud = make_cloud(dtype.newbyteorder(">") if big_endian else dtype, time_field, time_of)
    outcome = read_cloud(tmp_path, read, cloud if organised else cloud.ravel())
    assert outcome.exit_code == 0, outcome.messages
    (scan,) = outcome.scans
    rows, columns = (index.ravel() for index in np.indices((RINGS, COLUMNS)))
    for axis, name in enumerate("xyz"):
        np.testing.assert_array_equal(scan.points[:, axis], cloud[name].ravel())
    np.testing.assert_array_equal(scan.intensity, 10 + rows)
    np.testing.assert_array_equal(scan.ring, rows)
    expected = (columns / COLUMNS) * 1e8 + BEGIN_MS.get(driver, 0) * 1e6
    expected[3 * COLUMNS + 5] = 0
    np.testing.assert_allclose(scan.offset_ns, expected, atol=1000)


def test_the_rows_of_an_organised_cloud_are_rings_either_way_round(tmp_path, read):
    cloud = np.zeros((RINGS, COLUMNS), layout(16, **XYZ, intensity=("<f4", 12)))
    cloud["x"], _ = np.indices(cloud.shape)
    for rows_first in (True, False):
        folder = tmp_path / str(rows_first)
        folder.mkdir()
        stored = cloud if rows_first else np.ascontiguousarray(cloud.T)
        (scan,) = read_cloud(folder, read, stored).scans
        np.testing.assert_array_equal(scan.ring, scan.points[:, 0])


def test_a_cloud_without_rings_and_rows_has_none(tmp_path, read):
    cloud = np.zeros(50, layout(12, **XYZ))
    outcome = read_cloud(tmp_path, read, cloud)
    assert outcome.scans[0].ring is None and outcome.scans[0].intensity is None
    assert outcome.scans[0].offset_ns is None
    assert any("the points have no times" in message for message in outcome.messages)


def test_padding_behind_rows_is_skipped(tmp_path, read):
    cloud = np.zeros((4, 30), layout(12, **XYZ))
    cloud["y"] = np.arange(120).reshape(4, 30)
    (scan,) = read_cloud(tmp_path, read, cloud, row_padding=7).scans
    np.testing.assert_array_equal(scan.points[:, 1], np.arange(120))


def test_coordinates_may_be_doubles_and_rings_floats(tmp_path, read):
    wide = {axis: ("<f8", 8 * k) for k, axis in enumerate("xyz")}
    cloud = np.zeros(40, layout(28, **wide, ring=("<f4", 24)))
    cloud["x"], cloud["ring"] = 2.5, np.arange(40)
    (scan,) = read_cloud(tmp_path, read, cloud).scans
    assert (scan.points[:, 0] == 2.5).all()
    np.testing.assert_array_equal(scan.ring, np.arange(40))


@pytest.mark.parametrize(
    ("dtype", "values", "words"),
    [
        (layout(8, x=("<f4", 0), y=("<f4", 4)), {}, "no field z"),
        (layout(16, **XYZ, ring=("<i4", 12)), {"x": 1, "ring": -3}, "is -3, a ring is between"),
        (layout(16, **XYZ, t=("<f4", 12)), {"x": 1, "t": [0, 5]}, "run from 0.0 to 5.0"),
    ],
)
def test_a_cloud_that_makes_no_sense_is_refused_with_what_was_seen(
    tmp_path, read, dtype, values, words
):
    cloud = np.zeros(2, dtype)
    for name, value in values.items():
        cloud[name] = value
    outcome = read_cloud(tmp_path, read, cloud)
    assert (outcome.exit_code, outcome.scans) == (1, [])
    assert words in outcome.messages[-1]


def test_the_unit_in_dataset_yaml_settles_what_the_numbers_do_not(tmp_path, read):
    cloud = np.zeros(2, layout(16, **XYZ, t=("<f4", 12)))
    cloud["x"], cloud["t"] = 1, [0, 5]
    bag = write_bag(tmp_path, "mcap", [("/p", START_NS, Messages(False).cloud(START_NS, cloud))])
    (bag / "dataset.yaml").write_text("point_times: ms\n")
    outcome = read(bag)
    assert outcome.exit_code == 0
    assert outcome.scans[0].offset_ns.tolist() == [0, 5_000_000]


def test_the_unit_of_a_full_sweep_holds_for_a_short_one_before_it(tmp_path, read):
    make = Messages(False)
    dtype = layout(16, **XYZ, t=("<u4", 12))

    def messages():
        for k, last in enumerate([4_000, 100_000, 3_000]):
            cloud = np.zeros(2, dtype)
            cloud["x"], cloud["t"] = 1, [0, last]
            yield "/points", stamp_of(k), make.cloud(stamp_of(k), cloud)

    outcome = read(write_bag(tmp_path, "mcap", messages()))
    assert outcome.exit_code == 0
    assert [scan.offset_ns[1] for scan in outcome.scans] == [4_000_000, 100_000_000, 3_000_000]


def test_an_empty_cloud_is_a_scan_without_points(tmp_path, read):
    outcome = read_cloud(tmp_path, read, np.zeros(0, layout(12, **XYZ)))
    assert outcome.exit_code == 0
    assert outcome.scans[0].points.shape == (0, 3)
