# SPDX-License-Identifier: BSD-3-Clause
"""Figure 10: the two clouds of a loop, before and after it."""

import numpy as np
import style

from trajectory import inverse

CURRENT, HISTORICAL = "#00a000", "#e02020"
BAND = (-0.6, 1.0)  # m over the LiDAR: walls, columns and cars, neither floor nor ceiling
HALF = 16.0  # m, half the side of what is drawn


def read_scan(folder, number):
    """x y z of a scan, (n, 3), cut to BAND."""
    points = np.fromfile(folder / "velodyne" / f"{number:06}.bin", "<f4").reshape(-1, 4)[:, :3]
    return points[(points[:, 2] > BAND[0]) & (points[:, 2] < BAND[1])]


def between(poses, loop):
    """The query's pose in the frame of the match."""
    return inverse(poses[loop.match]) @ poses[loop.query]


def most_needed(run, detector):
    """The loop of a detector whose two scans the odometry had put farthest from where they are."""
    loops = [loop for loop in run.accepted_loops if loop.detector == detector]
    odometry, final = run.odometry.at(run.stamps_of_scans), run.trajectory.at(run.stamps_of_scans)

    def correction(loop):
        motion = inverse(between(final, loop)) @ between(odometry, loop)
        return np.linalg.norm(motion[:3, 3])

    return max(loops, key=correction, default=None)


def distance_from_truth(run, loop, T_match_query):
    """m between where the query lies and where it should, seen from the match."""
    poses = run.world.truth.at(run.stamps_of_scans)
    return np.linalg.norm((inverse(between(poses, loop)) @ T_match_query)[:3, 3])


def draw(axes, run, loop, poses, title):
    motion = between(poses.at(run.stamps_of_scans), loop)
    match = read_scan(run.world.scan_folder, loop.match)
    query = read_scan(run.world.scan_folder, loop.query) @ motion[:3, :3].T + motion[:3, 3]
    axes.scatter(*match[:, :2].T, c=HISTORICAL, s=5.0, linewidths=0, label="historical frame")
    axes.scatter(*query[:, :2].T, c=CURRENT, s=1.5, linewidths=0, label="current frame")
    title = f"{title}: {distance_from_truth(run, loop, motion):.2f} m off"
    style.from_above(axes, title, (-HALF, HALF, -HALF, HALF))


def figure(world, folder):
    """LeGO-LOAM's loop by distance above, Scan Context's below."""
    rows = (("a", "lego-loam", "radius"), ("b", "lego-loam-sc-paper", "scan_context"))
    result, axes = style.figure(2, 2, panel=(4.4, 4.4))
    for row, (letter, method, detector) in enumerate(rows):
        run = world.runs[method]
        loop = most_needed(run, detector)
        before, after = axes[2 * row : 2 * row + 2]
        if loop is None:
            before.set_title(f"({letter}) no loop")
            continue
        name = "distance" if detector == "radius" else "Scan Context"
        draw(before, run, loop, run.odometry, f"({letter}) before the loop by {name}")
        draw(after, run, loop, run.trajectory, f"({letter}) after it")
    labels = axes[0].get_legend_handles_labels()
    result.legend(*labels, markerscale=4, loc="outside lower center", ncols=2)
    style.save(result, folder / "fig10.png")
