# SPDX-License-Identifier: BSD-3-Clause
"""Real recordings in folders: what they hold, their truth, and their scans as peers take them."""

import dataclasses
import pathlib

import numpy as np

import scan_stream
from trajectory import Trajectory, read_kitti, read_tum

SUFFIXES = (".bin", ".pcd")
KITTI_CORRECTION_DEG = 0.205
# What the files do not say of the recordings in the two folders, by the beginning of the name.
SENSORS = {
    "kitti": "kitti",
    "brake": "kitti",
    "kaist": "os1-64-gen1",
    "vlp16": "vlp16",
    "rs16": "rs16",
    "hdl32": "hdl32e",
}
INDOOR = ("vlp16_corridor", "rs16_static")
STATIC = ("rs16_static",)
COARSE = ("nclt",)  # truth good to a metre or so
NO_DRIVES = ("loop_pair", "scan_context", "nclt_width0", "trajectories")


@dataclasses.dataclass(frozen=True)
class Recording:
    name: str
    path: pathlib.Path  # what `run` takes
    scans: tuple[pathlib.Path, ...]  # empty: a capture, which only ours reads

    def begins(self, names):
        return self.name.startswith(names)

    @property
    def sensor(self):
        """What --sensor takes; None when it is to be recognised."""
        own = self.path / "sensor.yaml"
        if own.is_file():
            return own
        known = [s for beginning, s in SENSORS.items() if self.begins(beginning)]
        return known[0] if known else None

    @property
    def is_kitti(self):
        return self.sensor == "kitti"

    @property
    def truth(self):
        """By the numbers of the scans, in the LiDAR's frame; None when there is none."""
        beside = self.path.with_suffix(".tum")
        for file in (self.path / "truth.tum", beside):
            if file.is_file():
                return read_tum(file)
        return read_kitti(self.path) if (self.path / "poses.txt").is_file() else None

    def stamps(self):
        times = self.path / "times.txt"
        if times.is_file():
            return np.loadtxt(times)[: len(self.scans)]
        return 0.1 * np.arange(len(self.scans))

    def points(self):
        """(n, 3) m of each scan in turn."""
        for file in self.scans:
            yield read_bin(file) if file.suffix == ".bin" else read_pcd(file)

    def write_stream(self, path):
        """All scans as one file for the peers, without times."""
        scans = (
            scan_stream.Scan(round(1e9 * stamp), points.astype("<f4"))
            for stamp, points in zip(self.stamps(), self.points(), strict=True)
        )
        scan_stream.write(path, "", scans)


def found(folders):
    """The recordings in these folders that are drives, by name."""
    recordings = {}
    for folder in folders:
        for path in sorted(folder.iterdir()):
            if path.name.startswith(NO_DRIVES):
                continue
            if path.suffix == ".pcap":
                recordings[path.name] = Recording(path.name, path, ())
            elif path.is_dir() and len(scans := scan_files(path)) > 1:
                recordings[path.name] = Recording(path.name, path, scans)
    return recordings


def scan_files(folder):
    inner = folder / "velodyne"
    files = (inner if inner.is_dir() else folder).iterdir()
    scans = [file for file in files if file.suffix in SUFFIXES and file.stem.isdigit()]
    return tuple(sorted(scans, key=lambda file: int(file.stem)))


def read_bin(path):
    return np.fromfile(path, dtype="<f4").reshape(-1, 4)[:, :3]


def read_pcd(path):
    """The points of a PCD file with DATA ascii or binary."""
    with path.open("rb") as file:
        header = {}
        while "DATA" not in header:
            words = file.readline().decode().split()
            if not words:
                raise ValueError(f"{path}: the header has no DATA")
            header[words[0]] = words[1:]
        kinds = dict(zip("FUI", "fui", strict=False))
        names = [f"{name}{k}" for k, name in enumerate(header["FIELDS"])]
        types = [
            kinds[kind] + size for kind, size in zip(header["TYPE"], header["SIZE"], strict=True)
        ]
        counts = [int(n) for n in header.get("COUNT", ["1"] * len(names))]
        where = [header["FIELDS"].index(axis) for axis in "xyz"]
        if header["DATA"] == ["ascii"]:
            starts = np.concatenate([[0], np.cumsum(counts)])
            return np.loadtxt(file, usecols=starts[where], ndmin=2)
        if header["DATA"] != ["binary"]:
            raise ValueError(f"{path}: DATA {' '.join(header['DATA'])} is not read")
        fields = np.dtype(
            [(n, "<" + t, (c,)) for n, t, c in zip(names, types, counts, strict=False)]
        )
        rows = np.frombuffer(file.read(), fields, int(header["POINTS"][0]))
        return np.column_stack([rows[names[k]][:, 0] for k in where])


def corrected(points, degrees):
    """The points with this angle added to their elevations."""
    x, y, z = points.T.astype(float)
    flat = np.hypot(x, y)
    up, far = np.arctan2(z, flat) + np.radians(degrees), np.hypot(flat, z)
    share = far * np.cos(up) / np.maximum(flat, 1e-6)
    return np.stack([x * share, y * share, far * np.sin(up)], axis=1)


def truth_at(truth, numbers):
    return Trajectory(truth.stamps[numbers], truth.poses[numbers])
