# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the runs in the store, by input, system and number of threads."""

import math
from functools import cached_property

from systems import OURS, PEERS, SYSTEMS


class Result:
    """One run. Errors are NaN when the recording has no truth or is too short for them."""

    def __init__(self, record):
        self.record = record

    @property
    def scans(self):
        return self.record["scans"]

    @property
    def cpu_ms(self):
        """Per scan, without what the process needed before the first one."""
        seconds = self.record["cpu_seconds"] - self.record["start_cpu_seconds"]
        return 1000.0 * seconds / self.scans

    @property
    def wall_ms(self):
        return 1000.0 * self.record["wall_seconds"] / self.scans

    @property
    def peak_mib(self):
        return self.record["peak_mib"]

    @property
    def others(self):
        """Share of the machine's CPU time that other processes had during the run, percent."""
        return 100.0 * self.record["others"]

    @property
    def stages(self):
        """Mean milliseconds of each stage of ours, empty when they were not kept."""
        return self.record.get("stages", {}).get("mean_ms", {})

    @property
    def slow_ms(self):
        """What all stages of 99.9 % of our scans stay below."""
        return self.record.get("stages", {}).get("slow_ms", math.nan)

    def error(self, *keys):
        value = self.record["errors"]
        for key in keys:
            value = value[key] if value else None
        return math.nan if value is None else value

    @property
    def ate(self):
        return self.error("ate_m", "rmse")

    @property
    def ate_max(self):
        return self.error("ate_m", "max")

    @property
    def rpe(self):
        return self.error("rpe_frame", "translation_m", "rmse")

    @property
    def t_rel(self):
        return self.error("kitti", "t_rel_percent")


class Compared:
    """All results on one input: `runs[threads][system]`, those that are there."""

    def __init__(self, store, recording):
        self.recording = recording
        self.name = recording.name
        self.runs = {}
        for threads in (1, 2):
            records = {name: store.record(recording, name, threads) for name in SYSTEMS}
            self.runs[threads] = {name: Result(r) for name, r in records.items() if r}

    @cached_property
    def main(self):
        """The runs that CPU time and errors are taken of: those with one thread."""
        return self.runs[1]

    @property
    def ours(self):
        return self.main.get(OURS)

    @property
    def peers(self):
        return {name: self.main[name] for name in PEERS if name in self.main}

    def best_peer(self, value):
        """Name and value of the peer with the least `value` of its result; None without any."""
        values = {name: value(result) for name, result in self.peers.items()}
        known = [(v, name) for name, v in values.items() if not math.isnan(v)]
        return min(known)[::-1] if known else None
