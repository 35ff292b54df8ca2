# SPDX-License-Identifier: BSD-3-Clause
"""KISS-ICP."""

import numpy as np
from kiss_icp.config import KISSConfig
from kiss_icp.kiss_icp import KissICP
from kiss_icp.pybind import kiss_icp_pybind

# Where in the sweep a pose belongs when the points have times: the points are moved to its end.
REFERENCE = 1.0


class Odometry:
    def __init__(self, settings, threads):
        config = KISSConfig(**settings)
        config.registration.max_num_threads = threads
        if config.mapping.voxel_size is None:
            config.mapping.voxel_size = config.data.max_range / 100.0
        self.odometry = KissICP(config)
        self.poses = []

    def add(self, points, times):
        self.odometry.register_frame(points, times)
        self.poses.append(self.odometry.last_pose)

    def finish(self):
        return self.poses


def kitti_correction(points):
    """What KISS-ICP's loader for KITTI does to a scan."""
    vector = kiss_icp_pybind._Vector3dVector(points)
    return np.asarray(kiss_icp_pybind._correct_kitti_scan(vector))
