# SPDX-License-Identifier: BSD-3-Clause
"""Where the time of a run of ours goes, from its scans.csv."""

import csv

import numpy as np

STAGES = ("projection", "segmentation", "features", "odometry", "mapping", "loops")


def of_run(scans_csv):
    """Mean milliseconds of each stage, and what 99.9 % of the scans stay below, all stages."""
    with scans_csv.open(newline="") as file:
        rows = list(csv.DictReader(file))
    times = np.array([[float(row[f"{stage}_ms"]) for stage in STAGES] for row in rows])
    return {
        "mean_ms": dict(zip(STAGES, times.mean(axis=0).tolist(), strict=True)),
        "slow_ms": float(np.quantile(times.sum(axis=1), 0.999, method="higher")),
    }
