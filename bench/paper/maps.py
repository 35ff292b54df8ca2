# SPDX-License-Identifier: BSD-3-Clause
"""Maps from above: figures 5, 6, 11, 12 and 13."""

import dataclasses

import numpy as np
import style
from matplotlib import pyplot as plt
from measured import Run
from scipy.spatial import cKDTree

VOXEL = 0.1  # m, of map.ply; finer pixels would show its grid
FLOOR_HEIGHT = 2.0  # m; a car park whose path rises more has two floors

# What is drawn, m over the LiDAR. A car park's ceiling would hide the rest. Up to `floor` all is
# floor and road, drawn in grey.
CAR_PARK = {"band": (-1.1, 1.0), "floor": -0.6, "top": 1.0}
CITY = {"band": (-6.0, 15.0), "floor": -1.2, "top": 6.0}


def read_ply(path):
    """x y z of a run's map.ply, (n, 3), m."""
    content = path.read_bytes()
    header, data = content.split(b"end_header\n", 1)
    count = int(header.split(b"element vertex ")[1].split()[0])
    # The fourth and fifth columns are the intensity and the key frame.
    return np.frombuffer(data, "<f4", 5 * count).reshape(count, 5)[:, :3]


def nearest_positions(points, positions):
    """For each point the position of the vehicle that is nearest to it."""
    # Another floor is nearer than a far wall, so height counts more than distance.
    weights = np.array([1.0, 1.0, 4.0])
    _, nearest = cKDTree(positions * weights).query(points * weights, workers=-1)
    return positions[nearest]


def paint(axes, drawn, extent, pixel):
    """Draws the highest point of each pixel (m) in the colour of its height; returns the image."""
    left, right, bottom, top = extent
    columns, rows = int((right - left) / pixel), int((top - bottom) / pixel)
    column = np.floor((drawn.points[:, 0] - left) / pixel).astype(int)
    row = np.floor((drawn.points[:, 1] - bottom) / pixel).astype(int)
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    order = np.flatnonzero(inside)[np.argsort(drawn.heights[inside], kind="stable")]
    picture = np.full((rows, columns), np.nan)
    picture[row[order], column[order]] = drawn.heights[order]
    return axes.imshow(
        picture,
        origin="lower",
        extent=(left, left + columns * pixel, bottom, bottom + rows * pixel),
        cmap=plt.get_cmap("turbo").with_extremes(under="#d8d8d8"),
        vmin=drawn.kind["floor"],
        vmax=drawn.kind["top"],
        interpolation="nearest",
    )


@dataclasses.dataclass(frozen=True)
class Map:
    """The part of a run's map that is drawn; `kind` is CAR_PARK or CITY."""

    run: Run
    kind: dict
    points: np.ndarray  # (n, 3), m
    heights: np.ndarray  # (n,), over the LiDAR where it passed nearest, m
    levels: np.ndarray  # (n,), of the LiDAR where it passed nearest, m

    @staticmethod
    def of(run, kind):
        points = read_ply(run.folder / "map.ply")
        levels = nearest_positions(points, run.trajectory.positions[::5])[:, 2]
        heights = points[:, 2] - levels
        return Map(run, kind, points, heights, levels).only(
            (heights > kind["band"][0]) & (heights < kind["band"][1])
        )

    def only(self, kept):
        return Map(self.run, self.kind, self.points[kept], self.heights[kept], self.levels[kept])


def bounds(run, margin):
    """The rectangle around a trajectory, m."""
    low = run.trajectory.positions[:, :2].min(axis=0) - margin
    high = run.trajectory.positions[:, :2].max(axis=0) + margin
    return (low[0], high[0], low[1], high[1])


def around_start_and_end(run, half):
    """A square with the half side `half`, or more when the start and the end need it, m."""
    ends = run.trajectory.positions[[0, -1], :2]
    x, y = ends.mean(axis=0)
    half = max(half, 0.7 * np.abs(ends[1] - ends[0]).max())
    return (x - half, x + half, y - half, y + half)


def split_floors(maps):
    """(word for the titles, maps) of each floor that our own trajectory was on, the upper first."""
    heights = maps[-1].run.trajectory.positions[:, 2]
    if np.ptp(heights) < FLOOR_HEIGHT:
        return [("", maps)]
    middle = 0.5 * (heights.min() + heights.max())
    return [
        (", upper floor", [drawn.only(drawn.levels >= middle) for drawn in maps]),
        (", lower floor", [drawn.only(drawn.levels < middle) for drawn in maps]),
    ]


def draw(floors, path, extent, box, width):
    """Rows of panels, `width` inches each; `box` is framed unless it is the whole extent."""
    left, right, bottom, top = extent
    height = width * (top - bottom) / (right - left) + 0.5
    result, axes = style.figure(len(floors[0][1]), len(floors), panel=(width, height))
    pixel = max((right - left) / (width * style.DPI), VOXEL)
    panels = [(word, drawn) for word, maps in floors for drawn in maps]
    image = None
    for axis, (word, drawn) in zip(axes, panels, strict=False):
        image = paint(axis, drawn, extent, pixel)
        style.from_above(axis, style.NAMES[drawn.run.folder.name] + word, extent)
        if box != extent:
            style.frame(axis, box)
    bar = result.colorbar(image, ax=axes, shrink=0.7, pad=0.01, extend="min")
    bar.set_label("height over the LiDAR (m)")
    style.save(result, path)


def city(world, folder):
    """Figures 5 and 6."""
    maps = [Map.of(world.runs[method], CITY) for method in ("lego-loam", "lego-loam-sc")]
    ours = maps[-1].run
    box = around_start_and_end(ours, 30.0)
    draw([("", maps)], folder / "fig05.png", bounds(ours, 40.0), box, 5.0)
    draw([("", maps)], folder / "fig06.png", box, box, 5.0)


def car_parks(first, second, folder):
    """Figures 11 to 13."""
    methods = ("loam", "lego-loam", "lego-loam-sc")
    for world, name in ((first, "fig11.png"), (second, "fig12.png")):
        maps = [Map.of(world.runs[method], CAR_PARK) for method in methods]
        ours = maps[-1].run
        box = around_start_and_end(ours, 8.0)
        draw(split_floors(maps), folder / name, bounds(ours, 15.0), box, 4.0)
        if world is first:
            draw([("", maps[1:])], folder / "fig13.png", box, box, 4.5)
