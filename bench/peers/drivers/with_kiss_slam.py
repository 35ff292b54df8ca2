# SPDX-License-Identifier: BSD-3-Clause
"""KISS-SLAM."""

from kiss_slam.config import KissSLAMConfig
from kiss_slam.slam import KissSLAM
from with_kiss_icp import REFERENCE, kitti_correction  # noqa: F401  it reads scans with KISS-ICP


class Odometry:
    def __init__(self, settings, threads):
        config = KissSLAMConfig(**settings)
        config.odometry.registration.max_num_threads = threads
        if config.odometry.mapping.voxel_size is None:
            config.odometry.mapping.voxel_size = config.odometry.preprocessing.max_range / 100.0
        self.slam = KissSLAM(config)

    def add(self, points, times):
        self.slam.process_scan(points, times)

    def finish(self):
        """As its pipeline does after the last scan."""
        self.slam.generate_new_node()
        self.slam.local_map_graph.erase_last_local_map()
        poses, _ = self.slam.fine_grained_optimization()
        return poses
