# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/trials/venv/bin/python -m unittest discover bench/trials -p '*_test.py'"""

import math
import unittest

import entropy
import numpy as np


def wall(sigma, count=1000):
    """Points on 2 x 2 m that are off by sigma."""
    rng = np.random.default_rng(1)
    return np.column_stack([rng.uniform(0, 2, (count, 2)), rng.normal(0, sigma, count)])


class MeanMapEntropy(unittest.TestCase):
    def test_of_a_cloud_is_that_of_its_covariance(self):
        points = np.random.default_rng(1).normal(0.0, 0.05, (1000, 3))
        expected = 1.5 * math.log(2 * math.pi * math.e * 0.05**2)
        self.assertAlmostEqual(entropy.mean_map_entropy(points), expected, delta=0.1)

    def test_a_thicker_wall_has_more(self):
        values = [entropy.mean_map_entropy(wall(sigma)) for sigma in (0.0, 0.01, 0.03, 0.1)]
        self.assertEqual(values, sorted(values))
        self.assertTrue(math.isfinite(values[0]))
        self.assertAlmostEqual(values[2] - values[1], math.log(3), delta=0.05)

    def test_lonely_points_do_not_count(self):
        self.assertTrue(math.isnan(entropy.mean_map_entropy(10.0 * np.eye(3))))

    def test_poses_that_agree_make_a_crisper_map(self):
        scans = [wall(0.01)] * 5
        right = np.tile(np.eye(4), (5, 1, 1))
        wrong = right.copy()
        wrong[:, 2, 3] = [0.0, 0.05, 0.1, 0.15, 0.2]
        crisp, smeared = (
            entropy.mean_map_entropy(entropy.accumulated(scans, poses)) for poses in (right, wrong)
        )
        self.assertGreater(smeared, crisp + 1.0)


class Thinning(unittest.TestCase):
    def test_keeps_the_first_of_each_voxel_in_order(self):
        points = np.array([[0.25, 0, 0], [0.01, 0, 0], [0.29, 0, 0], [0.05, 0, 0], [-0.01, 0, 0]])
        np.testing.assert_array_equal(entropy.thinned(points, 0.1), points[[0, 1, 4]])


if __name__ == "__main__":
    unittest.main()
