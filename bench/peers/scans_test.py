# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/peers/venv/bin/python -m unittest discover bench/peers -p '*_test.py'"""

import pathlib
import struct
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "drivers"))

import scans  # noqa: E402  it lies in the folder of the drivers

POINTS = np.array([[1.0, 2.0, 3.0], [-4.0, 5.0, -6.0]], dtype="<f4")


def stream(arrays):
    """A scan stream with POINTS twice, 0.1 s apart, with the optional arrays that are named."""
    text = b"sensor: vlp16\n"
    data = b"LLSCSCAN" + struct.pack("<II", 1, len(text)) + text
    for stamp_ns in (1_000_000_000, 1_100_000_000):
        data += b"SCAN" + struct.pack("<IqI", arrays, stamp_ns, len(POINTS)) + POINTS.tobytes()
        data += np.array([0.5, 0.7], dtype="<f4").tobytes() if arrays & 1 else b""
        data += np.array([3, 4], dtype="<u2").tobytes() if arrays & 2 else b""
        data += np.array([0, 50_000_000], dtype="<i4").tobytes() if arrays & 4 else b""
    return data


class Reading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def read(self, data):
        path = self.folder / "scans"
        path.write_bytes(data)
        return list(scans.read(path))

    def test_points_and_times_of_a_stream_are_found_beside_any_other_arrays(self):
        for arrays in range(8):
            read = self.read(stream(arrays))
            self.assertEqual([scan.stamp for scan in read], [1.0, 1.1])
            for scan in read:
                np.testing.assert_array_equal(scan.points, POINTS)
                np.testing.assert_allclose(scan.times, [0.0, 0.05] if arrays & 4 else [])

    def test_what_is_no_stream_is_refused(self):
        with self.assertRaisesRegex(ValueError, "no scan stream"):
            self.read(b"\0" * 100)

    def test_a_kitti_folder_has_stamps_and_no_times(self):
        (self.folder / "velodyne").mkdir()
        rows = np.column_stack([POINTS, [0.1, 0.2]]).astype("<f4")
        for number in range(2):
            rows.tofile(self.folder / f"velodyne/{number:06d}.bin")
        (self.folder / "times.txt").write_text("0.0\n0.104\n")
        read = list(scans.read(self.folder))
        self.assertEqual([scan.stamp for scan in read], [0.0, 0.104])
        np.testing.assert_array_equal(read[1].points, POINTS)
        self.assertEqual(len(read[1].times), 0)


if __name__ == "__main__":
    unittest.main()
