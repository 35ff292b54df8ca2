# SPDX-License-Identifier: BSD-3-Clause
"""Decodes the messages that are needed, from ROS 1 and ROS 2."""

import math
from functools import cache
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from lego_loam_sc.compression import ZSTD_MAGIC, decompress
from lego_loam_sc.errors import InputError

POINT_CLOUD = "sensor_msgs/msg/PointCloud2"
TRANSFORMS = "tf2_msgs/msg/TFMessage"


@cache
def _typestore(encoding: str) -> Any:
    if encoding != "ros1":
        return get_typestore(Stores.ROS2_HUMBLE)
    store = get_typestore(Stores.ROS1_NOETIC)  # which lacks tf2_msgs
    store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TRANSFORMS))
    return store


def decode(type_name: str, encoding: str, data: bytes | memoryview) -> Any:
    """The message with its fields as attributes. Raises InputError when it cannot be decoded."""
    store = _typestore(encoding)
    if data[:4] == ZSTD_MAGIC:  # no message begins like this: rosbag2 compressed it
        data = decompress("zstd", data)
    data = memoryview(data)  # rosbags would copy bytes
    try:
        if encoding == "ros1":
            return store.deserialize_ros1(data, type_name)
        if encoding == "cdr":
            return store.deserialize_cdr(data, type_name)
    except Exception as error:  # any kind comes out of damaged bytes
        raise InputError(f"it cannot be decoded ({error})") from error
    raise InputError(f'its encoding "{encoding}" is not known')


def stamp_ns(header: Any) -> int:
    """The stamp of a std_msgs/Header."""
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


def describe_transforms(message: Any) -> list[str]:
    """A sentence for each transform of a TFMessage."""
    sentences = []
    for stamped in message.transforms:
        move, turn = stamped.transform.translation, stamped.transform.rotation
        roll, pitch, yaw = (math.degrees(angle) for angle in _roll_pitch_yaw(turn))
        sentences.append(
            f"static transform {stamped.header.frame_id} to {stamped.child_frame_id}: "
            f"x {move.x:.3f} y {move.y:.3f} z {move.z:.3f} m, "
            f"roll {roll:.2f} pitch {pitch:.2f} yaw {yaw:.2f} degrees"
        )
    return sentences


def _roll_pitch_yaw(q: Any) -> tuple[float, float, float]:
    """Angles of the quaternion `q`: R = R_z(yaw) R_y(pitch) R_x(roll)."""
    return (
        math.atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)),
        math.asin(max(-1.0, min(1.0, 2 * (q.w * q.y - q.z * q.x)))),
        math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)),
    )
