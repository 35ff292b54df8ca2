# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/trials/venv/bin/python -m unittest discover bench/trials -p '*_test.py'"""

import math
import unittest

import judge
import numpy as np

from trajectory import Trajectory


def straight(steps):
    """From the origin along x by these metres, a scan every 0.1 s."""
    poses = np.tile(np.eye(4), (len(steps) + 1, 1, 1))
    poses[1:, 0, 3] = np.cumsum(steps)
    return Trajectory(0.1 * np.arange(len(poses)), poses)


class Errors(unittest.TestCase):
    def test_of_a_moved_copy_are_none(self):
        truth = straight(np.ones(20))
        moved = Trajectory(truth.stamps, truth.poses + 0.0)
        moved.poses[:, 1, 3] += 5.0
        found = judge.errors(truth, moved)
        self.assertAlmostEqual(found.ate, 0.0)
        self.assertTrue(judge.is_fine(found, 1.0))
        self.assertFalse(judge.is_fine(found, 0.3), "most scans have no pose")

    def test_one_percent_of_the_path_or_a_decimetre_is_fine(self):
        for steps, limit in ((1.0, 1.0), (0.05, 0.1)):
            found = judge.errors(straight(np.full(100, steps)), straight(np.full(100, steps)))
            self.assertAlmostEqual(found.limit, limit)

    def test_a_jump_is_seen_at_its_step(self):
        jump = np.ones(20)
        jump[7] = 4.0
        found = judge.errors(straight(np.ones(20)), straight(jump))
        self.assertEqual(judge.carriers(found.steps).tolist(), [7])
        self.assertAlmostEqual(found.steps[7], 3.0)

    def test_without_poses_nothing_is_fine(self):
        found = judge.errors(straight(np.ones(20)).first(2), straight(np.ones(20)).first(2))
        self.assertTrue(math.isnan(found.ate))
        self.assertFalse(judge.is_fine(found, 1.0))


class Said(unittest.TestCase):
    def said(self, statuses, errors, code=0, verdict=""):
        return judge.how_it_was_said(code, verdict, statuses, np.array(errors))

    def test_by_the_exit_code_or_the_verdict(self):
        self.assertEqual(self.said(["ok"] * 3, [1, 1, 1], code=1), "exit")
        self.assertEqual(self.said(["ok"] * 3, [1, 1, 1], verdict="doubtful"), "verdict")
        self.assertEqual(self.said(["ok"] * 3, [1, 1, 1], verdict="trusted"), "")

    def test_by_the_status_of_the_scans_that_carry_the_error(self):
        self.assertEqual(self.said(["ok", "lost", "ok"], [0.01, 5.0, 0.01]), "status")
        self.assertEqual(self.said(["lost", "ok", "lost"], [0.01, 5.0, 0.01]), "")

    def test_half_of_them_is_not_most(self):
        self.assertEqual(self.said(["lost", "ok", "ok", "ok"], [1.0, 1.0, 1.0, 1.0]), "")


class Classes(unittest.TestCase):
    def test_each(self):
        self.assertEqual(judge.classify(0, True, ""), judge.FINE)
        self.assertEqual(judge.classify(0, False, "status"), judge.SAID)
        self.assertEqual(judge.classify(1, True, "exit"), judge.SAID)
        self.assertEqual(judge.classify(0, False, ""), judge.SILENT)
        for code in (None, -11, 2):
            self.assertEqual(judge.classify(code, False, "status"), judge.CRASHED)


if __name__ == "__main__":
    unittest.main()
