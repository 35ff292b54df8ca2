# SPDX-License-Identifier: BSD-3-Clause
"""evo, run as a command; it is under the GPL, so it is never imported."""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

BIN = pathlib.Path(sys.prefix) / "bin"


class EvoError(Exception):
    """What evo printed when it gave up."""


def run(name, *arguments):
    # evo keeps settings in the home folder; those of the user must not decide anything here.
    environment = {**os.environ, "HOME": sys.prefix}
    command = [str(argument) for argument in (BIN / name, *arguments)]
    result = subprocess.run(command, text=True, capture_output=True, env=environment)
    if result.returncode != 0:
        raise EvoError(f"{' '.join(command)}: {(result.stderr or result.stdout).strip()}")
    return result.stdout


def statistics(name, *arguments):
    """rmse, mean, median, std, min, max and sse, unrounded, as evo saves them."""
    with tempfile.TemporaryDirectory() as folder:
        results = pathlib.Path(folder) / "results.zip"
        run(name, *arguments, "--no_warnings", "--save_results", results)
        with zipfile.ZipFile(results) as archive:
            return json.loads(archive.read("stats.json"))


def absolute_error(truth, estimate):
    """ATE, m, after SE(3) alignment; NaN for a straight path, which evo does not align."""
    try:
        return statistics("evo_ape", "tum", truth, estimate, "--align")
    except EvoError as error:
        if "alignment is not possible" not in str(error):
            raise
        return dict.fromkeys(("rmse", "max", "min"), math.nan)


def relative_error(truth, estimate):
    """RPE, m, from each scan to the next."""
    return statistics("evo_rpe", "tum", truth, estimate, "--delta", 1, "--delta_unit", "f")


def path_length(path):
    """m, to the millimetre, which is what evo prints."""
    return float(re.search(r"([0-9.]+)m path length", run("evo_traj", "tum", path))[1])
