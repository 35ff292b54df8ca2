# SPDX-License-Identifier: BSD-3-Clause
"""Writes the scan stream of docs/scan-stream.md."""

import struct
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

_VERSION = 1
_INTENSITY, _RING, _OFFSET = 1, 2, 4


@dataclass
class Scan:
    """One sweep. The optional arrays have one entry for each point."""

    stamp_ns: int
    points: np.ndarray  # (n, 3) float32, metres, frame of the sensor; NaN or zeros: no return
    intensity: np.ndarray | None = None  # float32
    ring: np.ndarray | None = None  # uint16
    offset_ns: np.ndarray | None = None  # int32, after the stamp


class ScanStreamWriter:
    """Writes scans to a binary stream, the header on construction."""

    def __init__(self, out: BinaryIO, facts: str = ""):
        self._out = out
        text = facts.encode()
        out.write(b"LLSCSCAN" + struct.pack("<II", _VERSION, len(text)) + text)

    def write(self, scan: Scan) -> None:
        """Writes one scan."""
        optional = [
            (_INTENSITY, scan.intensity, "<f4"),
            (_RING, scan.ring, "<u2"),
            (_OFFSET, scan.offset_ns, "<i4"),
        ]
        arrays = [(flag, array, kind) for flag, array, kind in optional if array is not None]
        flags = sum(flag for flag, _, _ in arrays)
        self._out.write(b"SCAN" + struct.pack("<IqI", flags, scan.stamp_ns, len(scan.points)))
        for _, array, kind in [(0, scan.points, "<f4"), *arrays]:
            self._out.write(np.ascontiguousarray(array, kind).data)
