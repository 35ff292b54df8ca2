# SPDX-License-Identifier: BSD-3-Clause
"""small_gicp as odometry from scan to scan, as in its own benchmark, with a constant velocity."""

import numpy as np
import small_gicp

# Points are taken as they come; on the average they were measured in the middle of the sweep.
REFERENCE = 0.5


class Odometry:
    def __init__(self, settings, threads):
        self.settings = settings
        self.threads = threads
        self.target = self.tree = None
        self.motion = np.eye(4)
        self.poses = []

    def add(self, points, times):
        cloud, tree = small_gicp.preprocess_points(
            points,
            downsampling_resolution=self.settings["downsampling_resolution"],
            num_neighbors=self.settings["num_neighbors"],
            num_threads=self.threads,
        )
        if self.target is None:
            self.poses.append(np.eye(4))
        else:
            result = small_gicp.align(
                self.target,
                cloud,
                self.tree,
                init_T_target_source=self.motion,
                max_correspondence_distance=self.settings["max_correspondence_distance"],
                num_threads=self.threads,
            )
            self.motion = result.T_target_source
            self.poses.append(self.poses[-1] @ self.motion)
        self.target, self.tree = cloud, tree

    def finish(self):
        return self.poses


def kitti_correction(points):
    """It has none."""
    return points
