# SPDX-License-Identifier: BSD-3-Clause
"""Figure 9: what the front end makes of one scan of the RS-LiDAR-16."""

import pathlib
import tempfile

import numpy as np
import style

from program import call

METHOD = "lego-loam-sc-paper"
NEAR = 16.0  # m, half the side of what is drawn
CEILING = 1.2  # m over the LiDAR; higher points hide the rest
TYPES = {"float": "<f4", "int": "<i4", "ushort": "<u2", "uchar": "u1"}
PLANAR_LARGE, PLANAR_FLAT, EDGE_LARGE, EDGE_SHARP = 1, 2, 3, 4  # the property `feature`


def read_stages(scan):
    """What `lego-loam-sc inspect` says of the points of a scan, one record for each."""
    with tempfile.TemporaryDirectory() as folder:
        call("inspect", scan, "--sensor", "rs16", "--method", METHOD, "-o", folder)
        content = (pathlib.Path(folder) / "segments.ply").read_bytes()
    header, data = content.split(b"end_header\n", 1)
    properties = [line.split()[1:] for line in header.decode().splitlines() if "property" in line]
    return np.frombuffer(data, [(name, TYPES[kind]) for kind, name in properties])


def oblique(points):
    """Seen from behind and above at 40 degrees, without perspective: right and up, m."""
    angle = np.radians(40.0)
    right = -points[1]
    up = points[0] * np.sin(angle) + points[2] * np.cos(angle)
    return right, up


def draw(axes, title, layers):
    """`layers` are (points (3, n), colour or colours, size)."""
    axes.set_title(title, loc="left")
    axes.set_aspect("equal")
    axes.set_xlim(-NEAR, NEAR)
    axes.set_ylim(-0.72 * NEAR, 0.72 * NEAR)
    axes.axis("off")
    for points, colours, size in layers:
        axes.scatter(*oblique(points), c=colours, s=size, linewidths=0, rasterized=True)


def cluster_colours(clusters):
    """A colour for each cluster, neighbours told apart; none of them is the ground's red."""
    palette = np.array(
        ["#1f77b4", "#2ca02c", "#9467bd", "#8c564b", "#17becf", "#bcbd22", "#7f7f7f", "#e6a800"]
    )
    return palette[clusters.astype(int) % len(palette)]


def figure(scans, folder):
    """Of the scan at a quarter of the drive."""
    files = sorted((scans / "velodyne").iterdir())
    stages = read_stages(files[len(files) // 4])
    kept = (stages["z"] < CEILING) & (np.hypot(stages["x"], stages["y"]) < 1.6 * NEAR)
    stages = stages[kept]
    points = np.stack([stages["x"], stages["y"], stages["z"]])

    def those(*features):
        return points[:, np.isin(stages["feature"], features)]

    clustered = stages["cluster"] >= 0
    behind = (points, "#dddddd", 0.6)
    result, axes = style.figure(2, 2, panel=(4.8, 3.6))
    draw(axes[0], "(a) cloud", [(points, "#404040", 1.0)])
    draw(
        axes[1],
        "(b) ground red, segments in other colours",
        [
            (points[:, stages["ground"] > 0], "#e02020", 1.0),
            (points[:, clustered], cluster_colours(stages["cluster"][clustered]), 1.2),
        ],
    )
    draw(
        axes[2],
        "(c) 𝔽: edges blue, planar points orange",
        [
            behind,
            (those(PLANAR_LARGE, PLANAR_FLAT), "#ff8c00", 3.0),
            (those(EDGE_LARGE, EDGE_SHARP), "#0040ff", 5.0),
        ],
    )
    draw(
        axes[3],
        "(d) F: edges green, planar points pink",
        [behind, (those(PLANAR_FLAT), "#ff1493", 9.0), (those(EDGE_SHARP), "#00a000", 9.0)],
    )
    style.save(result, folder / "fig09.png")
