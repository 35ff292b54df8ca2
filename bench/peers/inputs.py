# SPDX-License-Identifier: BSD-3-Clause
"""The recordings, made or real, that all systems run on."""

import dataclasses
import pathlib


@dataclasses.dataclass(frozen=True)
class Input:
    """One recording.

    `simulate` are the arguments of `lego-loam-sc simulate`, for a made world; `recording` is the
    folder of a real KITTI sequence. `sensor` and `surroundings` choose the settings of the peers.
    """

    name: str
    sensor: str  # rs16, hdl64e or kitti, whose scans are compensated already
    surroundings: str  # indoor or outdoor
    simulate: tuple[str, ...] = ()
    recording: pathlib.Path | None = None

    @property
    def is_compensated(self):
        return self.sensor == "kitti"

    @property
    def is_at_hand(self):
        return bool(self.simulate or self.recording)

    @property
    def rings(self):
        return 16 if self.sensor == "rs16" else 64


def inputs(data=None, route=None):
    """All inputs by name; `data` is the folder of the real sequences, `route` a KITTI pose file."""
    city = ("kitti00", *(("--route", str(route)) if route else ()))
    all_inputs = [
        Input("parking1", "rs16", "indoor", ("parking1",)),
        Input("parking2", "rs16", "indoor", ("parking2",)),
        Input("mine", "rs16", "indoor", ("mine",)),
        Input("tunnel", "rs16", "indoor", ("tunnel",)),
        Input("field", "rs16", "outdoor", ("field",)),
        Input("street", "hdl64e", "outdoor", ("street",)),
        Input("kitti00", "hdl64e", "outdoor", city),
        Input("kitti00-quiet", "hdl64e", "outdoor", (*city, "--traffic", "off", "--count", "1000")),
    ]
    for name in ("kitti_odometry_04", "kitti_raw_0005"):
        folder = data / name if data and (data / name / "velodyne").is_dir() else None
        all_inputs.append(Input(name, "kitti", "outdoor", recording=folder))
    return {one.name: one for one in all_inputs}
