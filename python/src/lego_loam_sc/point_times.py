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
_SAMPLES = 1000  # times that the bulk of a scan is told by, about
_STRAY_SHARE = 0.05  # at most, at either end and in all


@dataclass
class PointTimes:
    """Times of the points of one scan."""

    offset_ns: np.ndarray  # int32, after the stamp; 0 where there is no time
    stray: np.ndarray  # bool, points whose times are far outside of the sweep
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
    None. Unsigned times that run through zero are taken for the negative ones that they stand for.
    Up to 5 % of the times may be stray: they decide nothing, and their points have to be left out.
    Raises InputError with the numbers seen and the setting to give when no unit fits.
    """
    known = returned & np.isfinite(times) if times.dtype.kind == "f" else returned
    seen = times[known]
    if seen.size == 0:
        return None
    if not seen.max() > seen.min():
        return None
    times, seen = _without_wraps(times, seen), _without_wraps(seen, seen)
    stray = known & _strays(times, seen)
    known = known & ~stray
    seen = times[known]
    earliest, latest = seen.min(), seen.max()
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
        stray,
        unit,
        f"{_UNIT_NAMES[unit]} {origin}; "
        f"a sweep runs from {begin_ms:.1f} to {end_ms:.1f} ms after it",
    )


def _without_wraps(times: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """The times before zero that a field without a sign holds in the upper half of its numbers.

    No sweep spans half of 32 bits in any unit.
    """
    if times.dtype.kind != "u" or times.dtype.itemsize < 4:
        return times
    half = 1 << (8 * times.dtype.itemsize - 1)
    if int(seen.max()) - int(seen.min()) <= half:
        return times
    return times.view(np.dtype(f"{times.dtype.byteorder}i{times.dtype.itemsize}"))


def _strays(times: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Which times are too far from most of those `seen` to belong to their sweep."""
    samples = np.sort(seen[:: 1 + seen.size // _SAMPLES]).astype(np.float64)
    skipped = int(_STRAY_SHARE * samples.size)
    first, last = samples[skipped], samples[-1 - skipped]
    with np.errstate(invalid="ignore", over="ignore"):
        span = last - first
        far = np.abs(times.astype(np.float64) - (first + last) / 2) > 1.5 * span
        few = np.count_nonzero(np.abs(seen.astype(np.float64) - (first + last) / 2) > 1.5 * span)
    if span <= 0 or few > _STRAY_SHARE * seen.size:  # the sweep is an odd one
        return np.zeros(times.shape, bool)
    return far


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
