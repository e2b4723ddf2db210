"""Flicker for the eye, against integrals over a finely sampled wave and published relations."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene
from occ_model.study.bands.eye import risk_limits, threshold_2018

_PHONE = occ.load_preset("phone-136us")
_SAMPLES = 400


def _wave(scene: Scene) -> tuple[FloatArray, float]:
    """Return one period of the lamp's light, sampled, and the samples' rate in Hz."""
    chips = np.repeat(occ.packet(scene).astype(float), _SAMPLES)
    rate = scene.transmitter.switching_frequency * _SAMPLES
    ramp = round(scene.transmitter.edge_time * rate)
    if ramp:
        sums = np.concatenate([[0.0], np.cumsum(np.tile(chips, 3))])
        chips = ((sums[ramp:] - sums[:-ramp]) / ramp)[len(chips) : 2 * len(chips)]
    return chips, rate


@pytest.mark.parametrize(
    ("pattern", "frequency", "edge"),
    [("10", 200.0, 0.0), ("10", 200.0, 1e-3), ("1000", 800.0, 2e-3), ("1101001", 2100.0, 0.0),
     ("1101001", 2100.0, 1.5 / 2100.0)],
)  # fmt: skip
def test_the_measures_are_those_of_the_sampled_wave(
    pattern: str, frequency: float, edge: float
) -> None:
    scene = _PHONE.replace(pattern=pattern, switching_frequency=frequency, edge_time=edge)
    found = occ.eye_flicker(scene)
    wave, rate = _wave(scene)
    mean = wave.mean()
    contrast = 100.0 * (wave.max() - wave.min()) / (wave.max() + wave.min())
    assert found.percent_flicker == pytest.approx(contrast, rel=1e-2)
    index = np.maximum(wave - mean, 0.0).sum() / wave.sum()
    assert found.flicker_index == pytest.approx(index, rel=1e-2)
    amplitudes = 2.0 * np.abs(np.fft.rfft(wave)) / len(wave) / mean
    sines = np.fft.rfftfreq(len(wave), 1.0 / rate)
    seen = (sines >= 80.0) & (sines <= 2000.0)
    limits = 2.865e-5 * sines[seen] ** 1.543 + 0.225
    measure = float(((amplitudes[seen] / limits) ** 3.7).sum() ** (1 / 3.7))
    assert found.visibility == pytest.approx(measure, rel=2e-3)


def test_a_square_wave_of_100_hz_has_the_known_numbers() -> None:
    found = occ.eye_flicker(_PHONE.replace(pattern="10", switching_frequency=200.0))
    assert found.percent_flicker == 100.0
    assert found.flicker_index == 0.5
    # The fundamental alone, 4/pi of the mean against the threshold of 0.26, gives 4.897.
    assert found.visibility == pytest.approx(4.903, abs=1e-3)
    assert (found.risk, found.parts_risk) == ("above low risk", "above low risk")


def test_the_threshold_for_a_sine_is_the_published_one() -> None:
    # As published: 26 % at 100 Hz, and above 100 % from 776 Hz on: no sine reaches it.
    assert float(threshold_2018(np.array([100.0]))[0]) == pytest.approx(0.26, abs=5e-3)
    assert float(threshold_2018(np.array([777.0]))[0]) == pytest.approx(1.05, abs=0.01)


@pytest.mark.parametrize(
    ("frequency", "perz", "cie"),
    [(1000.0, 0.882, 1.308), (1500.0, 0.508, 1.276), (2000.0, 0.337, 1.273)],
)
def test_two_published_thresholds_differ_and_both_are_told_where_one_is_exceeded(
    frequency: float, perz: float, cie: float
) -> None:
    found = occ.eye_flicker(_PHONE.replace(pattern="10", switching_frequency=2.0 * frequency))
    assert found.visibility == pytest.approx(perz, abs=5e-4)
    assert found.visibility_2016 == pytest.approx(cie, abs=5e-4)
    assert f"SVM {perz:.3g} by Perz (2018) and {cie:.3g} by CIE TN 006:2016" in found.sentences[0]
    slow = occ.eye_flicker(_PHONE.replace(pattern="10", switching_frequency=200.0))
    assert min(slow.visibility, slow.visibility_2016) > 1.0
    assert "SVM 4.9 by Perz (2018) (1:" in slow.sentences[0]


def test_of_a_long_payloads_millions_of_sines_the_strongest_are_listed_and_all_are_judged() -> None:
    long = _PHONE.replace(payload="bits:" + "1001" * 1000, line_code="nrz")
    many = occ.eye_flicker(long.replace(switching_frequency=300.0))
    assert len(many.frequencies) == 10_000
    assert (np.diff(many.frequencies) > 0.0).all()
    # The payload repeats one pattern, whose sines are nearly all that is left.
    alone = occ.eye_flicker(_PHONE.replace(pattern="1001", switching_frequency=300.0))
    assert many.visibility == pytest.approx(alone.visibility, rel=0.02)
    assert many.modulations.max() == pytest.approx(alone.modulations.max(), rel=0.02)


def test_the_limits_of_risk_are_those_quoted_and_end_at_1250_and_3000_hz() -> None:
    no_effect, low_risk = risk_limits(np.array([50.0, 100.0, 120.0, 1250.0, 1251.0, 3001.0]))
    assert no_effect[:3] == pytest.approx([0.5, 3.33, 4.0], abs=0.01)
    assert low_risk[:4] == pytest.approx([1.25, 8.0, 9.6, 100.0])
    assert np.isinf(low_risk[4:]).all()
    assert np.isfinite(no_effect[4])
    assert np.isinf(no_effect[5])


@pytest.mark.parametrize(
    ("frequency", "risk"), [(1200.0, "above low risk"), (1300.0, "low risk"), (3100.0, "no effect")]
)
def test_full_modulation_meets_each_limit_from_its_end_on(frequency: float, risk: str) -> None:
    found = occ.eye_flicker(_PHONE.replace(pattern="10", switching_frequency=2.0 * frequency))
    assert found.risk == risk


def test_a_steady_lamp_does_not_flicker() -> None:
    steady = [_PHONE.replace(pattern=pattern) for pattern in ("1", "11")]
    off = _PHONE.replace(luminance=0.0)
    for scene in (*steady, off, off.replace(edge_time=20e-6)):
        found = occ.eye_flicker(scene)
        assert (found.percent_flicker, found.flicker_index, found.visibility) == (0.0, 0.0, 0.0)
        assert (found.risk, found.parts_risk) == ("no effect", "no effect")
