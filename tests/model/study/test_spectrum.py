"""The spectrum of a profile has its sines' amplitudes and the response's zeros."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.study.spectrum import level_histogram, profile_spectrum


@pytest.mark.parametrize(("amplitude", "cycles"), [(10.0, 40), (3.0, 123), (80.0, 400)])
def test_a_sine_has_its_amplitude_at_its_frequency(amplitude: float, cycles: int) -> None:
    scene = occ.load_preset("phone-68us")
    columns = 2048
    profile = 100.0 + amplitude * np.sin(2 * np.pi * cycles * np.arange(columns) / columns)
    found = profile_spectrum(profile, scene)
    peak = int(found.amplitudes.argmax())
    assert found.amplitudes[peak] == pytest.approx(amplitude, rel=1e-3)
    wanted = cycles / (columns * scene.camera.readout_time)
    assert found.frequencies[peak] == pytest.approx(wanted)
    assert found.frequencies[-1] == pytest.approx(0.5 / scene.camera.readout_time)


@pytest.mark.parametrize("frequency", [4e3, 9e3, 13e3])
def test_an_alternating_pattern_is_damped_as_the_response_says(frequency: float) -> None:
    scene = occ.load_preset("phone-136us").replace(
        pattern="10", switching_frequency=frequency, columns=20_000
    )
    short = scene.replace(exposure_time=1e-6)
    one, other = (
        profile_spectrum(occ.on_time(s) / s.camera.exposure_time, s) for s in (scene, short)
    )
    place = int(other.amplitudes.argmax())
    assert one.frequencies[place] == pytest.approx(frequency / 2, rel=1e-2)
    damped = one.amplitudes[place] / other.amplitudes[place]
    assert damped == pytest.approx(one.response[place] / other.response[place], rel=1e-3)


def test_the_zeros_are_where_the_response_vanishes() -> None:
    scene = occ.load_preset("phone-136us")
    found = profile_spectrum(np.zeros(3000), scene)
    assert found.zeros[0] == pytest.approx(1 / 136e-6)
    at_zeros = np.interp(found.zeros, found.frequencies, found.response)
    assert at_zeros.max() < 0.02
    assert len(found.zeros) == int(0.5 / 8e-6 * 136e-6)


@pytest.mark.parametrize(
    ("sent", "frequency", "count"),
    [
        ({"light": "lamp", "lamp_frequency": 239.0, "duty": 0.3}, 239.0, 100),
        ({"light": "pulses", "pulse_frequency": 2e3}, 2e3, 31),
        ({"light": "mains", "mains_frequency": 60.0}, 120.0, 1),
        ({"light": "waveform", "levels": "0 1 2 / 2", "switching_frequency": 9e3}, 3e3, 20),
        ({"pattern": "1100", "switching_frequency": 8e3}, 2e3, 31),
        ({}, 0.0, 0),  # a packet's are too many to be told apart
    ],
)
def test_the_harmonics_are_the_multiples_at_which_the_light_repeats(
    sent: dict[str, str | float], frequency: float, count: int
) -> None:
    scene = occ.load_preset("phone-136us").replace(exposure_time=1e-6, columns=60_000, **sent)
    found = profile_spectrum(occ.on_time(scene), scene)
    assert found.harmonics == pytest.approx([k * frequency for k in range(1, count + 1)])
    if count:
        peaks = found.frequencies[found.amplitudes > 0.05 * found.amplitudes.max()]
        off = np.abs(peaks / frequency - np.rint(peaks / frequency)) * frequency
        assert off.max() < 3 * found.frequencies[1]  # a Hann window's width


def test_the_fractions_of_a_histogram_add_up_and_show_what_is_clipped() -> None:
    image = np.array([[0, 0, 7, 255], [255, 9, 9, 255]], dtype=np.uint8)
    found = level_histogram(image)
    assert found.fractions.sum() == pytest.approx(1.0)
    assert (found.fractions[0], found.white, found.is_saturated) == (0.25, 0.375, True)
    assert not level_histogram(image[:, 2:3]).is_saturated
    assert level_histogram(image[:0]).fractions.sum() == 0.0
