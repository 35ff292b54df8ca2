# SPDX-License-Identifier: BSD-3-Clause
"""One peer over one recording, in its own virtual environment: drive.py PEER INPUT OUTPUT OPTIONS.

OUTPUT is a folder; it gets trajectory.tum and process.json: the CPU seconds before the first scan
and the number of scans. OPTIONS is JSON: `settings` for the peer, `threads`, `deskew` (hand out the
times of the points), `kitti` (a real recording of KITTI).
"""

import importlib
import json
import pathlib
import resource
import sys

import numpy as np
import scans


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def quaternion(rotation):
    """x y z w of a rotation matrix: the eigenvector of Bar-Itzhack (2000)."""
    m = rotation
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], 0, 0, 0],
            [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], 0, 0],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], 0],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], np.trace(m)],
        ]
    )
    return np.linalg.eigh(k)[1][:, -1]


def write_tum(path, stamps, poses):
    rows = [
        [t, *pose[:3, 3], *quaternion(pose[:3, :3])] for t, pose in zip(stamps, poses, strict=False)
    ]
    np.savetxt(path, rows, fmt="%.9f")


def finite(scan):
    """Without the points that are none, as the peers' own readers hand a scan out."""
    kept = np.isfinite(scan.points).all(axis=1)
    times = scan.times[kept] if len(scan.times) else scan.times
    return scans.Scan(scan.stamp, scan.points[kept], times)


def main(peer, source, output, options):
    driver = importlib.import_module(f"with_{peer.replace('-', '_')}")
    odometry = driver.Odometry(options["settings"], options["threads"])
    stamps = []
    start = cpu_seconds()
    for scan in map(finite, scans.read(source)):
        points = driver.kitti_correction(scan.points) if options["kitti"] else scan.points
        swept = scan.times.max(initial=0.0)
        odometry.add(points, scan.times if options["deskew"] else scans.NONE)
        stamps.append(scan.stamp + driver.REFERENCE * swept)
    write_tum(output / "trajectory.tum", stamps, odometry.finish())
    process = {"start_cpu_seconds": start, "scans": len(stamps)}
    (output / "process.json").write_text(json.dumps(process))


if __name__ == "__main__":
    main(*sys.argv[1:3], pathlib.Path(sys.argv[3]), json.loads(sys.argv[4]))
