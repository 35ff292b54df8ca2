# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/trials/venv/bin/python -m unittest discover bench/trials -p '*_test.py'"""

import pathlib
import tempfile
import unittest

import campaign
import numpy as np
from troubles import TROUBLES, Frame, Lidar, Moment

import scan_stream

COLUMNS = 72
FACTS = "motion_compensated: false\n"


def a_scan():
    """Eight rings in a round room of 10 m, open to the rear."""
    column, ring = np.meshgrid(np.arange(COLUMNS), np.arange(8))
    azimuth = (column.ravel() + 0.5) / COLUMNS * 2 * np.pi - np.pi
    up = np.radians(2.0 * ring.ravel() - 8)
    rays = [np.cos(up) * np.cos(azimuth), np.cos(up) * np.sin(azimuth), np.sin(up)]
    scan = scan_stream.Scan(
        0,
        (10.0 * np.stack(rays, axis=1)).astype("<f4"),
        np.ones(len(azimuth), "<f4"),
        ring.ravel().astype("<u2"),
        (column.ravel() * 1e8 / COLUMNS).astype("<i4"),
    )
    return scan.kept(np.abs(azimuth) < 2.5)


def some_frames():
    return [Frame(k, 100_000_000 * k) for k in range(60)]


def done(trouble, seed):
    """Frames, a scan and facts after a trouble."""
    figures = trouble.draw(np.random.default_rng(seed))
    frames = trouble.frames(some_frames(), figures, np.random.default_rng(4))
    at = next((frame for frame in frames if frame.noise), frames[0])
    moment = Moment(at, 0.0, Lidar(COLUMNS, 100.0, 0.1))
    scan = trouble.scan(a_scan(), figures, moment, np.random.default_rng(5))
    return frames, scan, trouble.facts(FACTS)


def is_changed(trouble, seed):
    frames, scan, facts = done(trouble, seed)
    old, new = a_scan().arrays(), scan.arrays()
    same = old.keys() == new.keys() and all(np.array_equal(old[k], new[k]) for k in old)
    return frames != some_frames() or facts != FACTS or not same


class EachTrouble(unittest.TestCase):
    def test_keeps_the_arrays_of_one_length(self):
        for name, trouble in TROUBLES.items():
            for scan in done(trouble, 3)[1].arrays().values():
                self.assertEqual(len(scan), len(done(trouble, 3)[1].points), name)

    def test_changes_the_drive(self):
        for name, trouble in TROUBLES.items():
            self.assertTrue(any(is_changed(trouble, seed) for seed in range(8)), name)

    def test_stamps_stay_in_order(self):
        for name, trouble in TROUBLES.items():
            figures = trouble.draw(np.random.default_rng(3))
            frames = trouble.frames(some_frames(), figures, np.random.default_rng(4))
            stamps = [frame.stamp_ns for frame in frames]
            self.assertEqual(stamps, sorted(set(stamps)), name)

    def test_fillers_lie_where_nothing_was_hit(self):
        moment = Moment(Frame(0, 0), 0.0, Lidar(COLUMNS, 100.0, 0.1))
        full = TROUBLES["max-range"].scan(
            a_scan(), {"radius": 30.0}, moment, np.random.default_rng(1)
        )
        self.assertEqual(len(full.points), 8 * COLUMNS)
        far = np.linalg.norm(full.points, axis=1)
        self.assertEqual((far > 20).sum(), 8 * COLUMNS - len(a_scan().points))
        self.assertTrue((np.abs(np.arctan2(*full.points[far > 20, 1::-1].T)) > 2.4).all())


class Campaign(unittest.TestCase):
    def test_follows_from_its_seed_alone(self):
        self.assertEqual(campaign.drives(1, 30), campaign.drives(1, 60)[:30])
        self.assertNotEqual(campaign.drives(1, 30), campaign.drives(2, 30))

    def test_sees_every_world_sensor_and_trouble(self):
        drives = campaign.drives(1, 320)
        self.assertEqual({d.simulation.world for d in drives}, set(campaign.WORLDS))
        self.assertEqual(len({d.simulation.sensor for d in drives}), len(campaign.PRESETS) + 4)
        names = {name for drive in drives for name in drive.trouble_names}
        self.assertEqual(names, {*TROUBLES, "tilted"})


class Streams(unittest.TestCase):
    def test_come_back_as_they_were_written(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scans"
            bare = scan_stream.Scan(7, a_scan().points)
            scan_stream.write(path, "sensor: rs16\n", [a_scan(), bare])
            stream = scan_stream.Stream(path)
            self.assertEqual((len(stream), stream.facts), (2, "sensor: rs16\n"))
            for key, array in a_scan().arrays().items():
                np.testing.assert_array_equal(stream[0].arrays()[key], array)
            self.assertEqual(list(stream[1].arrays()), ["points"])


if __name__ == "__main__":
    unittest.main()
