# SPDX-License-Identifier: BSD-3-Clause
"""Picks what a scan needs out of sensor_msgs/PointCloud2, whichever driver wrote it."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lego_loam_sc.errors import InputError

# As ROS, Velodyne, Ouster, Hesai, RoboSense and Livox drivers name them; the first that a cloud has
# counts. The same names as for PCD and PLY files.
_INTENSITY_NAMES = ("intensity", "reflectivity", "i")
_RING_NAMES = ("ring", "line", "channel", "laser_id")
_TIME_NAMES = ("t", "time", "timestamp", "offset_time", "time_stamp", "timeOffset")

_NUMBER_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
_MOST_POINTS = 10_000_000  # of a scan stream
_MOST_RINGS = 256


@dataclass
class RawScan:
    """A scan whose times are still numbers without a meaning: see point_times.py."""

    stamp_ns: int
    points: np.ndarray  # (n, 3) float32
    intensity: np.ndarray | None
    ring: np.ndarray | None
    times: np.ndarray | None
    time_field: str | None  # name of the field that `times` comes from

    def returned(self) -> np.ndarray:
        """Which points the sensor got a return for: neither NaN nor all zeros."""
        x, y, z = self.points.T
        with np.errstate(invalid="ignore", over="ignore"):
            return np.isfinite(x + y + z) & ((x != 0) | (y != 0) | (z != 0))


def view_cloud(message: Any) -> np.ndarray:
    """The points of a PointCloud2 as a structured array (height, width), without a copy.

    Raises InputError when the layout contradicts itself.
    """
    order = ">" if message.is_bigendian else "<"
    fields = {
        field.name: (order + _NUMBER_TYPES[field.datatype], field.offset)
        for field in message.fields
        if field.name and field.datatype in _NUMBER_TYPES
    }
    height, width, step = message.height, message.width, message.point_step
    if height * width > _MOST_POINTS:
        raise InputError(f"it has {height} x {width} points, {_MOST_POINTS} are allowed")
    if height * width == 0:
        height, width = 1, 0
    row = message.row_step if height > 1 else width * step  # drivers leave it at 0 for one row
    for name, (kind, offset) in fields.items():
        if offset + np.dtype(kind).itemsize > step:
            raise InputError(f"field {name} lies outside of the {step} bytes of a point")
    if row < width * step or len(message.data) < (height - 1) * row + width * step:
        raise InputError(
            f"{height} x {width} points of {step} bytes do not fit into rows of {row} bytes, "
            f"{len(message.data)} bytes in all"
        )
    dtype = np.dtype(
        {
            "names": list(fields),
            "formats": [kind for kind, _ in fields.values()],
            "offsets": [offset for _, offset in fields.values()],
            "itemsize": step,
        }
    )
    return np.ndarray((height, width), dtype, message.data, strides=(row, step))


def pick_fields(cloud: np.ndarray, stamp_ns: int) -> RawScan:
    """Positions, intensities, rings and times of a structured array (height, width).

    Raises InputError when x, y or z is missing or a ring is out of range.
    """
    names = cloud.dtype.names or ()
    for axis in "xyz":
        if axis not in names:
            raise InputError(
                f"it has no field {axis}, only {', '.join(names) or 'none'}; a scan needs x, y, z"
            )
    # Each coordinate by itself first: copies between unaligned and interleaved numbers are slow.
    points = np.stack([cloud[axis].astype(np.float32).ravel() for axis in "xyz"], axis=-1)
    intensity, ring, time = (
        next((name for name in known if name in names), None)
        for known in (_INTENSITY_NAMES, _RING_NAMES, _TIME_NAMES)
    )
    scan = RawScan(
        stamp_ns,
        points,
        None if intensity is None else cloud[intensity].astype(np.float32).ravel(),
        None,
        None if time is None else cloud[time].astype(cloud[time].dtype.newbyteorder("=")).ravel(),
        time,
    )
    scan.ring = _rings_of_rows(cloud) if ring is None else _rings(cloud[ring].ravel(), ring, scan)
    return scan


def describe(cloud: np.ndarray) -> str:
    """Size and fields of a cloud in words."""
    height, width = cloud.shape
    size = f"{width} points" if height == 1 else f"{height * width} points ({height} x {width})"
    fields = (f"{name} {cloud.dtype[name]}" for name in cloud.dtype.names or ())
    return f"{size}, fields {', '.join(fields)}"


def _rings(values: np.ndarray, name: str, scan: RawScan) -> np.ndarray:
    if values.dtype.kind == "u" and values.dtype.itemsize <= 2:
        return values.astype(np.uint16)
    good = (values >= 0) & (values <= np.iinfo(np.uint16).max)
    bad = np.flatnonzero(~good & scan.returned())
    if bad.size:
        raise InputError(
            f"field {name} of point {bad[0]} is {values[bad[0]]}, a ring is between 0 and 65535"
        )
    return np.where(good, values, 0).astype(np.uint16)


def _rings_of_rows(cloud: np.ndarray) -> np.ndarray | None:
    """The shorter side of an organised cloud counts the beams; drivers store it either way."""
    height, width = cloud.shape
    if not 1 < min(height, width) <= _MOST_RINGS:
        return None
    rows, columns = np.indices(cloud.shape, np.uint16)
    return (rows if height < width else columns).ravel()
