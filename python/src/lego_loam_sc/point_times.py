# SPDX-License-Identifier: BSD-3-Clause
"""The only place that gives the times of points in recordings a meaning.

The rules are those of src/io/point_times.hpp, which does the same for PCD and PLY files.
"""

from dataclasses import dataclass

import numpy as np

from lego_loam_sc.errors import InputError

UNITS_NS = {"s": 1_000_000_000, "ms": 1_000_000, "us": 1_000, "ns": 1}
_UNIT_NAMES = {"s": "seconds", "ms": "milliseconds", "us": "microseconds", "ns": "nanoseconds"}

_SHORTEST_SWEEP_NS, _LONGEST_SWEEP_NS = 20e6, 500e6
_SAME_CLOCK_NS = 1_000_000_000


@dataclass
class PointTimes:
    """Times of the points of one scan."""

    offset_ns: np.ndarray  # int32, after the stamp; 0 where there is no time
    unit: str  # a key of UNITS_NS
    decision: str  # what was decided, one sentence


def interpret(
    times: np.ndarray, returned: np.ndarray, stamp_ns: int, unit: str | None
) -> PointTimes | None:
    """Offsets from the stamp for `times`, numbers in an unknown unit on an unknown clock.

    Only the points that are `returned` count. A sweep lasts between 20 and 500 ms: the unit in
    which the span of the times does decides, unless one is given. Times within one second of zero
    count from the stamp; others are a clock's: the stamp's own when they lie within one second of
    it, else the earliest is taken to be at the stamp. Times that are all the same are no times:
    None. Raises InputError with the numbers seen and the setting to give when no unit fits.
    """
    known = returned & np.isfinite(times) if times.dtype.kind == "f" else returned
    seen = times[known]
    if seen.size == 0:
        return None
    earliest, latest = seen.min(), seen.max()
    if not latest > earliest:
        return None
    unit = _decide_unit(earliest, latest, unit)
    base = int(np.floor(earliest))
    base_ns = base * UNITS_NS[unit]
    limits_ns = _since(base, np.array([earliest, latest]), unit)
    first_ns, last_ns = (base_ns + int(limit) for limit in limits_ns)
    origin_ns, origin = _decide_origin(first_ns, last_ns, stamp_ns)
    offset_ns = _since(base, times, unit) + (base_ns - origin_ns)
    begin_ms, end_ms = (first_ns - origin_ns) / 1e6, (last_ns - origin_ns) / 1e6
    return PointTimes(
        np.where(known, offset_ns, 0).astype(np.int32),
        unit,
        f"{_UNIT_NAMES[unit]} {origin}; "
        f"a sweep runs from {begin_ms:.1f} to {end_ms:.1f} ms after it",
    )


def _since(base: int, times: np.ndarray, unit: str) -> np.ndarray:
    """Nanoseconds of `times` after the whole number `base` in the same unit.

    The difference comes before the scale: it keeps the accuracy of the recording.
    """
    if times.dtype.kind == "f":
        with np.errstate(invalid="ignore", over="ignore"):  # of points without a return
            ns = np.rint((times.astype(np.float64) - base) * UNITS_NS[unit])
            return ns.astype(np.int64)
    return (times - times.dtype.type(base)).astype(np.int64) * UNITS_NS[unit]


def _decide_unit(earliest: np.number, latest: np.number, given: str | None) -> str:
    span = float(latest) - float(earliest)
    if given:
        if span * UNITS_NS[given] > _SAME_CLOCK_NS:  # more than offsets can hold
            _fail(earliest, latest)
        return given
    if not _is_too_coarse(earliest, latest):
        for unit, unit_ns in UNITS_NS.items():
            if _SHORTEST_SWEEP_NS <= span * unit_ns <= _LONGEST_SWEEP_NS:
                return unit
    _fail(earliest, latest)


def _is_too_coarse(earliest: np.number, latest: np.number) -> bool:
    """Seconds of a clock in float32 are 128 s apart, which would pass for milliseconds."""
    largest = max(abs(float(earliest)), abs(float(latest)))
    span = float(latest) - float(earliest)
    return earliest.dtype == np.float32 and largest * np.finfo(np.float32).eps > 0.01 * span


def _fail(earliest: np.number, latest: np.number) -> None:
    coarse = " (float32 is too coarse for them)" if _is_too_coarse(earliest, latest) else ""
    raise InputError(
        f"the point times run from {earliest} to {latest}, which is not a sweep of 20 to "
        f"500 ms in any unit{coarse}; set point_times to s, ms, us, ns or none in dataset.yaml "
        "beside the recording"
    )


def _decide_origin(first_ns: int, last_ns: int, stamp_ns: int) -> tuple[int, str]:
    """What the times count from, ns in their own clock, and in words."""
    if max(abs(first_ns), abs(last_ns)) <= _SAME_CLOCK_NS:
        return 0, "relative to the stamp of the scan"
    if abs(first_ns - stamp_ns) <= _SAME_CLOCK_NS:
        return stamp_ns, "on the clock of the stamp"
    return first_ns, "on another clock than the stamp, the earliest is assumed to be at the stamp"
