# SPDX-License-Identifier: BSD-3-Clause
"""What is run: the recordings, made or real, and the methods on each of them."""

import dataclasses
import pathlib

OURS = "lego-loam-sc"
METHODS = ("loam", "lego-loam", "lego-loam-sc-paper", OURS)


@dataclasses.dataclass(frozen=True)
class Experiment:
    """One recording and the methods that run on it.

    `simulate` are the arguments of `lego-loam-sc simulate`. A streamed world is never on the disk:
    its scans go from the simulator to all methods at once. `recording` is a real KITTI sequence,
    used instead of a made world.
    """

    name: str
    methods: tuple[str, ...]
    simulate: tuple[str, ...] = ()
    streamed: bool = False
    recording: pathlib.Path | None = None


def experiments(kitti=None, route=None):
    """All experiments by name; `kitti` is a sequence folder, `route` a KITTI pose file, or None."""
    city = ("kitti00", "--traffic", "on", "--wear", "on")
    if route:
        city += ("--route", str(route))
    if kitti:
        kitti00 = Experiment("kitti00", METHODS, recording=kitti)
    else:
        kitti00 = Experiment("kitti00", METHODS, city, streamed=True)
    all_experiments = (
        kitti00,
        Experiment("parking1", METHODS, ("parking1",)),
        Experiment("parking2", METHODS, ("parking2",)),
        Experiment("mine", (OURS,), ("mine",)),
        Experiment("tunnel", (OURS,), ("tunnel",)),
        Experiment("field", (OURS,), ("field",)),
    )
    return {experiment.name: experiment for experiment in all_experiments}
