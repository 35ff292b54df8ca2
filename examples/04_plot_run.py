# SPDX-License-Identifier: BSD-3-Clause
"""Runs the SLAM on a folder of scans and plots what came out.

    python 04_plot_run.py SCANS [PICTURE]

The `# %%` marks are cells for editors that run a script as a notebook.
"""

# %% Scans: a KITTI sequence, a folder of .bin, .pcd or .ply files, or a scan stream
import sys

import matplotlib.pyplot as plt
import numpy as np

import lego_loam_sc as sc

scans = sc.open_scans(sys.argv[1])
first = next(scans)
sensor = sc.recognise_sensor(first, scans.facts)

# %% The SLAM, scan after scan
slam = sc.Slam(sensor, sc.load_settings("lego-loam-sc"), threads=2)
reports = [slam.process(first)]
# With arrays of your own: slam.process(points, stamp=..., offsets=..., rings=...)
for scan in scans:
    reports.append(slam.process(scan))

lost = sum(report.status == sc.Status.lost for report in reports)
print(f"{len(reports)} scans, {lost} lost, {len(slam.key_frames())} key frames")
for loop in slam.loops():
    x, y, z = loop.T_match_query[:3, 3]
    print(f"key frame {loop.query} is {np.hypot(x, y):.2f} m from key frame {loop.match}")

# %% From above: the map, the trajectory before and after loops
points = slam.map(voxel_size=0.2)
before, after = slam.odometry(), slam.trajectory()

figure, (above, height) = plt.subplots(2, height_ratios=(4, 1), layout="constrained")
figure.set_size_inches(8, 9)
above.scatter(points[:, 0], points[:, 1], s=0.2, c=points[:, 2], cmap="viridis", rasterized=True)
above.plot(*before.poses[:, :2, 3].T, "C1--", label="before loops")
above.plot(*after.poses[:, :2, 3].T, "C3", label="after loops")
key_frames = slam.key_frames().poses[:, :2, 3]
for loop in slam.loops():
    above.plot(*key_frames[[loop.match, loop.query]].T, "C0", linewidth=3)
above.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
above.legend()

# %% Height over time
height.plot(after.stamps - after.stamps[0], after.poses[:, 2, 3])
height.set(xlabel="time (s)", ylabel="z (m)")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "run.png", dpi=150)
