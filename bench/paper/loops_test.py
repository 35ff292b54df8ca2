# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/paper-venv/bin/python -m unittest discover bench/paper -p '*_test.py'"""

import unittest

import loops
import numpy as np
from scipy.spatial.transform import Rotation

from trajectory import inverse, pose

KEY_SCANS = np.arange(0, 400, 2)


def out_and_back(height_of_return=0.0, speed=1.0):
    """True poses, stamps and path: 200 m straight ahead and back again, a scan each metre.

    On the way back, 23 m behind the turning point, what lies 4 m ahead was passed 50 m ago: there
    begin the revisits, 177 m of them.
    """
    path = np.arange(400.0)
    poses = []
    for travelled in path:
        ahead = travelled < 200.0
        position = [travelled, 0.0, 0.0] if ahead else [400.0 - travelled, 0.0, height_of_return]
        poses.append(pose(position, Rotation.from_euler("z", 0.0 if ahead else np.pi)))
    return np.array(poses), path / speed, path


def loop(poses, query, match, shift=0.0, turn_deg=0.0):
    """The true loop, but for a shift (m) and a turn."""
    error = pose([shift, 0.0, 0.0], Rotation.from_euler("z", turn_deg, degrees=True))
    return loops.Loop(query, match, "made", inverse(poses[match]) @ poses[query] @ error)


class Precision(unittest.TestCase):
    def test_a_loop_is_true_up_to_half_a_metre_and_two_degrees(self):
        poses, _, _ = out_and_back()
        self.assertTrue(loops.is_true(loop(poses, 300, 100, 0.49, 1.9), poses))
        self.assertFalse(loops.is_true(loop(poses, 300, 100, shift=0.51), poses))
        self.assertFalse(loops.is_true(loop(poses, 300, 100, turn_deg=2.1), poses))

    def test_false_loops_lower_the_precision_and_find_nothing(self):
        poses, stamps, path = out_and_back()
        accepted = [loop(poses, 300, 100), loop(poses, 340, 60, shift=3.0)]
        score = loops.score(accepted, KEY_SCANS, poses, stamps, path)
        self.assertEqual((score.accepted, score.false, score.found), (2, 1, 1))
        self.assertEqual(score.precision, 0.5)


class Recall(unittest.TestCase):
    def test_each_ten_metres_of_the_way_back_want_a_loop(self):
        poses, stamps, path = out_and_back()
        accepted = [loop(poses, query, 400 - query) for query in range(224, 312, 2)]
        score = loops.score(accepted, KEY_SCANS, poses, stamps, path)
        self.assertEqual((score.stretches, score.found), (17, 9))

    def test_a_run_without_loops_has_found_nothing_and_said_nothing_false(self):
        score = loops.score([], KEY_SCANS, *out_and_back())
        self.assertEqual((score.recall, score.precision), (0.0, 1.0))

    def test_a_gap_between_revisits_ends_a_stretch(self):
        back = np.array([0, 1, 1, 1, 0, 1, 0], dtype=bool)
        stretches = loops.cut_into_stretches(back, np.arange(7.0))
        self.assertEqual([list(stretch) for stretch in stretches], [[1, 2, 3], [5]])

    def test_another_floor_is_no_revisit(self):
        score = loops.score([], KEY_SCANS, *out_and_back(height_of_return=3.0))
        self.assertEqual(score.stretches, 0)

    def test_what_was_passed_less_than_thirty_seconds_ago_is_no_revisit(self):
        poses, stamps, path = out_and_back(speed=10.0)
        back = loops.revisits(poses[:, :3, 3], stamps, path)
        # 312 m of path lie between the two visits of x = 44 m, but 100 m between those of 150 m.
        self.assertTrue(back[356])
        self.assertFalse(back[250])


if __name__ == "__main__":
    unittest.main()
