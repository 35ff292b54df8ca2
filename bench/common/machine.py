# SPDX-License-Identifier: BSD-3-Clause
"""The machine that the figures are of."""

import os
import pathlib
import platform


def processor():
    model = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
    return f"{model} with {os.cpu_count()} cores"
