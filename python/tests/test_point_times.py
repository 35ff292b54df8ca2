# SPDX-License-Identifier: BSD-3-Clause
"""The meaning of the times of points; the same cases as for PCD and PLY files."""

import re
from pathlib import Path

import numpy as np
import pytest

from lego_loam_sc.errors import InputError
from lego_loam_sc.point_times import interpret

STAMP = 1_600_000_000_000_000_000


def offsets(times, stamp_ns=STAMP, unit=None, dtype=np.float64):
    array = np.array(times, dtype)
    times = interpret(array, np.ones(array.shape, bool), stamp_ns, unit)
    return None if times is None else times.offset_ns.tolist()


def shared_cases():
    """Those that the reader of PCD and PLY files is tested with too."""
    file = Path(__file__).parents[2] / "tests/point_times_cases.txt"
    for line in file.read_text().splitlines():
        if not line.startswith("#"):
            yield re.split("  +", line.strip())


@pytest.mark.parametrize(("dtype", "stamp_ns", "unit", "times", "expected"), list(shared_cases()))
def test_the_rules_are_those_of_point_files(dtype, stamp_ns, unit, times, expected):
    # A whole number beyond 2^53 must not pass through a float.
    numbers = [float(word) if dtype.startswith("f") else int(word) for word in times.split()]

    def found():
        return offsets(numbers, int(stamp_ns), None if unit == "-" else unit, dtype)

    if expected == "refused":
        with pytest.raises(InputError):
            found()
    elif expected == "none":
        assert found() is None
    else:
        np.testing.assert_allclose(found(), [int(word) for word in expected.split()], atol=256)


@pytest.mark.parametrize(
    ("scale", "dtype"),
    [
        (1, np.float64),
        (1, np.float32),
        (1e3, np.float64),
        (1e3, np.uint16),
        (1e6, np.float32),
        (1e6, np.uint32),
        (1e9, np.float64),
        (1e9, np.uint32),
    ],
)
def test_the_span_decides_the_unit(scale, dtype):
    times = np.array([0, 0.05, 0.1]) * scale
    np.testing.assert_allclose(offsets(times, dtype=dtype), [0, 50e6, 100e6], atol=2)


def test_relative_times_may_lie_before_the_stamp():
    assert offsets([-0.1, 0]) == [-100_000_000, 0]


@pytest.mark.parametrize(
    ("times", "dtype", "tolerance"),
    [
        ([STAMP - 50_000_000, STAMP + 50_000_000], np.uint64, 0),
        ([STAMP // 1000 - 50_000, STAMP // 1000 + 50_000], np.int64, 0),
        ([STAMP * 1e-9 - 0.05, STAMP * 1e-9 + 0.05], np.float64, 240),  # resolution of a double
    ],
)
def test_times_on_the_clock_of_the_stamp_count_from_it(times, dtype, tolerance):
    np.testing.assert_allclose(offsets(times, dtype=dtype), [-50e6, 50e6], atol=tolerance)


def test_times_on_another_clock_count_from_the_first():
    np.testing.assert_allclose(offsets([1234.6, 1234.5], stamp_ns=7), [100e6, 0], atol=1)
    boot = 5_000_000_000_000
    assert offsets([boot + 90_000_000, boot], dtype=np.uint64) == [90_000_000, 0]


def test_equal_or_missing_times_are_none():
    assert offsets([]) is None
    assert offsets([0, 0, 0]) is None
    assert offsets([np.nan, 5.0]) is None


def test_points_without_a_return_do_not_count():
    assert offsets([np.nan, 0.02, 0.1]) == [0, 20_000_000, 100_000_000]
    times = np.array([4e9, 0, 1e8]).astype(np.uint32)
    result = interpret(times, np.array([False, True, True]), STAMP, None)
    assert result.offset_ns.tolist() == [0, 0, 100_000_000]


def test_stray_times_cost_their_points_only():
    times = 1.6e9 + 1e-4 * np.arange(1000)
    times[5], times[700] = 0, 1.7e9
    result = interpret(times, np.ones(1000, bool), STAMP, None)
    assert np.flatnonzero(result.stray).tolist() == [5, 700]
    assert result.unit == "s"
    assert abs(int(result.offset_ns[999]) - 99_900_000) < 256
    times[::10] = 0
    with pytest.raises(InputError):
        interpret(times, np.ones(1000, bool), STAMP, None)


def test_times_that_fit_no_unit_are_refused_with_the_numbers_and_the_setting():
    with pytest.raises(InputError, match="run from 0.0 to 5.0.*set point_times to s, ms, us, ns"):
        offsets([0, 5])
    with pytest.raises(InputError, match="float32 is too coarse"):
        offsets([1.6e9, 1.6e9 + 128], dtype=np.float32)


def test_the_unit_can_be_given_within_reason():
    assert offsets([0, 5], unit="ms") == [0, 5_000_000]
    with pytest.raises(InputError):
        offsets([0, 5], unit="s")


def test_the_decision_says_where_the_stamp_lies_in_the_sweep():
    def decision(times):
        array = np.array(times, np.float64)
        return interpret(array, np.ones(array.shape, bool), STAMP, None).decision

    assert decision([0, 1e5]) == (
        "microseconds relative to the stamp of the scan; a sweep runs from 0.0 to 100.0 ms after it"
    )
    assert decision([-0.1, 0]).endswith("a sweep runs from -100.0 to 0.0 ms after it")
    assert "on the clock of the stamp" in decision([1.6e9 - 0.1, 1.6e9])


def test_no_numbers_overflow():
    huge = np.finfo(np.float64).max
    for unit in (None, "ns"):
        with pytest.raises(InputError):
            offsets([-huge, huge], unit=unit)
    with pytest.raises(InputError):
        offsets([0, 2**64 - 1], dtype=np.uint64)
    late = 10**18
    assert offsets([late, late + 128], unit="ms", stamp_ns=0, dtype=np.int64) == [0, 128_000_000]
