# SPDX-License-Identifier: BSD-3-Clause
"""Scans as the peers' own dataset classes hand them out: points and times in double precision."""

import dataclasses
import pathlib
import struct

import numpy as np

NONE = np.empty(0)


@dataclasses.dataclass(frozen=True)
class Scan:
    """One sweep: `points` (n, 3) in m, `times` (n,) in s after `stamp`, empty when it has none."""

    stamp: float  # s
    points: np.ndarray
    times: np.ndarray


def read(path):
    """The scans of a KITTI sequence folder or of a scan stream in a file, one after the other."""
    path = pathlib.Path(path)
    return from_folder(path) if path.is_dir() else from_stream(path)


def from_folder(folder):
    """KITTI's layout; the points have no times."""
    files = sorted((folder / "velodyne").glob("*.bin"))
    times_file = folder / "times.txt"
    stamps = np.loadtxt(times_file) if times_file.is_file() else 0.1 * np.arange(len(files))
    for stamp, file in zip(stamps, files, strict=False):
        points = np.fromfile(file, dtype="<f4").reshape(-1, 4)[:, :3]
        yield Scan(float(stamp), points.astype(np.float64), NONE)


def from_stream(path):
    """The format of docs/scan-stream.md; intensities and rings are passed over."""
    with path.open("rb") as file:
        magic, version, length = struct.unpack("<8sII", file.read(16))
        if magic != b"LLSCSCAN" or version != 1:
            raise ValueError(f"{path} is no scan stream of version 1")
        file.seek(length, 1)
        while head := file.read(20):
            marker, arrays, stamp_ns, count = struct.unpack("<4sIqI", head)
            if marker != b"SCAN":
                raise ValueError(f"{path}: no scan begins at byte {file.tell() - 20}")
            points = np.fromfile(file, dtype="<f4", count=3 * count).reshape(-1, 3)
            file.seek(count * (4 * bool(arrays & 1) + 2 * bool(arrays & 2)), 1)
            offsets = np.fromfile(file, dtype="<i4", count=count) if arrays & 4 else NONE
            yield Scan(1e-9 * stamp_ns, points.astype(np.float64), 1e-9 * offsets)
