"""The null, where an exposure has the same light for any start, so that the contrast cancels."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import (
    PATTERNS,
    STARTS,
    ExactTimes,
    decades,
    exact_column_value,
    signed_decades,
    within,
)
from occ_model.camera.enhancement import enhance
from occ_model.camera.photometry import FLAT_SPAN
from occ_model.scene.scene import Scene

mpmath.mp.dps = 40

METHODS = st.sampled_from(["equalization", "stretch", "none"])
OFF_THE_NULL = st.one_of(st.just(0.0), signed_decades(1e-16, 1e-2))
"""Relative distances of the frequency from the null."""


def null_scene(packets: int, exposure: float, off: float, **changes: float | str) -> Scene:
    """Make a scene whose exposure lasts some packets, or nearly."""
    scene = Scene().replace(**({"columns": 24, "exposure_time": exposure} | changes))
    frequency = packets * len(occ.packet(scene)) / exposure * (1 + off)
    return scene.replace(switching_frequency=within("switching_frequency", frequency))


def exact_value(scene: Scene, column: int) -> mpmath.mpf:
    """Return a column's pixel value, by equations (1) to (3), to 40 digits."""
    exact = ExactTimes(scene).fraction(column)
    fraction = mpmath.mpf(exact.numerator) / exact.denominator
    return min(exact_column_value(scene, fraction), mpmath.mpf(255))


@cases(
    packets=st.integers(1, 10**4), exposure=decades(1e-5, 1.0), off=OFF_THE_NULL,
    readout=decades(1e-8, 1e-3), start=STARTS, pattern=PATTERNS,
    averaging=st.sampled_from(["pixel-value", "light"]), iso=decades(1.0, 1e5),
)  # fmt: skip
def test_the_swing_is_right_at_and_beside_the_null(
    packets: int, exposure: float, off: float, readout: float, start: float, pattern: str,
    averaging: str, iso: float,
) -> None:  # fmt: skip
    scene = null_scene(
        packets, exposure, off,
        readout_time=readout, start_time=start, pattern=pattern, averaging=averaging, iso=iso,
    )  # fmt: skip
    exact = [exact_value(scene, column) for column in range(0, 24, 4)]
    profile = occ.column_profile(scene)[::4]
    error = float(abs((max(exact) - min(exact)) - float(np.ptp(profile)))) / 255
    values = max(float(abs(a - b)) for a, b in zip(exact, profile.tolist(), strict=True)) / 255
    record("the swing at a null, of full scale", "t 1 to 1e4 packets, +- 1e-16 to 1e-2", error)
    assert max(error, values) <= 1e-12


@pytest.mark.parametrize("periods", [1, 2, 3, 1000, 61_035])
def test_an_alternating_pattern_cancels_at_each_even_multiple(periods: int) -> None:
    # At f = 2/t, 4/t ... each exposure has as many lit chips as dark ones; 2^-13 s keeps it exact.
    scene = null_scene(periods, 2.0**-13, 0.0, pattern="01", start_time=1e9 / 7, columns=1000)
    assert scene.transmitter.switching_frequency == periods * 2.0**14
    assert np.ptp(occ.column_profile(scene)) == 0.0
    assert occ.on_time(scene)[0] == scene.camera.exposure_time / 2


@cases(
    level=st.floats(0.0, 254.0), swing=st.one_of(decades(1e-300, 1e-9), decades(1e-14, 0.999999)),
    half=st.booleans(), method=METHODS, seed=st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_a_profile_of_less_than_one_level_gets_rounding_only(
    level: float, swing: float, half: bool, method: str, seed: int
) -> None:
    # Half-way between two grey levels, the last bit decides which of them a column gets.
    low = math.floor(level) + 0.5 if half else level
    profile = low + swing * np.random.default_rng(seed).random(200)
    enhanced = enhance(profile, method).astype(float)
    moved = float(np.abs(enhanced - profile).max()) - 0.5
    stripes = float(np.ptp(enhanced))
    if np.ptp(profile) < 1e-9:
        record("stripes made of rounding, grey levels", "swing 0 to 1e-9 levels", stripes, 0.0)
    assert moved <= 1e-9
    assert stripes <= 1.0


@cases(
    low=st.floats(0.0, 250.0), swing=st.one_of(decades(FLAT_SPAN, 5.0), st.just(FLAT_SPAN)),
    method=METHODS, seed=st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_the_least_stripes_that_count_are_enhanced_in_order(
    low: float, swing: float, method: str, seed: int
) -> None:
    fraction = np.concatenate([[0.0, 1.0], np.random.default_rng(seed).random(100)])
    profile = low + swing * fraction
    enhanced = enhance(profile, method)
    ordered = enhanced[np.argsort(profile, kind="stable")].astype(int)
    against = float(max(-np.diff(ordered).min(), 0))
    record("enhancement against the columns' order, levels", "swing 1 to 5 levels", against, 0.0)
    levels = [round(value) for value in profile.tolist()]
    bottom, top = min(levels), max(levels)
    if method == "stretch" and np.ptp(profile) >= FLAT_SPAN and top > bottom:
        exact = [Fraction(255 * (level - bottom), top - bottom) for level in levels]
        wrong = max(abs(a - int(b)) for a, b in zip(exact, enhanced, strict=True)) - Fraction(1, 2)
        assert wrong <= 1e-9


@cases(
    packets=st.integers(1, 100), off=st.one_of(st.just(0.0), signed_decades(1e-16, 1e-6)),
    code=st.integers(0, 15), method=METHODS, iso=decades(50.0, 6400.0),
)  # fmt: skip
def test_at_a_null_no_decoder_reads_a_code_and_each_says_why(
    packets: int, off: float, code: int, method: str, iso: float
) -> None:
    scene = null_scene(
        packets, 136e-6, off, columns=600, rows=8, distance=0.1, code=code, bits=4,
        enhancement=method, iso=iso,
    )  # fmt: skip
    frame = occ.render(scene, tolerance=math.inf)
    read = 0
    for decoder in ("threshold", "matched"):
        for seen in (frame.image, frame.profile):
            result = occ.decode(seen, scene, decoder=decoder)
            read += result.code is not None
            assert result.code is not None or (result.failure or "").endswith(".")
    record("codes read at a null", "t 1 to 100 packets, +- 0 to 1e-6", float(read), 0.0)


def half_way(scene: Scene) -> Scene:
    """Set the luminance so that the middle column's value is half-way between two levels."""
    low, high = 1e2, 1e6
    while math.nextafter(low, high) < high:
        middle = (low + high) / 2
        below = occ.column_profile(scene.replace(luminance=middle)).mean() < 100.5
        low, high = (middle, high) if below else (low, middle)
    return scene.replace(luminance=low)


@pytest.mark.parametrize("method", ["equalization", "stretch", "none"])
@pytest.mark.parametrize("off", [0.0, 1e-15, -1e-15, 1e-13])
def test_values_between_two_levels_make_no_rounding_stripes(off: float, method: str) -> None:
    # The columns differ by 1e-13 levels around 100.5, so that separate rounding gives 100 and 101.
    scene = null_scene(1, 136e-6, off, columns=600, rows=8, distance=0.1, code=5, bits=4)
    scene = half_way(scene.replace(enhancement=method))
    profile = occ.column_profile(scene)
    assert abs(profile.mean() - 100.5) < 1e-9
    image = occ.render(scene, tolerance=math.inf).image
    assert np.ptp(image) == 0
    assert (occ.decode(image, scene).failure or "").startswith("No panel found")


def test_a_null_is_called_by_its_name() -> None:
    # 255 / swing would be infinite; the plan takes no swing below one grey level.
    scene = null_scene(1, 136e-6, 0.0, columns=600, rows=8, distance=0.1, code=5, bits=4)
    plan = occ.plan(scene)
    assert plan.stretch == 255.0
    profile = occ.column_profile(scene)
    assert "No stripes" in (occ.decode(profile, scene).failure or "")
    assert "No stripes" in (occ.decode(profile, scene, decoder="matched").failure or "")
