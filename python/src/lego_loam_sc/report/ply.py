# SPDX-License-Identifier: BSD-3-Clause
"""Reads the point clouds that lego-loam-sc writes."""

from pathlib import Path

import numpy as np

from lego_loam_sc.errors import InputError

_TYPES = {"float": "<f4", "int": "<i4", "ushort": "<u2", "uchar": "u1"}


def read_ply(path: Path) -> np.ndarray:
    """A structured array with the properties of each point."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}; run again") from error
    header, _, data = content.partition(b"end_header\n")
    words = [line.split() for line in header.decode(errors="replace").splitlines()]
    try:
        count = next(int(line[2]) for line in words if line[:2] == ["element", "vertex"])
        kind = np.dtype([(line[2], _TYPES[line[1]]) for line in words if line[0] == "property"])
        return np.frombuffer(data, kind, count)
    except (StopIteration, ValueError, KeyError, IndexError) as error:
        raise InputError(f"{path} is not as this version writes it; run again") from error


def positions_of(points: np.ndarray) -> np.ndarray:
    """(n, 3), m."""
    return np.stack([points["x"], points["y"], points["z"]], axis=1)
