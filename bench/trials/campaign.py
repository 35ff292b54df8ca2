# SPDX-License-Identifier: BSD-3-Clause
"""The drives of the campaign: all of them follow from one seed.

Drives share simulations: drive number k is a part of simulation k modulo SIMULATIONS, so that the
first drives already see every kind of world and sensor.
"""

import dataclasses
import pathlib

import numpy as np
from troubles import TROUBLES, Frame

SIMULATIONS = 40
SENSOR_FILES = pathlib.Path(__file__).resolve().parent / "sensors"
PRESETS = (
    *("vlp16", "vlp32c", "hdl32e", "hdl64e", "kitti", "vls128", "rs16", "helios16p", "rs32"),
    *("ruby", "os0-32", "os0-64", "os0-128", "os1-32", "os1-64", "os1-128", "os1-64-gen1"),
    *("xt16", "xt32", "pandar40p", "pandar64"),
)
LENGTHS = (60, 150)  # scans of a drive
SCANS = ((40_000, 320), (80_000, 240), (1_000_000, 160))  # rays of a scan up to, its scans
TILT_EVERY = 10  # simulations
TIMES = ("times-ten-fold", "times-reversed", "times-zero", "times-ignored")
EXCLUSIVE = (TIMES, ("max-range", "zero-misses"))
# Drawn twice as often as the others: what is known to mislead.
OFTEN = (
    *("dust", "max-range", "vehicle-body", "alongside", "times-ten-fold", "times-reversed"),
    *("elevation-bias", "sparse-columns", "limited-view"),
)
WITHOUT_TIMES = ("kitti",)  # its scans are compensated


@dataclasses.dataclass(frozen=True)
class Road:
    """A winding road for `simulate city --route`: a sine of the heading along the way."""

    speed: float  # m/s, the highest
    bend: float  # m along the way for a radian of the sine
    swing: float  # rad, the largest change of heading

    def poses(self, seconds):
        """Rows of a TUM file, ten a second: from rest to the speed, then up and down by a third."""
        t = np.arange(0.0, seconds, 0.1)
        ramp = np.minimum(2.5 * t, self.speed)
        speed = ramp * (1 - 0.17 * (1 - np.cos(0.25 * t)))
        way = np.concatenate([[0.0], np.cumsum(0.1 * speed[:-1])])
        heading = self.swing * np.sin(way / self.bend)
        zero = np.zeros_like(t)
        x, y = (
            np.concatenate([[0.0], np.cumsum(0.1 * (speed * f(heading))[:-1])])
            for f in (np.cos, np.sin)
        )
        columns = [t, x, y, zero, zero, zero, np.sin(heading / 2), np.cos(heading / 2)]
        return np.stack(columns, axis=1)


WORLDS = {
    "kitti00": None,
    "parking": None,
    "mine": None,
    "street": None,
    "road-6": Road(6.0, 25.0, 1.2),
    "field": None,
    "parking2": None,
    "road-15": Road(15.0, 60.0, 0.6),
    "tunnel": None,
    "parking1": None,
    "road-27": Road(27.0, 180.0, 0.25),
}


@dataclasses.dataclass(frozen=True)
class Simulation:
    """One call of `lego-loam-sc simulate`."""

    number: int
    world: str  # of WORLDS
    sensor: str  # a preset or a file of sensors/
    seed: int
    roll_deg: float  # of the mounting, which the run is not told
    pitch_deg: float

    @property
    def name(self):
        return f"{self.world}-{self.sensor}"

    @property
    def is_tilted(self):
        return bool(self.roll_deg or self.pitch_deg)

    def scans(self, rays):
        """How many scans the whole simulation of a sensor with so many rays a turn would have."""
        return next(scans for most, scans in SCANS if rays <= most)

    @property
    def sensor_argument(self):
        """What --sensor takes."""
        file = SENSOR_FILES / f"{self.sensor}.yaml"
        return str(file) if file.is_file() else self.sensor


@dataclasses.dataclass(frozen=True)
class Drive:
    """A part of a simulation with its troubles: their names and figures."""

    number: int
    simulation: Simulation
    start: float  # share of what could be left out before the first scan; 0 = at rest
    length: int  # scans, before any are dropped
    every: int  # only each n-th scan
    troubles: tuple[tuple[str, dict], ...]
    seed: int

    @property
    def trouble_names(self):
        tilt = ("tilted",) if self.simulation.is_tilted else ()
        return (*tilt, *(name for name, _ in self.troubles))

    @property
    def name(self):
        words = [f"{self.number:03d}", self.simulation.name, *self.trouble_names]
        return "-".join(words)

    @property
    def deskew(self):
        return all(TROUBLES[name].deskew for name, _ in self.troubles)

    def random(self, *more):
        return np.random.default_rng([self.seed, self.number, *more])

    def sources(self, count):
        """The scans of a simulation of `count` that are used, as indices."""
        spare = count - self.length * self.every
        first = int(self.start * max(spare, 0))
        return range(first, count, self.every)[: self.length]

    def frames(self, count, stamps_ns):
        """The scans to write; `stamps_ns` are those of the simulation, as far as it went."""
        frames = [Frame(k, int(stamps_ns[k])) for k in self.sources(count)]
        for number, (name, figures) in enumerate(self.troubles):
            frames = TROUBLES[name].frames(frames, figures, self.random(1, number))
        return frames

    def facts(self, facts):
        for name, _ in self.troubles:
            facts = TROUBLES[name].facts(facts)
        return facts

    def changed(self, scan, moment):
        """A scan with what the troubles do to it: the same source gives the same bytes."""
        for number, (name, figures) in enumerate(self.troubles):
            rng = self.random(2, number, moment.frame.source)
            scan = TROUBLES[name].scan(scan, figures, moment, rng)
        return scan


def simulations(seed):
    rng = np.random.default_rng([seed, 0])
    files = sorted(file.stem for file in SENSOR_FILES.glob("*.yaml"))
    sensors = rng.permutation([*PRESETS, *files]).tolist()
    worlds = list(WORLDS)
    made = []
    for number in range(SIMULATIONS):
        tilt = (0.0, 0.0)
        if number % TILT_EVERY == TILT_EVERY - 1:
            roll, pitch = rng.uniform(-8, 8), rng.choice([-1, 1]) * rng.uniform(6, 20)
            tilt = (round(float(roll), 1), round(float(pitch), 1))
        sensor = sensors[number % len(sensors)]
        made.append(Simulation(number, worlds[number % len(worlds)], sensor, seed + number, *tilt))
    return made


def drives(seed, count):
    made = simulations(seed)
    return [drive(seed, number, made[number % SIMULATIONS]) for number in range(count)]


def drive(seed, number, simulation):
    rng = np.random.default_rng([seed, 1, number])
    start = 0.0 if rng.random() < 0.35 else float(rng.uniform(0.1, 1.0))
    length = int(rng.integers(LENGTHS[0], LENGTHS[1] + 1))
    every = 1 if rng.random() < 0.7 else 2
    wanted = int(rng.choice([0, 1, 2], p=[0.25, 0.5, 0.25]))
    if simulation.is_tilted:
        wanted = min(wanted, 1)
    names = drawn(wanted, TIMES if simulation.sensor in WITHOUT_TIMES else (), rng)
    troubles = tuple((name, TROUBLES[name].draw(rng)) for name in names)
    return Drive(number, simulation, round(start, 3), length, every, troubles, seed)


def drawn(wanted, never, rng):
    """So many names of troubles in the order of TROUBLES, of each kind of EXCLUSIVE one at most."""
    weights = np.array([2.0 if name in OFTEN else 1.0 for name in TROUBLES])
    order = rng.choice(list(TROUBLES), len(TROUBLES), replace=False, p=weights / weights.sum())
    names = []
    for name in order.tolist():
        taken = any(name in kind and set(kind) & set(names) for kind in EXCLUSIVE)
        if name not in never and not taken:
            names.append(name)
    return sorted(names[:wanted], key=list(TROUBLES).index)
