# SPDX-License-Identifier: BSD-3-Clause
"""Run with: build/peers/venv/bin/python -m unittest discover bench/peers -p '*_test.py'"""

import math
import pathlib
import tempfile
import unittest

import goals
import inputs
import stages
import tables
from results import Compared, Result


class MadeStore:
    """Runs with these ATEs (m, None = no run) and CPU times (ms), ours first."""

    def __init__(self, ate, cpu):
        names = ("lego-loam-sc", "kiss-icp", "genz-icp")
        self.records = {
            name: {
                "scans": 100,
                "cpu_seconds": 0.1 * c + 2.0,
                "start_cpu_seconds": 2.0,
                "peak_mib": 100.0,
                "wall_seconds": 1.0,
                "others": 0.0,
                "errors": {"ate_m": {"rmse": a}} if a else None,
            }
            for name, a, c in zip(names, ate, cpu, strict=True)
        }

    def record(self, recording, system, threads):
        return self.records.get(system) if threads == 1 else None


def compared(ate, cpu):
    return Compared(MadeStore(ate, cpu), inputs.inputs()["mine"])


class Ratios(unittest.TestCase):
    def test_start_of_the_process_is_left_out_and_a_better_peer_is_bold(self):
        one = compared(ate=(0.2, 0.5, 0.1), cpu=(5.0, 35.0, 100.0))
        self.assertAlmostEqual(one.peers["kiss-icp"].cpu_ms, 35.0)
        rows = tables.ratios([one], lambda result: result.ate).splitlines()
        self.assertEqual(rows[2], "| `mine` | 2.50 |  | **0.50** |  |")

    def test_an_input_without_truth_has_no_row(self):
        one = compared(ate=(None, None, None), cpu=(5.0, 35.0, 100.0))
        self.assertTrue(math.isnan(one.ours.ate))
        self.assertEqual(len(tables.ratios([one], lambda result: result.ate).splitlines()), 2)


class Goals(unittest.TestCase):
    def words(self, ate, cpu):
        rows = goals.goals_table([compared(ate, cpu)]).splitlines()[2:]
        return [row.split("|")[-2].strip() for row in rows]

    def test_limits_are_met_passed_or_missed(self):
        self.assertEqual(
            self.words(ate=(0.2, 0.5, 0.3), cpu=(5.0, 35.0, 100.0)),
            ["must reached", "goal reached", "must reached"],
        )
        self.assertEqual(
            self.words(ate=(0.4, 0.5, 0.3), cpu=(9.0, 20.0, 100.0)), ["**missed**"] * 3
        )


class Stages(unittest.TestCase):
    def test_are_means_and_the_slowest_but_one_in_a_thousand(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scans.csv"
            header = ",".join(f"{stage}_ms" for stage in stages.STAGES)
            rows = [f"1,1,1,1,1,{i}" for i in range(2000)]
            path.write_text("\n".join(["delay_ms," + header, *(f"9,{row}" for row in rows)]))
            run = Result({"stages": stages.of_run(path)})
        self.assertEqual(run.stages["mapping"], 1.0)
        self.assertEqual(run.stages["loops"], 999.5)
        self.assertEqual(run.slow_ms, 5 + 1998)

    def test_of_older_runs_are_not_known(self):
        self.assertEqual(Result({}).stages, {})
        self.assertTrue(math.isnan(Result({}).slow_ms))


if __name__ == "__main__":
    unittest.main()
