# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/paper-venv/bin/python -m unittest discover bench/common -p '*_test.py'"""

import unittest

import numpy as np
from scipy.spatial.transform import Rotation

from trajectory import Trajectory, pose


def a_left_bend():
    """A metre and five degrees for each second."""
    step = pose([1.0, 0.0, 0.0], Rotation.from_euler("z", 5.0, degrees=True))
    poses = [np.linalg.matrix_power(step, k) for k in range(4)]
    return Trajectory(np.arange(4.0), np.array(poses))


class AtOtherTimes(unittest.TestCase):
    def yaw(self, pose_at):
        return Rotation.from_matrix(pose_at[:3, :3]).as_euler("ZYX", degrees=True)[0]

    def test_a_pose_of_its_own_comes_back(self):
        bend = a_left_bend()
        np.testing.assert_allclose(bend.at(bend.stamps), bend.poses, atol=1e-12)

    def test_half_way_half_the_motion_is_done(self):
        self.assertAlmostEqual(self.yaw(a_left_bend().at(np.array([1.5]))[0]), 7.5)

    def test_the_motion_goes_on_after_the_last_pose(self):
        bend = a_left_bend()
        after = bend.at(np.array([3.5]))[0]
        self.assertAlmostEqual(self.yaw(after), 17.5)
        self.assertAlmostEqual(np.linalg.norm(after[:3, 3] - bend.positions[-1]), 0.5)

    def test_but_not_for_ever(self):
        bend = a_left_bend()
        np.testing.assert_allclose(bend.at(np.array([4.0])), bend.at(np.array([100.0])))


if __name__ == "__main__":
    unittest.main()
