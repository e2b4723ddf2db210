"""Where columns' exposures start and end among the chips, compared with rational arithmetic."""

import math
from fractions import Fraction

import pytest
from each_case import each_case
from hypothesis import strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import (
    PATTERNS,
    STARTS,
    ExactTimes,
    decades,
    some_columns,
    within,
)
from occ_model.camera.exposure import column_phases
from occ_model.scene.scene import Scene

CHIPS = decades(1e-3, 1e6)  # exposures in chips

FREQUENCIES = st.one_of(decades(1.0, 1e9), st.integers(0, 29).map(lambda power: 2.0**power))
READOUTS = decades(1e-9, 10.0)

COINCIDENCE = "t_on where edges coincide, of t"
WIDE = "t 1e-3 to 1e6 chips, f 1 Hz to 1 GHz, t_0 to 1e9 s"


def scene_of_exposure(chips: float, frequency: float, **changes: float | str) -> Scene:
    """Make a scene whose exposure lasts about some chips, as far as allowed."""
    exposure = within("exposure_time", chips / frequency)
    return Scene().replace(
        switching_frequency=frequency, exposure_time=exposure, columns=300,
    ).replace(**changes)  # fmt: skip


def error_of(scene: Scene) -> float:
    """Return the largest error of a column's t_on against exact arithmetic, relative to t.

    It is relative to a thousandth of a chip if t is shorter, since the start of a column is known
    to 2e-16 chips for any t.
    """
    exact, on_time = ExactTimes(scene), occ.on_time(scene)
    t = Fraction(scene.camera.exposure_time)
    scale = max(t, Fraction(1, 1000) / exact.frequency)
    return max(
        float(abs(Fraction(float(on_time[column])) - exact.fraction(column) * t) / scale)
        for column in some_columns(scene)
    )


@cases(chips=CHIPS, frequency=FREQUENCIES, readout=READOUTS, start=STARTS, pattern=PATTERNS)
def test_on_time_is_that_of_rational_arithmetic(
    chips: float, frequency: float, readout: float, start: float, pattern: str
) -> None:
    scene = scene_of_exposure(
        chips, frequency, readout_time=readout, start_time=start, pattern=pattern
    )
    error = error_of(scene)
    record("t_on, of t", WIDE, error, 1e-12)


@cases(
    whole=st.integers(1, 10**6),
    unit=st.sampled_from([1, 24]),
    ulps=st.integers(-1, 1),
    frequency=FREQUENCIES,
    start=STARTS,
)
def test_on_time_of_whole_chips_or_packets_is_exact_an_ulp_either_side(
    whole: int, unit: int, ulps: int, frequency: float, start: float
) -> None:
    scene = scene_of_exposure(whole * unit, frequency, start_time=start)
    exposure = scene.camera.exposure_time
    beside = exposure if ulps == 0 else math.nextafter(exposure, ulps * math.inf)
    error = error_of(scene.replace(exposure_time=within("exposure_time", beside)))
    record(COINCIDENCE, "t of whole chips, packets at a column's start, +- 1 ulp", error, 1e-14)


@cases(
    seconds=decades(1e-9, 10.0), chips=CHIPS, frequency=FREQUENCIES, ulps=st.integers(-1, 1),
    whole=st.integers(-(10**6), 10**6), column=st.integers(0, 299),
)  # fmt: skip
def test_a_packet_may_start_just_where_a_column_does(
    seconds: float, chips: float, frequency: float, ulps: int, whole: int, column: int
) -> None:
    # As close as a start time can bring them, and one ulp on either side.
    start = float(whole * 24 / Fraction(frequency) - column * Fraction(seconds))
    start = start if ulps == 0 else math.nextafter(start, ulps * math.inf)
    start = within("start_time", start)
    scene = scene_of_exposure(chips, frequency, readout_time=seconds, start_time=start)
    exact, found = ExactTimes(scene), occ.on_time(scene)[column] / scene.camera.exposure_time
    error = float(abs(Fraction(float(found)) - exact.fraction(column)))
    record(COINCIDENCE, "t of whole chips, packets at a column's start, +- 1 ulp", error, 1e-12)


@cases(chips=decades(1e-9, 1e9), frequency=FREQUENCIES, start=STARTS, pattern=PATTERNS)
def test_on_time_is_never_negative_nor_above_the_exposure(
    chips: float, frequency: float, start: float, pattern: str
) -> None:
    scene = scene_of_exposure(chips, frequency, start_time=start, pattern=pattern)
    on_time, exposure = occ.on_time(scene), scene.camera.exposure_time
    beyond = max(-float(on_time.min()), float(on_time.max()) - exposure, 0.0) / exposure
    record("0 <= t_on <= t, of t", "t 1e-9 to 1e9 chips", beyond, 0.0)
    if "0" not in pattern and pattern:
        assert (on_time == exposure).all()


LONG = "1" * 2048 + "0" * 2048

MANY_COLUMNS: dict[str, dict[str, float | str]] = {
    # Not a binary fraction of a chip: rounding at each step would add up to 1e-10 chips.
    "a decimal readout time": {"readout_time": 7.77e-6},
    # A step of nearly a period, whose product with the column number needs 65 bits.
    "a step just short of a packet": {"readout_time": 24e-4 * (1 - 1e-9)},
    # Rounding such a step to 24 bits would add up to 80 chips.
    "thousands of chips a column": {"readout_time": 0.3333333333333333, "pattern": LONG},
    # With 4e-11 packets a column, the last one must still be 4e-5 packets from the first.
    "a step of next to nothing": {"readout_time": 1e-9, "switching_frequency": 1.0},
    # Ten million chips between two columns, all but a fraction of which must cancel exactly.
    "ten seconds a column at 1 GHz": {"readout_time": 9.999999999, "switching_frequency": 1e9},
    # Columns and packets are exactly in step, so that all columns must be the same.
    "exactly a packet a column": {"readout_time": 24 / 8192, "switching_frequency": 8192.0},
}  # fmt: skip


@pytest.mark.parametrize("name", MANY_COLUMNS)
def test_a_million_columns_do_not_drift(name: str) -> None:
    scene = Scene().replace(columns=1_000_000, start_time=1e9 - 1 / 7, **MANY_COLUMNS[name])
    exact, period = ExactTimes(scene), len(occ.packet(scene))
    phases = column_phases(scene, exact.frequency, period)
    for column in (0, 1, 999, 123_456, 524_287, 524_289, 999_998, 999_999):
        found = int(phases.whole[column]) + Fraction(float(phases.fraction[column]))
        drift = abs(found - exact.start(column) % period)
        error = float(min(drift, period - drift))
        record("a column's start, in chips", "1e6 columns, packets to 4096 chips", error, 3e-16)


NAMED: dict[str, dict[str, float | str]] = {
    # 1e13 chips after time zero, where a double holds the start only to 0.002 chips.
    "a million chips, a billion seconds away": {
        "start_time": 1e9 - 0.1, "exposure_time": 100.0, "switching_frequency": 1e4},
    # The same backwards: negative numbers must not be rounded towards zero.
    "a billion seconds before": {"start_time": -1e9 + 0.1, "switching_frequency": 1e9},
    # t_on is a thousandth of a chip at an edge, which the difference of sums would lose.
    "a thousandth of a chip": {"exposure_time": 1e-7, "start_time": 1e9, "pattern": "01"},
    # t = t_LED except for the rounding of 1/f, so that the window has one edge or just two.
    "just one chip": {"exposure_time": 1 / 3e4, "switching_frequency": 3e4, "pattern": "10"},
    # t is exactly three packets, so that every column is the same for any start.
    "just three packets": {"exposure_time": 72 / 8192, "switching_frequency": 8192.0},
    # One ulp more than that: t_on may differ from column to column by that ulp only.
    "three packets and an ulp": {
        "exposure_time": math.nextafter(72 / 8192, 1), "switching_frequency": 8192.0},
    # Columns start exactly at chips' edges, each of which belongs to one of two chips.
    "one chip a column": {"readout_time": 2.0**-13, "switching_frequency": 8192.0},
    # All columns are at the same instant of the packet.
    "one packet a column": {"readout_time": 24 / 8192, "switching_frequency": 8192.0},
    # The shortest time at the highest frequency: one chip a column and an exposure.
    "nanoseconds": {"readout_time": 1e-9, "exposure_time": 1e-9, "switching_frequency": 1e9},
    # A nanosecond a column and a chip a second: columns must neither jump nor stand still.
    "a chip of a billion columns": {"readout_time": 1e-9, "switching_frequency": 1.0},
    # 1e15 chips in an exposure, where the rest beyond whole packets is the 16th digit.
    "the longest exposure": {"exposure_time": 1e6, "switching_frequency": 1e9},
    # One lit chip in 4096: t_on is nearly everywhere 0, and somewhere all of t.
    "one lit chip": {"pattern": "1" + "0" * 4095, "exposure_time": 1e-6, "readout_time": 1e-4},
}  # fmt: skip


@each_case(NAMED)
def test_on_time_of_a_hard_scene_is_that_of_rational_arithmetic(name: str) -> None:
    scene = Scene().replace(**({"columns": 2000} | NAMED[name]))
    error = error_of(scene)
    record("t_on, of t", WIDE, error, 1e-12)
