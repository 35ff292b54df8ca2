# SPDX-License-Identifier: BSD-3-Clause
"""The loops in space, and what the 3-D views are given."""

import base64

import numpy as np

from lego_loam_sc.report.results import Cloud, Results

_LOOP_POINTS = 12_000  # of each scan of a loop, drawn at random
_CLOUD_STEP = 0.005  # m, of the scans of loops; as exact as a key frame
_SEED = 1


def encode(values: np.ndarray, kind: str) -> dict:
    """An array that the page decodes: its numpy type and its bytes."""
    return {"type": kind, "bytes": base64.b64encode(values.astype(kind).tobytes()).decode()}


def scene(results: Results, most_points: int) -> dict:
    """The map and the trajectory, the live one too when loops changed it. Coordinates are relative
    to the middle of the trajectory, so that 32 bits are enough for them."""
    centre = results.poses[:, 1:4].mean(axis=0)
    paths = {"final": encode(results.poses[:, 1:4] - centre, "f4")}
    if results.corrected:
        paths["live"] = encode(results.odometry[:, 1:4] - centre, "f4")
    return {
        "centre": centre.tolist(),
        "time": encode(results.poses[:, 0] - results.start, "f4"),
        "paths": paths,
        "map": _map(results, results.map, centre, most_points) if results.map else None,
    }


def _map(results: Results, cloud: Cloud, centre: np.ndarray, most_points: int) -> dict | None:
    """The points in random order: any first part of them is a thinner map."""
    if len(cloud) == 0:
        return None
    chosen = np.random.default_rng(_SEED).permutation(len(cloud))[:most_points]
    positions = cloud.positions[chosen] - centre
    low = positions.min(axis=0)
    step = max(float(np.ptp(positions, axis=0).max()) / 65535, 1e-6)
    poses = results.poses[results.pose_of_key_frame][cloud.key_frame[chosen]]
    seconds = poses[:, 0] - results.start
    above = cloud.positions[chosen, 2] - poses[:, 3]
    dim, bright = np.quantile(cloud.intensity[chosen], (0.02, 0.98))
    return {
        "total": len(cloud),
        "count": len(chosen),
        "low": low.tolist(),
        "step": step,
        "position": encode(np.round((positions - low) / step), "u2"),
        "height": np.quantile(cloud.positions[chosen, 2], (0.01, 0.99)).tolist(),
        "intensity": encode(_to_bytes(cloud.intensity[chosen], dim, bright), "u1"),
        "intensityRange": [float(dim), float(bright)],
        "time": encode(_to_bytes(seconds, 0.0, seconds.max()), "u1"),
        "timeRange": [0.0, float(seconds.max())],
        # cm over the LiDAR that saw it, for looking under roofs
        "above": encode(np.clip(np.round(100 * above), -32767, 32767), "i2"),
        "aboveRange": np.quantile(above, (0.01, 0.99)).tolist(),
        "roofed": _is_roofed(positions, results.poses[:, 1:4] - centre),
    }


def _to_bytes(values: np.ndarray, low: float, high: float) -> np.ndarray:
    return np.round(255 * np.clip((values - low) / max(high - low, 1e-9), 0, 1))


def _is_roofed(positions: np.ndarray, path: np.ndarray) -> bool:
    """True when most of the path has something over it."""
    low = path[:, :2].min(axis=0)

    def cells(points: np.ndarray) -> np.ndarray:
        column, row = np.floor((points[:, :2] - low) / 2.0).astype(int).T  # of 2 m
        return column + 1_000_003 * row

    seen, first = np.unique(cells(path), return_index=True)
    cell = cells(positions)
    nearest = np.minimum(np.searchsorted(seen, cell), len(seen) - 1)
    over = positions[:, 2] - path[first[nearest], 2]
    covered = np.unique(cell[(seen[nearest] == cell) & (over > 0.8) & (over < 8.0)])
    return len(covered) > 0.5 * len(seen)


def loops(results: Results) -> list[dict]:
    """Each candidate with its places on the trajectories and, in the order of the run, all that
    loops.csv says of it."""
    centre = results.poses[:, 1:4].mean(axis=0)
    described = []
    for row in results.loops:
        query = results.pose_of_scan[int(row["query_scan"])]
        match = results.pose_of_scan[int(row["match_scan"])]
        after = _from_row(row)
        live = relative(results.odometry[match], results.odometry[query])
        scan_context = row["detector"] == "scan_context"
        before = _turned(float(row["yaw_deg"])) if scan_context else live
        shift = np.linalg.inv(live) @ after
        described.append(
            {
                **row,
                "accepted": row["verdict"] == "accepted",
                "place": [(results.poses[k, 1:4] - centre).tolist() for k in (match, query)],
                "time": [float(results.poses[k, 0] - results.start) for k in (match, query)],
                "before": before.T.ravel().tolist(),  # by columns, as WebGL has them
                "after": after.T.ravel().tolist(),
                "drift_m": float(np.linalg.norm(shift[:3, 3])),
                "drift_deg": float(np.degrees(_angle(shift))),
            }
        )
    return described


def loop_clouds(results: Results) -> dict[str, dict]:
    """The scans of accepted loops by the number of their key frame."""
    if results.loop_scans is None:
        return {}
    random = np.random.default_rng(_SEED)
    clouds = {}
    for number in np.unique(results.loop_scans.key_frame):
        points = results.loop_scans.positions[results.loop_scans.key_frame == number]
        points = random.permutation(points)[:_LOOP_POINTS]
        clouds[str(number)] = encode(np.round(points / _CLOUD_STEP), "i2")
    return {"step": _CLOUD_STEP, "points": clouds}


def relative(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """T_a_b of two rows of a TUM file."""
    return np.linalg.inv(_matrix(a)) @ _matrix(b)


def _matrix(row: np.ndarray) -> np.ndarray:
    x, y, z, w = row[4:8] / np.linalg.norm(row[4:8])
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = row[1:4]
    return matrix


def _turned(yaw_deg: float, pitch_deg: float = 0.0, roll_deg: float = 0.0) -> np.ndarray:
    """R_z(yaw) R_y(pitch) R_x(roll)"""
    angles = np.radians([yaw_deg, pitch_deg, roll_deg])
    (sy, sp, sr), (cy, cp, cr) = np.sin(angles), np.cos(angles)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return matrix


def _from_row(row: dict[str, str]) -> np.ndarray:
    """T_match_query as the verifier left it."""
    matrix = _turned(*(float(row[name]) for name in ("loop_yaw_deg", "pitch_deg", "roll_deg")))
    matrix[:3, 3] = [float(row[name]) for name in ("x", "y", "z")]
    return matrix


def _angle(transform: np.ndarray) -> float:
    return float(np.arccos(np.clip((np.trace(transform[:3, :3]) - 1) / 2, -1, 1)))
