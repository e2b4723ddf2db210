"""Laws of the band model, with which the paper compares itself."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.scene.scene import Scene
from occ_model.simulation.band_model import band_drift


@pytest.mark.parametrize(
    ("period", "exposure", "readout", "complete", "transition", "last_digit"),
    [
        (500e-6, 62.5e-6, 14.58e-6, 30.01, 4.29, 0.01),
        (1e-3, 0.488e-3, 3.377e-6, 151.6, 144.5, 0.1),
        (100e-6, 68e-6, 8e-6, 4.0, 8.5, 1e-9),
    ],
)
def test_bands_are_as_long_as_published(
    period: float,
    exposure: float,
    readout: float,
    complete: float,
    transition: float,
    last_digit: float,
) -> None:
    scene = Scene().replace(
        switching_frequency=1 / period, exposure_time=exposure, readout_time=readout
    )
    assert occ.band_lengths(scene) == pytest.approx((complete, transition), abs=last_digit / 2)


def test_an_exposure_beyond_the_period_is_refused_with_times() -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3)
    with pytest.raises(occ.BandModelUndefined, match=r"136 µs.*100 µs"):
        occ.band_profile(scene)


def test_an_exposure_of_exactly_one_period_is_the_last_defined() -> None:
    scene = Scene().replace(switching_frequency=8192.0, exposure_time=1 / 8192)
    assert occ.band_lengths(scene)[0] == 0.0
    assert occ.band_profile(scene).shape == (scene.camera.columns,)


@given(
    fraction=st.floats(0.02, 1.0),
    code=st.integers(0, 1023),
    start=st.floats(0.0, 0.01),
    readout=st.floats(1e-6, 2e-4),
    iso=st.floats(50.0, 10_000.0),
)
def test_the_aligned_reading_is_exact_where_defined(
    fraction: float, code: int, start: float, readout: float, iso: float
) -> None:
    scene = Scene().replace(
        code=code,
        iso=iso,
        exposure_time=fraction * 1e-4,
        start_time=start,
        readout_time=readout,
        columns=400,
    )
    np.testing.assert_allclose(occ.band_profile(scene), occ.column_profile(scene), atol=1e-9)


def test_the_literal_reading_gives_chips_whole_columns() -> None:
    # h_c = 4, h_t = 3: one packet of 01 has two chips and two changes, 14 columns.
    scene = Scene().replace(
        pattern="01",
        switching_frequency=1e5,
        exposure_time=3e-6,
        readout_time=1e-6,
        columns=70,
        band_reading="literal",
    )
    scene = scene.replace(switching_frequency=1 / 7e-6)
    dark, bright = level_values(scene)
    profile = occ.band_profile(scene)
    np.testing.assert_allclose(profile[:14], profile[14:28])
    assert (profile[:4] == dark).all()
    assert (profile[7:11] == bright).all()
    assert ((profile[4:7] > dark) & (profile[4:7] < bright)).all()


@given(fraction=st.floats(0.02, 1.0), code=st.integers(0, 1023), readout=st.floats(2e-6, 2e-5))
def test_the_drift_is_by_how_much_the_model_s_packet_is_shorter(
    fraction: float, code: int, readout: float
) -> None:
    scene = Scene().replace(
        code=code,
        switching_frequency=2e3,
        exposure_time=fraction / 2e3,
        readout_time=readout,
        band_reading="literal",
    )
    sent = len(occ.packet(scene)) / (2e3 * readout)
    counted = round(sent - band_drift(scene))
    assert counted == pytest.approx(sent - band_drift(scene), abs=1e-6)
    profile = occ.band_profile(scene.replace(columns=2 * counted))
    np.testing.assert_allclose(profile[:counted], profile[counted:], atol=1e-9)
    assert band_drift(scene.replace(band_reading="aligned")) == 0.0


def test_a_packet_that_rounds_to_no_column_is_refused() -> None:
    scene = Scene().replace(
        switching_frequency=1e6,
        exposure_time=0.5e-6,
        readout_time=100e-6,
        columns=10,
        band_reading="literal",
    )
    with pytest.raises(occ.BandModelUndefined, match="rounds to none"):
        occ.band_profile(scene)


def _other_light(kind: str, number: float, frequency: float, duty: float, depth: float) -> Scene:
    """Return a scene of another light than a code, of the same period."""
    sent: dict[str, dict[str, float | str]] = {
        "lamp": {"lamp_frequency": frequency, "duty": duty, "depth": depth},
        "pulses": {"pulse_frequency": frequency, "pulse_length": duty / frequency},
        "levels": {"levels": "3 0 0 1 2 3 / 3", "switching_frequency": 6.0 * frequency},
        "file": {"waveform_file": f"0,1\n{duty / frequency!r},{1 - depth!r}\n{1 / frequency!r}\n"},
    }
    light = kind if kind in ("lamp", "pulses") else "waveform"
    return Scene().replace(light=light, start_time=number, columns=300, **sent[kind])


@pytest.mark.parametrize("kind", ["lamp", "pulses", "levels", "file"])
@given(
    fraction=st.floats(0.01, 1.0), duty=st.floats(0.05, 0.95), depth=st.floats(0.1, 1.0),
    frequency=st.floats(50.0, 5e3), start=st.floats(0.0, 1.0), readout=st.floats(1e-6, 1e-4),
)  # fmt: skip
def test_bands_of_any_light_are_its_exposure_up_to_the_shortest_time_at_one_level(
    kind: str, fraction: float, duty: float, depth: float, frequency: float, start: float,
    readout: float,
) -> None:  # fmt: skip
    # Of the levels 3 0 0 1 2 3 the two 0 and, over the period's end, the two 3 are one band each.
    shortest = 1 / 6 if kind == "levels" else min(duty, 1 - duty)
    scene = _other_light(kind, start, frequency, duty, depth).replace(
        readout_time=readout, exposure_time=fraction * shortest * (1 - 1e-9) / frequency
    )
    complete, transition = occ.band_lengths(scene)
    assert complete + transition == pytest.approx(shortest / frequency / readout, rel=1e-6)
    np.testing.assert_allclose(occ.band_profile(scene), occ.column_profile(scene), atol=1e-8)
    longer = scene.replace(exposure_time=shortest * (1 + 1e-9) / frequency)
    with pytest.raises(occ.BandModelUndefined, match="the shortest time at one level"):
        occ.band_profile(longer)


def test_literal_bands_of_a_lamp_have_whole_columns() -> None:
    # Lit 9.4 columns and dark 20.6, exposed for 3.2: 6 and 17 columns, with two changes of 3.
    scene = _other_light("lamp", 0.0, 1 / 30e-6, 9.4 / 30, 1.0).replace(
        readout_time=1e-6, exposure_time=3.2e-6, band_reading="literal"
    )
    dark, bright = level_values(scene)
    profile = occ.band_profile(scene)
    assert [int((profile[:29] == level).sum()) for level in (bright, dark)] == [6, 17]
    np.testing.assert_allclose(profile[29:58], profile[:29])
    assert band_drift(scene) == pytest.approx(30 - 29)
    late = scene.replace(start_time=9.4e-6)  # where it becomes dark
    np.testing.assert_array_equal(occ.band_profile(late)[:17], profile[9:26])


@pytest.mark.parametrize(
    "steady",
    [
        {"light": "lamp", "duty": 0.0}, {"light": "lamp", "duty": 1.0},
        {"light": "lamp", "depth": 0.0}, {"light": "waveform", "levels": "1 1 1 / 3"},
        {"light": "pulses", "pulse_length": 1.0},
    ],
)  # fmt: skip
@pytest.mark.parametrize("reading", ["aligned", "literal"])
def test_steady_light_is_one_band_however_long_the_exposure(
    steady: dict[str, float | str], reading: str
) -> None:
    scene = Scene().replace(**steady, exposure_time=0.1, columns=20, band_reading=reading)
    assert occ.band_lengths(scene)[0] == np.inf
    np.testing.assert_allclose(occ.band_profile(scene), occ.column_profile(scene), atol=1e-9)
    assert band_drift(scene) == 0.0


def test_light_without_steps_has_no_bands() -> None:
    with pytest.raises(occ.BandModelUndefined, match="swings without steps"):
        occ.band_profile(Scene().replace(light="mains"))
