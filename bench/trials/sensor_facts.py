# SPDX-License-Identifier: BSD-3-Clause
"""What `lego-loam-sc config --sensor` says of a sensor."""

import functools
import re

from troubles import Lidar

import program


@functools.cache
def text(sensor):
    """The sensor file that --sensor takes."""
    printed = program.call("config", "--sensor", sensor)
    return printed[printed.index("# sensor") :]


def value(sensor, key):
    return float(re.search(rf"^{key}: *([-+.\de]+)", text(sensor), re.MULTILINE).group(1))


def lidar(sensor):
    columns, max_range, period = (value(sensor, k) for k in ("columns", "max_range", "period"))
    return Lidar(int(columns), max_range, period)


def beams(sensor):
    return text(sensor).split("]")[0].count(",") + 1


def is_compensated(sensor):
    return bool(re.search(r"^motion_compensated: *true", text(sensor), re.MULTILINE))


def tilted(sensor, roll_deg, pitch_deg):
    """The file of the same sensor, mounted at an angle."""
    file = re.sub(r"(?m)^mount_roll_deg:.*$", f"mount_roll_deg: {roll_deg}", text(sensor))
    return re.sub(r"(?m)^mount_pitch_deg:.*$", f"mount_pitch_deg: {pitch_deg}", file)
