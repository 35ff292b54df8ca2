# SPDX-License-Identifier: BSD-3-Clause
"""Scan streams, docs/scan-stream.md, with all of their arrays."""

import dataclasses
import struct

import numpy as np

HEAD = "<4sIqI"
ARRAYS = (("intensities", 1, "<f4"), ("rings", 2, "<u2"), ("offsets", 4, "<i4"))


@dataclasses.dataclass(frozen=True)
class Scan:
    """One sweep of n points; each optional array has n values or is None."""

    stamp_ns: int
    points: np.ndarray  # (n, 3) float32, m, in the sensor's frame
    intensities: np.ndarray | None = None
    rings: np.ndarray | None = None
    offsets: np.ndarray | None = None  # ns after the stamp

    def arrays(self):
        """The arrays that are there, by name."""
        names = ("points", *(name for name, _, _ in ARRAYS))
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    def kept(self, which):
        """The points that a mask or an index array chooses."""
        return dataclasses.replace(self, **{k: v[which] for k, v in self.arrays().items()})

    def with_points(self, points):
        return dataclasses.replace(self, points=points.astype("<f4"))


class Stream:
    """The scans of a file, each read when it is asked for."""

    def __init__(self, path):
        self.path = path
        self.starts = []
        with path.open("rb") as file:
            magic, version, length = struct.unpack("<8sII", file.read(16))
            if magic != b"LLSCSCAN" or version != 1:
                raise ValueError(f"{path} is no scan stream of version 1")
            self.facts = file.read(length).decode()
            start = file.tell()
            while head := file.read(struct.calcsize(HEAD)):
                self.starts.append(start)
                _, arrays, _, count = struct.unpack(HEAD, head)
                floats = sum(np.dtype(kind).itemsize for _, bit, kind in ARRAYS if arrays & bit)
                start = file.seek(count * (12 + floats), 1)

    def __len__(self):
        return len(self.starts)

    def __getitem__(self, index):
        with self.path.open("rb") as file:
            file.seek(self.starts[index])
            marker, arrays, stamp_ns, count = struct.unpack(HEAD, file.read(struct.calcsize(HEAD)))
            if marker != b"SCAN":
                raise ValueError(f"{self.path}: no scan begins at byte {self.starts[index]}")
            points = np.fromfile(file, dtype="<f4", count=3 * count).reshape(-1, 3)
            there = {
                name: np.fromfile(file, dtype=kind, count=count)
                for name, bit, kind in ARRAYS
                if arrays & bit
            }
            return Scan(stamp_ns, points, **there)


def write(path, facts, scans):
    text = facts.encode()
    with path.open("wb") as file:
        file.write(b"LLSCSCAN" + struct.pack("<II", 1, len(text)) + text)
        for scan in scans:
            there = [(bit, kind, getattr(scan, name)) for name, bit, kind in ARRAYS]
            there = [one for one in there if one[2] is not None]
            arrays = sum(bit for bit, _, _ in there)
            file.write(struct.pack(HEAD, b"SCAN", arrays, scan.stamp_ns, len(scan.points)))
            file.write(scan.points.astype("<f4").tobytes())
            for _, kind, values in there:
                file.write(values.astype(kind).tobytes())
