# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong with real sensors and drivers, done to the scans of a drive.

Each trouble draws its figures from a random generator (`draw`) and then changes frames (which scans
come when), scans (what is in them) or facts (what the header says of them).
"""

import dataclasses

import numpy as np

from scan_stream import Scan


@dataclasses.dataclass(frozen=True)
class Frame:
    """One scan to be written: scan `source` of the simulation, with `stamp_ns`.

    `counts`: it shows the truth of its moment, so its pose is judged. `noise`: it shows nothing.
    """

    source: int
    stamp_ns: int
    counts: bool = True
    noise: bool = False


@dataclasses.dataclass(frozen=True)
class Lidar:
    """What a driver knows of its sensor."""

    columns: int
    max_range: float  # m
    period: float  # s


@dataclasses.dataclass(frozen=True)
class Moment:
    """Where in the drive a scan is."""

    frame: Frame
    seconds: float  # when its source was measured, since the first scan
    lidar: Lidar


class Trouble:
    """Does nothing; the others override what they change."""

    deskew = True  # a user of a peer would leave the de-skewing on

    def draw(self, rng):
        """Figures, JSON, that decide this trouble for a whole drive."""
        return {}

    def frames(self, frames, figures, rng):
        return frames

    def scan(self, scan, figures, moment, rng):
        return scan

    def facts(self, facts):
        return facts


def ranges(scan):
    return np.linalg.norm(scan.points, axis=1)


def azimuths(scan):
    return np.arctan2(scan.points[:, 1], scan.points[:, 0])


def with_ranges(scan, new):
    return scan.with_points(scan.points * (new / np.maximum(ranges(scan), 1e-3))[:, None])


def joined(one, other):
    """The points of both; the arrays of `one` that `other` lacks are zeros there."""
    count = len(other.points)
    more = other.arrays()
    arrays = {
        name: np.concatenate([values, more.get(name, np.zeros(count, values.dtype))])
        for name, values in one.arrays().items()
    }
    return dataclasses.replace(one, **arrays)


def uniform(rng, low, high, digits=3):
    return round(float(rng.uniform(low, high)), digits)


class Dust(Trouble):
    """A share of the returns is nearer, mostly 1 to 6 m away."""

    def draw(self, rng):
        return {"share": uniform(rng, 0.03, 0.3)}

    def scan(self, scan, figures, moment, rng):
        far = ranges(scan)
        near = np.minimum(rng.gamma(2.0, 1.2, len(far)) + 0.6, far)
        return with_ranges(scan, np.where(rng.random(len(far)) < figures["share"], near, far))


class Rain(Trouble):
    """Drops anywhere on the ray, near ones more likely, and echoes that are lost."""

    def draw(self, rng):
        return {"drops": uniform(rng, 0.01, 0.1), "lost": uniform(rng, 0.02, 0.3)}

    def scan(self, scan, figures, moment, rng):
        scan = scan.kept(rng.random(len(scan.points)) >= figures["lost"])
        far = ranges(scan)
        drop = np.minimum(0.5 + rng.exponential(6.0, len(far)), far)
        return with_ranges(scan, np.where(rng.random(len(far)) < figures["drops"], drop, far))


class MaxRange(Trouble):
    """Where nothing was hit there is a point at one range."""

    def draw(self, rng):
        return {"radius": float(rng.choice([0, 0, 30, 60, 100]))}  # 0: the sensor's maximum

    def scan(self, scan, figures, moment, rng):
        return joined(scan, shell(scan, figures["radius"] or moment.lidar.max_range, moment, rng))


def shell(scan, radius, moment, rng):
    """Points at `radius` in the directions without a return, ring by ring and column by column."""
    columns = moment.lidar.columns
    rows, ring = np.unique(scan.rings, return_inverse=True)
    flat = np.hypot(scan.points[:, 0], scan.points[:, 1])
    up = np.arctan2(scan.points[:, 2], flat)
    elevation = np.array([np.median(up[ring == k]) for k in range(len(rows))])
    azimuth = azimuths(scan)
    column = np.floor((azimuth / (2 * np.pi) + 0.5) * columns).astype(int) % columns
    free = np.ones((len(rows), columns), bool)
    free[ring, column] = False
    row, column = np.nonzero(free)
    a, e = ((column + 0.5) / columns - 0.5) * 2 * np.pi, elevation[row]
    rays = np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)], axis=1)
    points = rays * (radius + rng.normal(0.0, 0.01, len(row)))[:, None]
    offsets = None
    if scan.offsets is not None:
        order = np.argsort(azimuth)
        nearest = np.searchsorted(azimuth[order], a).clip(0, len(order) - 1)
        offsets = scan.offsets[order][nearest]
    return Scan(scan.stamp_ns, points.astype("<f4"), rings=rows[row], offsets=offsets)


class VehicleBody(Trouble):
    """The vehicle itself: walls round the sensor that are open by some degrees to each side."""

    def draw(self, rng):
        return {
            "open_deg": float(rng.choice([45, 90, 120, 150])),
            "distance": uniform(rng, 1.2, 3.0),
            "heading_deg": float(rng.choice([0, 0, 0, 90, 180])),
        }

    def scan(self, scan, figures, moment, rng):
        turned = azimuths(scan) - np.radians(figures["heading_deg"])
        off = np.abs((turned + np.pi) % (2 * np.pi) - np.pi)
        facing = np.cos(off - np.pi)
        if figures["open_deg"] < 90:
            facing = np.maximum(facing, np.sin(off))
        wall = figures["distance"] / np.maximum(facing, 0.25)
        far = ranges(scan)
        hit = (off > np.radians(figures["open_deg"])) & (wall < far)
        return with_ranges(scan, np.where(hit, wall + rng.normal(0, 0.01, len(far)), far))


class Alongside(Trouble):
    """Vehicles that keep pace: a box at a place that hardly changes for the sensor."""

    SIZES = {"car": (4.2, 1.8, 0.2), "lorry": (9.0, 2.5, 2.4)}  # m: length, width, top

    def draw(self, rng):
        boxes = []
        for _ in range(int(rng.integers(1, 4))):
            kind = str(rng.choice(["car", "lorry"]))
            ahead = bool(rng.integers(2))
            x, y = (uniform(rng, 9, 16), 0.0) if ahead else (uniform(rng, -4, 6), 3.3)
            sway = uniform(rng, 0.0, 1.5)
            boxes.append({"kind": kind, "x": x, "y": y * int(rng.choice([-1, 1])), "sway": sway})
        return {"boxes": boxes}

    def scan(self, scan, figures, moment, rng):
        far = ranges(scan)
        rays = scan.points / np.maximum(far, 1e-3)[:, None]
        new = far
        for box in figures["boxes"]:
            length, width, top = self.SIZES[box["kind"]]
            x = box["x"] + box["sway"] * np.sin(0.7 * moment.seconds)
            middle = np.array([x, box["y"], 0.5 * (top - 1.5)])
            half = 0.5 * np.array([length, width, top + 1.5])
            new = np.minimum(new, entries(rays, middle - half, middle + half))
        hit = new < far
        return with_ranges(scan, np.where(hit, new + rng.normal(0, 0.01, len(far)), far))


def entries(rays, low, high):
    """Where rays from the origin enter a box, m; infinite when they do not."""
    with np.errstate(divide="ignore"):
        one, other = low / rays, high / rays
    enter = np.minimum(one, other).max(axis=1)
    leave = np.maximum(one, other).min(axis=1)
    return np.where((enter <= leave) & (enter > 0), enter, np.inf)


class Paused(Trouble):
    """The vehicle stands, and the driver repeats its last scan, byte for byte."""

    def draw(self, rng):
        return {"at": uniform(rng, 0.2, 1.0), "repeats": int(rng.integers(3, 20))}

    def frames(self, frames, figures, rng):
        at = min(int(figures["at"] * len(frames)), len(frames) - 1)
        gap = frames[1].stamp_ns - frames[0].stamp_ns
        pause = gap * figures["repeats"]
        same = [
            dataclasses.replace(frames[at], stamp_ns=frames[at].stamp_ns + gap * (k + 1))
            for k in range(figures["repeats"])
        ]
        later = [dataclasses.replace(f, stamp_ns=f.stamp_ns + pause) for f in frames[at + 1 :]]
        return frames[: at + 1] + same + later


class Frozen(Trouble):
    """The driver repeats a scan while the vehicle drives on."""

    def draw(self, rng):
        return {"at": uniform(rng, 0.2, 0.8), "repeats": int(rng.integers(1, 8))}

    def frames(self, frames, figures, rng):
        at = int(figures["at"] * len(frames))
        end = min(at + 1 + figures["repeats"], len(frames))
        same = [
            dataclasses.replace(frame, source=frames[at].source, counts=False)
            for frame in frames[at + 1 : end]
        ]
        return frames[: at + 1] + same + frames[end:]


class Dropped(Trouble):
    """Single scans do not arrive."""

    def draw(self, rng):
        return {"share": uniform(rng, 0.05, 0.4)}

    def frames(self, frames, figures, rng):
        kept = rng.random(len(frames)) >= figures["share"]
        return [frame for frame, keep in zip(frames, kept, strict=False) if keep]


class Gap(Trouble):
    """Scans in a row do not arrive."""

    def draw(self, rng):
        return {"at": uniform(rng, 0.2, 0.8), "scans": int(rng.integers(3, 11))}

    def frames(self, frames, figures, rng):
        at = int(figures["at"] * len(frames))
        return frames[:at] + frames[at + figures["scans"] :]


class StampJitter(Trouble):
    """Stamps of arrival: late by up to some tens of milliseconds."""

    def draw(self, rng):
        return {"late_ms": uniform(rng, 5, 60, 1)}

    def frames(self, frames, figures, rng):
        late = rng.uniform(0, 1e6 * figures["late_ms"], len(frames)).astype(int)
        return [
            dataclasses.replace(f, stamp_ns=f.stamp_ns + int(n))
            for f, n in zip(frames, late, strict=False)
        ]


class TimesTenFold(Trouble):
    """The times of the points are in a unit ten times too small."""

    def scan(self, scan, figures, moment, rng):
        return changed_times(scan, lambda t: np.minimum(10 * t.astype(np.int64), 2**31 - 1))


class TimesReversed(Trouble):
    """The times of the points run from the end of the sweep to its beginning."""

    def scan(self, scan, figures, moment, rng):
        return changed_times(scan, lambda t: t.max() - t)


class TimesZero(Trouble):
    """All points have the time 0."""

    deskew = False

    def scan(self, scan, figures, moment, rng):
        return changed_times(scan, np.zeros_like)


class TimesIgnored(Trouble):
    """The facts say that the points are compensated, and they are not."""

    deskew = False

    def facts(self, facts):
        return facts.replace("motion_compensated: false", "motion_compensated: true")


def changed_times(scan, change):
    if scan.offsets is None or not len(scan.offsets):
        return scan
    return dataclasses.replace(scan, offsets=change(scan.offsets))


class NoiseScans(Trouble):
    """Some scans in a row hold random ranges; in one drive of five all do, which has to be said."""

    def draw(self, rng):
        at, scans = uniform(rng, 0.1, 0.8), int(rng.integers(1, 6))
        return {"all": bool(rng.random() < 0.2), "at": at, "scans": scans}

    def frames(self, frames, figures, rng):
        if figures["all"]:
            return [dataclasses.replace(frame, noise=True) for frame in frames]
        at = int(figures["at"] * len(frames))
        end = at + figures["scans"]
        noise = [dataclasses.replace(f, counts=False, noise=True) for f in frames[at:end]]
        return frames[:at] + noise + frames[end:]

    def scan(self, scan, figures, moment, rng):
        noise = moment.frame.noise
        return with_ranges(scan, rng.uniform(2.0, 40.0, len(scan.points))) if noise else scan


class RangeNoise(Trouble):
    """Ranges scatter more than the sensor's sheet says, with heavy tails."""

    def draw(self, rng):
        return {"sigma": uniform(rng, 0.02, 0.06)}

    def scan(self, scan, figures, moment, rng):
        far = ranges(scan)
        scatter = np.clip(rng.standard_t(3, len(far)) / np.sqrt(3), -8, 8)
        return with_ranges(scan, np.maximum(far + figures["sigma"] * scatter, 0.1))


class RangeBias(Trouble):
    """All ranges are too long or too short, and each row by some more."""

    def draw(self, rng):
        return {"all": uniform(rng, -0.15, 0.15), "rows": uniform(rng, 0.0, 0.03)}

    def scan(self, scan, figures, moment, rng):
        sigma = figures["rows"]
        rows = np.random.default_rng(7).normal(0.0, sigma, 256)  # the same in every scan
        return with_ranges(scan, np.maximum(ranges(scan) + figures["all"] + rows[scan.rings], 0.1))


class ElevationBias(Trouble):
    """All beams point higher or lower than the sensor says, and each by some more."""

    def draw(self, rng):
        return {"all_deg": uniform(rng, -0.4, 0.4), "rows_deg": uniform(rng, 0.0, 0.08)}

    def scan(self, scan, figures, moment, rng):
        rows = np.random.default_rng(8).normal(0.0, figures["rows_deg"], 256)
        x, y, z = scan.points.T.astype(float)
        flat = np.hypot(x, y)
        up = np.arctan2(z, flat) + np.radians(figures["all_deg"] + rows[scan.rings])
        far = np.hypot(flat, z)
        share = far * np.cos(up) / np.maximum(flat, 1e-6)
        return scan.with_points(np.stack([x * share, y * share, far * np.sin(up)], axis=1))


class MissingRows(Trouble):
    """Lasers that are dead."""

    def draw(self, rng):
        return {"share": uniform(rng, 0.05, 0.3), "seed": int(rng.integers(1000))}

    def scan(self, scan, figures, moment, rng):
        dead = np.random.default_rng(figures["seed"]).random(256) < figures["share"]
        return scan.kept(~dead[scan.rings])


class SparseColumns(Trouble):
    """Only every n-th column arrives, as from a driver that thins."""

    def draw(self, rng):
        return {"every": int(rng.integers(2, 5))}

    def scan(self, scan, figures, moment, rng):
        turn = azimuths(scan) / (2 * np.pi) + 0.5
        column = np.floor(turn * moment.lidar.columns + 0.25).astype(int)
        return scan.kept(column % figures["every"] == 0)


class LimitedView(Trouble):
    """A part of the horizon is covered or cut off."""

    def draw(self, rng):
        return {
            "view_deg": float(rng.choice([120, 180, 240, 300])),
            "heading_deg": float(rng.choice([0, 0, 0, 90, 180])),
        }

    def scan(self, scan, figures, moment, rng):
        turned = azimuths(scan) - np.radians(figures["heading_deg"])
        off = np.abs((turned + np.pi) % (2 * np.pi) - np.pi)
        return scan.kept(off <= np.radians(0.5 * figures["view_deg"]))


class Duplicated(Trouble):
    """A share of the points comes twice."""

    def draw(self, rng):
        return {"share": float(rng.choice([0.1, 0.5, 1.0]))}

    def scan(self, scan, figures, moment, rng):
        return joined(scan, scan.kept(rng.random(len(scan.points)) < figures["share"]))


class NoRings(Trouble):
    """The driver leaves out the numbers of the rings."""

    def scan(self, scan, figures, moment, rng):
        return dataclasses.replace(scan, rings=None)


class ZeroMisses(Trouble):
    """Where nothing was hit there is a point at the origin, or NaN."""

    def draw(self, rng):
        return {"nan": bool(rng.integers(2))}

    def scan(self, scan, figures, moment, rng):
        misses = shell(scan, 1.0, moment, rng)
        return joined(scan, misses.with_points(misses.points * (np.nan if figures["nan"] else 0)))


TROUBLES = {
    "dust": Dust(),
    "rain": Rain(),
    "max-range": MaxRange(),
    "vehicle-body": VehicleBody(),
    "alongside": Alongside(),
    "paused": Paused(),
    "frozen": Frozen(),
    "dropped": Dropped(),
    "gap": Gap(),
    "stamp-jitter": StampJitter(),
    "times-ten-fold": TimesTenFold(),
    "times-reversed": TimesReversed(),
    "times-zero": TimesZero(),
    "times-ignored": TimesIgnored(),
    "noise-scans": NoiseScans(),
    "range-noise": RangeNoise(),
    "range-bias": RangeBias(),
    "elevation-bias": ElevationBias(),
    "missing-rows": MissingRows(),
    "sparse-columns": SparseColumns(),
    "limited-view": LimitedView(),
    "duplicated": Duplicated(),
    "zero-misses": ZeroMisses(),
    "no-rings": NoRings(),
}
