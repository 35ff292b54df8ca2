# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/trials/venv/bin/python -m unittest discover bench/trials -p '*_test.py'"""

import pathlib
import tempfile
import unittest

import numpy as np
import recordings

POINTS = np.array([[1.0, 2.0, 3.0], [-4.0, 5.0, -6.0]], dtype="<f4")
HEADER = "VERSION 0.7\nFIELDS x _ y z ring _\nSIZE 4 1 4 4 2 1\nTYPE F U F F U U\n"
HEADER += "COUNT 1 3 1 1 1 2\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA "


class Reading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_points_of_a_pcd_lie_between_padding(self):
        rows = np.zeros(2, "<f4, (3,)u1, <f4, <f4, <u2, (2,)u1")
        for field, axis in zip(("f0", "f2", "f3"), POINTS.T, strict=False):
            rows[field] = axis
        path = self.folder / "0.pcd"
        path.write_bytes((HEADER + "binary\n").encode() + rows.tobytes())
        np.testing.assert_array_equal(recordings.read_pcd(path), POINTS)
        lines = [f"{x} 0 0 0 {y} {z} 7 0 0\n" for x, y, z in POINTS]
        path.write_text(HEADER + "ascii\n" + "".join(lines))
        np.testing.assert_array_equal(recordings.read_pcd(path), POINTS)

    def test_scans_come_by_number_and_drives_alone(self):
        for name, files in {"a": ("2.pcd", "10.pcd"), "loop_pair_x": ("1.bin", "2.bin")}.items():
            (self.folder / name).mkdir()
            for file in files:
                (self.folder / name / file).touch()
        found = recordings.found([self.folder])
        self.assertEqual(list(found), ["a"])
        self.assertEqual([path.name for path in found["a"].scans], ["2.pcd", "10.pcd"])

    def test_a_correction_turns_the_elevation(self):
        turned = recordings.corrected(np.array([[10.0, 0.0, 0.0]]), 90.0)
        np.testing.assert_allclose(turned, [[0.0, 0.0, 10.0]], atol=1e-12)


if __name__ == "__main__":
    unittest.main()
