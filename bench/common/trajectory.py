# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories as arrays: reading, interpolation, alignment, errors of the last pose."""

import dataclasses
import math

import numpy as np
from scipy.spatial.transform import Rotation


@dataclasses.dataclass(frozen=True)
class Trajectory:
    """Poses of the LiDAR in some map frame: `stamps` (n,) in s, `poses` (n, 4, 4) in m."""

    stamps: np.ndarray
    poses: np.ndarray

    @property
    def positions(self):
        return self.poses[:, :3, 3]

    @property
    def path(self):
        """Metres travelled up to each pose."""
        steps = np.linalg.norm(np.diff(self.positions, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def duration(self):
        """Seconds of the recording: from the first scan to the end of the last."""
        return (self.stamps[-1] - self.stamps[0]) * len(self.stamps) / (len(self.stamps) - 1)

    def first(self, count):
        return Trajectory(self.stamps[:count], self.poses[:count])

    def at(self, stamps):
        """Poses at other times, (k, 4, 4): between two poses the motion from one to the other.

        It goes on beyond the ends, as a sweep does after the last stamp, for as long as one motion
        lasts and no further.
        """
        last = len(self.stamps) - 2
        before = np.clip(np.searchsorted(self.stamps, stamps, side="right") - 1, 0, last)
        duration = self.stamps[before + 1] - self.stamps[before]
        share = np.clip((stamps - self.stamps[before]) / duration, -1.0, 2.0)
        here, motion = self.poses[before], inverse(self.poses[before]) @ self.poses[before + 1]
        part = np.tile(np.eye(4), (len(share), 1, 1))
        turn = share[:, None] * rotations(motion).as_rotvec()
        part[:, :3, :3] = Rotation.from_rotvec(turn).as_matrix()
        part[:, :3, 3] = share[:, None] * motion[:, :3, 3]
        return here @ part


def rotations(poses):
    return Rotation.from_matrix(poses[..., :3, :3])


def inverse(poses):
    """Inverse of rigid transforms, (..., 4, 4)."""
    return np.linalg.inv(poses)


def pose(position, rotation):
    """The 4 x 4 matrix of a position (m) and a scipy Rotation."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation.as_matrix()
    matrix[:3, 3] = position
    return matrix


def read_tum(path):
    rows = np.loadtxt(path, ndmin=2)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, :3] = Rotation.from_quat(rows[:, 4:8]).as_matrix()
    poses[:, :3, 3] = rows[:, 1:4]
    return Trajectory(rows[:, 0], poses)


def write_tum(path, trajectory):
    quaternions = rotations(trajectory.poses).as_quat()
    rows = np.column_stack([trajectory.stamps, trajectory.positions, quaternions])
    np.savetxt(path, rows, fmt="%.9f")


def read_kitti(folder):
    """Truth of a KITTI sequence folder as the LiDAR's trajectory.

    Needs times.txt, calib.txt and poses.txt; the poses may also lie where the benchmark's own
    archive has them, in ../../poses/NN.txt.
    """
    poses_path = folder / "poses.txt"
    if not poses_path.is_file():
        poses_path = folder.parent.parent / "poses" / f"{folder.resolve().name}.txt"
    poses = homogeneous(np.loadtxt(poses_path, ndmin=2))
    calibration = (folder / "calib.txt").read_text().splitlines()
    numbers = next(line.split()[1:] for line in calibration if line.startswith("Tr:"))
    T_camera_lidar = homogeneous(np.array([numbers], dtype=float))[0]
    stamps = np.loadtxt(folder / "times.txt")[: len(poses)]
    return Trajectory(stamps, inverse(T_camera_lidar) @ poses @ T_camera_lidar)


def homogeneous(rows):
    """KITTI's rows of twelve numbers as (n, 4, 4)."""
    matrices = np.tile(np.eye(4), (len(rows), 1, 1))
    matrices[:, :3, :] = rows.reshape(-1, 3, 4)
    return matrices


def paired(truth, estimate):
    """The parts of two trajectories that have the same stamps, within 10 ms."""
    nearest = np.searchsorted(truth.stamps, estimate.stamps - 0.01)
    nearest = np.minimum(nearest, len(truth.stamps) - 1)
    kept = np.abs(truth.stamps[nearest] - estimate.stamps) <= 0.01
    partners = nearest[kept]
    return (
        Trajectory(truth.stamps[partners], truth.poses[partners]),
        Trajectory(estimate.stamps[kept], estimate.poses[kept]),
    )


def aligned(truth, estimate):
    """`estimate` moved onto the truth by the best rigid motion (Umeyama 1991, no scale).

    Both trajectories must have the same stamps.
    """
    goal = truth.positions.mean(axis=0)
    center = estimate.positions.mean(axis=0)
    rotation, _ = Rotation.align_vectors(truth.positions - goal, estimate.positions - center)
    motion = pose(goal - rotation.apply(center), rotation)
    return Trajectory(estimate.stamps, motion @ estimate.poses)


def started_alike(truth, estimate):
    """`estimate` moved so that its first pose is the first true pose."""
    motion = truth.poses[0] @ inverse(estimate.poses[0])
    return Trajectory(estimate.stamps, motion @ estimate.poses)


@dataclasses.dataclass(frozen=True)
class EndError:
    """The error of the last pose when both start at the same pose, as in the paper's table 3."""

    x: float  # m, along the axes of the first pose
    y: float
    z: float
    pitch: float  # deg
    yaw: float
    roll: float
    rotation: float  # deg, the angle of the whole rotation

    @property
    def translation(self):
        return math.sqrt(self.x**2 + self.y**2 + self.z**2)


def end_error(truth, estimate):
    true_motion = inverse(truth.poses[0]) @ truth.poses[-1]
    motion = inverse(estimate.poses[0]) @ estimate.poses[-1]
    x, y, z = motion[:3, 3] - true_motion[:3, 3]
    rotation = rotations(true_motion).inv() * rotations(motion)
    yaw, pitch, roll = rotation.as_euler("ZYX", degrees=True)
    return EndError(x, y, z, pitch, yaw, roll, math.degrees(rotation.magnitude()))
