# SPDX-License-Identifier: BSD-3-Clause
"""Bags with known content, written by rosbags."""

import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import Writer as Writer2
from rosbags.rosbag2.enums import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

CLOUD = "sensor_msgs/msg/PointCloud2"
START_NS = 1_700_000_000_000_000_000
PERIOD_NS = 100_000_000

_DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}
_ROS1 = get_typestore(Stores.ROS1_NOETIC)
_ROS2 = get_typestore(Stores.ROS2_HUMBLE)
_CUSTOM = "livox_ros_driver2/msg/CustomMsg"
_TRANSFORMS = "geometry_msgs/TransformStamped[] transforms"
_ROS1.register(get_types_from_msg(_TRANSFORMS, "tf2_msgs/msg/TFMessage"))
for _store in (_ROS1, _ROS2):
    _store.register(get_types_from_msg("uint8 lidar_id", _CUSTOM))

KINDS = {
    "ros1": (None, None),
    "ros1_lz4": (None, Writer1.CompressionFormat.LZ4),
    "ros1_bz2": (None, Writer1.CompressionFormat.BZ2),
    "mcap": (StoragePlugin.MCAP, None),
    "mcap_chunks": (StoragePlugin.MCAP, CompressionMode.STORAGE),
    "mcap_messages": (StoragePlugin.MCAP, CompressionMode.MESSAGE),
    "mcap_file": (StoragePlugin.MCAP, CompressionMode.FILE),
    "sqlite": (StoragePlugin.SQLITE3, None),
    "sqlite_messages": (StoragePlugin.SQLITE3, CompressionMode.MESSAGE),
    "sqlite_file": (StoragePlugin.SQLITE3, CompressionMode.FILE),
}


def stamp_of(number: int) -> int:
    """The stamp of message `number`, ns."""
    return START_NS + number * PERIOD_NS


def sweep(number: int, points: int = 200) -> np.ndarray:
    """A structured array of points in the layout of the Velodyne driver; random yet the same."""
    random = np.random.default_rng(number)
    layout = {
        "names": ["x", "y", "z", "intensity", "ring", "time"],
        "formats": ["<f4", "<f4", "<f4", "<f4", "<u2", "<f4"],
        "offsets": [0, 4, 8, 12, 16, 18],
        "itemsize": 22,
    }
    cloud = np.zeros(points, np.dtype(layout))
    for name in ("x", "y", "z", "intensity"):
        cloud[name] = random.uniform(1, 50, points)
    cloud["ring"] = np.arange(points) % 16
    cloud["time"] = np.linspace(0, 0.099, points)
    return cloud


class Messages:
    """Makes messages for ROS 1 or ROS 2."""

    def __init__(self, ros1: bool):
        self.store = _ROS1 if ros1 else _ROS2
        self._seq = {"seq": 0} if ros1 else {}

    def make(self, type_name: str, /, **fields: Any) -> Any:
        """A message of a type such as std_msgs/msg/String."""
        return self.store.types[type_name](**fields)

    def header(self, stamp_ns: int, frame: str = "lidar") -> Any:
        stamp = self.make(
            "builtin_interfaces/msg/Time",
            sec=stamp_ns // 1_000_000_000,
            nanosec=stamp_ns % 1_000_000_000,
        )
        return self.make("std_msgs/msg/Header", stamp=stamp, frame_id=frame, **self._seq)

    def cloud(self, stamp_ns: int, points: np.ndarray, row_padding: int = 0) -> Any:
        """A PointCloud2 of a structured array (width,) or (height, width)."""
        rows = points.reshape(1, -1) if points.ndim == 1 else points
        height, width = rows.shape
        step = points.dtype.itemsize
        padding = b"\xab" * row_padding
        data = b"".join(row.tobytes() + padding for row in rows)
        fields = [
            self.make(
                "sensor_msgs/msg/PointField",
                name=name,
                offset=points.dtype.fields[name][1],
                datatype=_DATATYPES[points.dtype[name].str[1:]],
                count=1,
            )
            for name in points.dtype.names
        ]
        return self.make(
            CLOUD,
            header=self.header(stamp_ns),
            height=height,
            width=width,
            fields=fields,
            is_bigendian=points.dtype[0].str[0] == ">",
            point_step=step,
            row_step=width * step + row_padding,
            data=np.frombuffer(data, np.uint8),
            is_dense=False,
        )

    def text(self, data: str) -> Any:
        return self.make("std_msgs/msg/String", data=data)

    def custom(self) -> Any:
        return self.make(_CUSTOM, lidar_id=1)

    def static_transform(self, parent: str, child: str, x: float, yaw: float) -> Any:
        move = self.make("geometry_msgs/msg/Vector3", x=x, y=0.0, z=0.5)
        turn = self.make(
            "geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=np.sin(yaw / 2), w=np.cos(yaw / 2)
        )
        transform = self.make("geometry_msgs/msg/Transform", translation=move, rotation=turn)
        stamped = self.make(
            "geometry_msgs/msg/TransformStamped",
            header=self.header(START_NS, parent),
            child_frame_id=child,
            transform=transform,
        )
        return self.make("tf2_msgs/msg/TFMessage", transforms=[stamped])


def write_bag(folder: Path, kind: str, messages: Iterable[tuple[str, int, Any]]) -> Path:
    """Writes (topic, time of recording in ns, message) as a bag of a kind of KINDS."""
    plugin, compression = KINDS[kind]
    ros1 = plugin is None
    store = _ROS1 if ros1 else _ROS2
    path = folder / (f"{kind}.bag" if ros1 else kind)
    writer = Writer1(path) if ros1 else Writer2(path, version=9, storage_plugin=plugin)
    if compression:
        writer.set_compression(*([compression] if ros1 else [compression, CompressionFormat.ZSTD]))
    connections: dict[tuple[str, str], Any] = {}
    with writer:
        for topic, time_ns, message in messages:
            name = message.__msgtype__
            key = (topic, name)
            if key not in connections:
                connections[key] = writer.add_connection(topic, name, typestore=store)
            serialize = store.serialize_ros1 if ros1 else store.serialize_cdr
            writer.write(connections[key], time_ns, serialize(message, name))
    return path


def write_sweeps(folder: Path, kind: str, count: int, points: int = 200) -> Path:
    """A bag of `count` messages on /points, nothing else."""
    make = Messages(kind.startswith("ros1"))
    return write_bag(
        folder,
        kind,
        (("/points", stamp_of(k), make.cloud(stamp_of(k), sweep(k, points))) for k in range(count)),
    )


def write_scans(folder: Path, kind: str, topic: str, scans: Iterable[Any]) -> Path:
    """A bag of scans of a stream, with the fields that they have."""
    make = Messages(kind.startswith("ros1"))

    def messages():
        for scan in scans:
            optional = {
                "intensity": ("<f4", scan.intensity),
                "ring": ("<u2", scan.ring),
                "t": ("<i4", scan.offset_ns),
            }
            optional = {name: field for name, field in optional.items() if field[1] is not None}
            kinds = [(name, "<f4") for name in "xyz"]
            kinds += [(name, kind) for name, (kind, _) in optional.items()]
            cloud = np.zeros(len(scan.points), kinds)
            cloud["x"], cloud["y"], cloud["z"] = scan.points.T
            for name, (_, values) in optional.items():
                cloud[name] = values
            yield topic, scan.stamp_ns, make.cloud(scan.stamp_ns, cloud)

    return write_bag(folder, kind, messages())


def storage_file(bag: Path) -> Path:
    """The file that holds the messages of a bag."""
    return next(bag.glob(f"{bag.name}.*")) if bag.is_dir() else bag


def copy_bag(bag: Path, folder: Path, data: bytes) -> Path:
    """A copy of `bag` whose storage file holds `data`."""
    folder.mkdir(exist_ok=True)
    copy = folder / bag.name
    if bag.is_dir():
        shutil.copytree(bag, copy, dirs_exist_ok=True)
    storage = copy / storage_file(bag).name if bag.is_dir() else copy
    storage.write_bytes(data)
    return copy
