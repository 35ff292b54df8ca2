# SPDX-License-Identifier: BSD-3-Clause
"""The runs in the work folder and what they come to, worked out when it is first asked for."""

import csv
import json
import re
from functools import cached_property

import evo_tool
import loops
import numpy as np
import runs

import program
import trajectory


class Run:
    """One run of one method against the truth."""

    def __init__(self, folder, world):
        self.folder = folder
        self.world = world

    @cached_property
    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    @cached_property
    def scans(self):
        """The rows of scans.csv, one dictionary of texts for each scan."""
        with (self.folder / "scans.csv").open() as file:
            return list(csv.DictReader(file))

    @cached_property
    def trajectory(self):
        return trajectory.read_tum(self.folder / "trajectory.tum")

    @cached_property
    def odometry(self):
        return trajectory.read_tum(self.folder / "odometry.tum")

    @cached_property
    def evaluation(self):
        """Of the final trajectory, by `lego-loam-sc evaluate`."""
        return program.evaluate(self.world.truth_path, self.folder / "trajectory.tum")

    @cached_property
    def odometry_evaluation(self):
        return program.evaluate(self.world.truth_path, self.folder / "odometry.tum")

    @cached_property
    def ate(self):
        return evo_tool.absolute_error(self.world.truth_path, self.folder / "trajectory.tum")

    @cached_property
    def rpe(self):
        return evo_tool.relative_error(self.world.truth_path, self.folder / "trajectory.tum")

    @cached_property
    def length(self):
        return evo_tool.path_length(self.folder / "trajectory.tum")

    @property
    def length_deviation(self):
        return self.length - self.world.length

    @property
    def cpu_seconds(self):
        return self.summary["timing"]["cpu_seconds"]

    @property
    def cpu_share(self):
        """CPU seconds over the duration of the recording."""
        return self.cpu_seconds / self.world.truth.duration

    @cached_property
    def end(self):
        return trajectory.end_error(*trajectory.paired(self.world.truth, self.trajectory))

    @cached_property
    def accepted_loops(self):
        return loops.read_accepted(self.folder / "loops.csv")

    @cached_property
    def loop_score(self):
        truth = self.world.truth
        stamps = self.stamps_of_scans
        # Key frames and loops belong to the middle of a sweep, poses in files to its beginning.
        poses = truth.at(stamps + self.reference_delay)
        path = np.interp(stamps, truth.stamps, truth.path)
        key_scans = np.array([int(row["scan"]) for row in self.scans if int(row["key_frame"]) >= 0])
        return loops.score(self.accepted_loops, key_scans, poses, stamps, path)

    @cached_property
    def stamps_of_scans(self):
        return np.array([float(row["stamp"]) for row in self.scans])

    @property
    def reference_delay(self):
        """Seconds from the stamp of a scan to the time that its points were moved to."""
        sensor = (self.folder / "sensor.yaml").read_text()
        if "motion_compensated: true" in sensor:
            return 0.0
        return 0.5 * float(re.search(r"^period: ([0-9.]+)", sensor, re.MULTILINE)[1])


class World:
    """The finished runs of one experiment: `runs` by method, none of them when it has not run."""

    def __init__(self, experiment, folder):
        self.name = experiment.name
        self.folder = folder
        self.truth_path = folder / "truth.tum"
        methods = experiment.methods if runs.finished(folder) else ()
        self.runs = {method: Run(folder / method, self) for method in methods}

    @property
    def made_with(self):
        return runs.read_record(self.folder)

    @cached_property
    def truth(self):
        return trajectory.read_tum(self.truth_path)

    @cached_property
    def length(self):
        return evo_tool.path_length(self.truth_path)

    @property
    def scan_folder(self):
        return self.folder / "scans"
