# SPDX-License-Identifier: BSD-3-Clause
"""Mean map entropy (Droeschel and Behnke 2014): how crisp a map of accumulated scans is."""

import math

import numpy as np
from scipy.spatial import cKDTree

RADIUS = 0.5  # m
VOXEL = 0.1  # m
NEIGHBOURS = 10  # fewest within the radius, the point itself included
QUERIES = 50_000  # most points whose entropy is computed
FLOOR = 0.001**2  # m^2, on each axis: a perfect plane has no volume
CHUNK = 2000


def accumulated(scans, poses, voxel=VOXEL):
    """The points of all scans in the map frame, thinned; `scans` are (n, 3) arrays, m.

    Each scan is thinned in its own frame, so that a system's poses do not decide which of its
    points are kept.
    """
    clouds = []
    for points, pose in zip(scans, poses, strict=True):
        points = thinned(points[np.isfinite(points).all(axis=1)].astype(float), voxel)
        clouds.append(points @ pose[:3, :3].T + pose[:3, 3])
    return np.concatenate(clouds)


def thinned(points, voxel):
    """The first point of each voxel, in the order of the points."""
    cells = np.floor(points / voxel).astype(np.int64)
    _, first = np.unique(cells, axis=0, return_index=True)
    return points[np.sort(first)]


def mean_map_entropy(points, radius=RADIUS, neighbours=NEIGHBOURS, queries=QUERIES):
    """Mean over points of 1/2 ln |2 pi e S|, S the covariance of what lies within `radius`.

    Every k-th point is asked, so that there are at most `queries`; those with fewer `neighbours`
    do not count. NaN when none counts.
    """
    tree = cKDTree(points)
    asked = points[:: max(1, math.ceil(len(points) / queries))]
    values = [
        entropies(points, tree.query_ball_point(asked[k : k + CHUNK], radius), neighbours)
        for k in range(0, len(asked), CHUNK)
    ]
    values = np.concatenate(values) if values else np.empty(0)
    return float(values.mean()) if len(values) else math.nan


def entropies(points, neighbourhoods, least):
    sizes = np.array([len(found) for found in neighbourhoods])
    kept = [found for found in neighbourhoods if len(found) >= least]
    if not kept:
        return np.empty(0)
    sizes = sizes[sizes >= least]
    starts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    near = points[np.concatenate(kept)]
    means = np.add.reduceat(near, starts) / sizes[:, None]
    off = near - np.repeat(means, sizes, axis=0)
    products = np.add.reduceat(off[:, :, None] * off[:, None, :], starts)
    covariances = products / sizes[:, None, None] + FLOOR * np.eye(3)
    _, logarithms = np.linalg.slogdet(covariances)
    return 0.5 * (3 * math.log(2 * math.pi * math.e) + logarithms)
