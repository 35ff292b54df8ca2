# SPDX-License-Identifier: BSD-3-Clause
"""GenZ-ICP."""

import pathlib

import numpy as np
from genz_icp.config import load_config
from genz_icp.genz_icp import GenZICP
from genz_icp.pybind import genz_icp_pybind

# Where in the sweep a pose belongs when the points have times: the points are moved to its middle.
REFERENCE = 0.5


class Odometry:
    """`settings`: `preset` is one of the tuned files that come with it, `deskew` goes over it.

    It has no setting for threads; it takes as many as the process may use.
    """

    def __init__(self, settings, threads):
        config = load_config(pathlib.Path(settings["preset"]))
        config.data.deskew = settings["deskew"]
        self.odometry = GenZICP(config)
        self.poses = []

    def add(self, points, times):
        # It wants the time as a share of the sweep.
        shares = times / times.max() if len(times) else times
        self.odometry.register_frame(points, shares)
        self.poses.append(self.odometry.last_pose)

    def finish(self):
        return self.poses


def kitti_correction(points):
    """What GenZ-ICP's loader for KITTI does to a scan."""
    vector = genz_icp_pybind._Vector3dVector(points)
    return np.asarray(genz_icp_pybind._correct_kitti_scan(vector))
