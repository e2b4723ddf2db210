"""What the matched decoder must read beyond the limit of threshold decoding."""

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.exposure import lit_fraction
from occ_model.receiver.matched.decoder import find_most_likely
from occ_model.receiver.matched.templates import (
    BINS_PER_CHIP,
    CodeTemplates,
    make_code_templates,
)
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import success_rate
from occ_model.transmitter.scheme import packet_length

HIGH_CONFIDENCE = 0.5


@pytest.mark.parametrize("frequency", range(4000, 40001, amount(9000, 2000)))
def test_every_noisy_code_is_read_at_136_us_from_4_to_40_khz(frequency: int) -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=frequency, distance=1.0)
    rng = np.random.default_rng(frequency)
    for code in rng.integers(0, 1024, amount(3, 8)).tolist():
        assert success_rate(scene.replace(code=code), 2, "matched", seed=code) == 100.0


def test_a_single_packet_is_read_and_a_failure_is_stated_if_none_fits() -> None:
    scene = occ.load_preset("phone-136us").replace(distance=0.6)
    # 3456 columns of 8 us: at 1 kHz they last 27.6 chips, a packet has 24.
    assert success_rate(scene.replace(switching_frequency=1e3), 2, "matched") == 100.0
    slow = scene.replace(switching_frequency=850.0)
    result = occ.decode(occ.render(slow).image, slow, "matched")
    assert "Less than one packet" in result.failure


@pytest.mark.parametrize("enhancement", ["equalization", "stretch", "none"])
@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_no_tone_curve_needs_to_be_known(enhancement: str, averaging: str) -> None:
    scene = occ.load_preset("phone-136us").replace(
        enhancement=enhancement, averaging=averaging, switching_frequency=20e3
    )
    for code in (0, 5, 341, 682, 1000, 1023):
        assert success_rate(scene.replace(code=code), 1, "matched") == 100.0


def test_the_code_book_holds_the_forward_model_of_every_code() -> None:
    frequency, exposure = 10e3, 237e-6
    templates = make_code_templates(10, Fraction(exposure) * Fraction(frequency))
    for code in (0, 3, 718, 1023):
        scene = Scene().replace(
            code=code,
            switching_frequency=frequency,
            exposure_time=exposure,
            readout_time=1 / frequency / BINS_PER_CHIP,
            columns=packet_length(10) * BINS_PER_CHIP,
        )
        np.testing.assert_allclose(
            templates.profiles(np.array([code]))[0], lit_fraction(scene), atol=1e-9
        )


def _correlations(signal: FloatArray, templates: CodeTemplates, codes: IndexArray) -> FloatArray:
    """Correlate a signal with each code's profile at each phase, shape (codes, phases)."""
    profiles = templates.profiles(codes)
    profiles -= profiles.mean(axis=1, keepdims=True)
    norms = np.where(np.isfinite(templates.energy[codes]), np.linalg.norm(profiles, axis=1), np.inf)
    spectrum = np.fft.rfft(signal - signal.mean()) * np.conj(np.fft.rfft(profiles, axis=1))
    return np.fft.irfft(spectrum, len(signal), axis=1) / norms[:, None]


def _exposures(bits: int) -> list[Fraction]:
    """Return exposures in chips: short, long, of whole chips (where codes tie), at a null."""
    packet = packet_length(bits)
    null = [Fraction(packet) * (1 + Fraction(1, 10**place)) for place in (3, 6, 9)]
    return [Fraction(1, 10), Fraction(13, 7), Fraction(2), Fraction(packet, 2), *null]


def _signals(templates: CodeTemplates, rng: np.random.Generator) -> list[FloatArray]:
    """Return signals: a code's profile at some phase, with and without noise, and noise alone."""
    bins = len(templates.levels)
    profile = templates.profiles(rng.integers(0, len(templates.energy), 1))[0]
    profile = np.roll(profile, int(rng.integers(bins)))
    noise = rng.normal(0.0, 1.0, bins)
    return [profile, profile + np.ptp(profile) * noise, noise]


@pytest.mark.parametrize("bits", [*range(2, 11, amount(2, 1)), 16])
def test_no_code_that_correlates_better_is_missed(bits: int) -> None:
    rng = np.random.default_rng(bits)
    # Of 16 bits, a sample of the codes beside those that are found.
    codes = np.arange(2**bits) if bits <= 10 else rng.integers(0, 2**bits, 2000)
    for exposure in _exposures(bits)[1 :: amount(4, 1)] if bits == 16 else _exposures(bits):
        templates = make_code_templates(bits, exposure)
        for signal in _signals(templates, rng):
            found, phases = find_most_likely(signal, templates)
            assert len(set(found.tolist())) == len(found) == min(16, 2**bits)
            correlations = _correlations(signal, templates, found)
            largest = correlations.max(axis=1)
            limit = 1e-7 * abs(largest).max()  # codes that tie may be exchanged
            at_phases = correlations[range(len(found)), phases]
            np.testing.assert_allclose(at_phases, largest, atol=limit)
            others = _correlations(signal, templates, codes[~np.isin(codes, found)])
            assert others.max(initial=-np.inf) <= largest.min() + limit


@pytest.mark.parametrize("bits", range(2, 12, amount(3, 1)))
def test_energies_are_those_of_the_profiles(bits: int) -> None:
    for exposure in _exposures(bits):
        templates = make_code_templates(bits, exposure)
        profiles = templates.profiles(np.arange(2**bits))
        energies = len(templates.levels) * profiles.var(axis=1)
        known = np.isfinite(templates.energy)
        np.testing.assert_allclose(templates.energy[known], energies[known], rtol=1e-5)
        assert (energies[~known] <= 2e-12 * len(templates.levels)).all()


def test_codes_of_sixteen_bits_take_little_memory() -> None:
    scene = occ.load_preset("phone-136us").replace(bits=16, code=54321, switching_frequency=19e3)
    profile = occ.column_profile(scene)
    tracemalloc.start()
    try:
        assert occ.decode(profile, scene, "matched").code == scene.transmitter.code
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 2**23  # as numbers, the packets of all codes take 19 MB


def test_confidence_is_near_1_when_clear_and_near_0_for_noise() -> None:
    scene = occ.load_preset("phone-136us").replace(rows=400)
    clear = occ.decode(occ.render(scene).image, scene, "matched")
    assert clear.confidence > 0.9
    rng = np.random.default_rng(5)
    for _ in range(amount(15, 200)):
        noise = occ.decode(rng.normal(100.0, 5.0, 1730), scene, "matched")
        assert noise.code is None
        assert noise.failure is not None
        assert noise.confidence < HIGH_CONFIDENCE


def test_a_wrong_code_never_comes_with_high_confidence() -> None:
    rng = np.random.default_rng(6)
    wrong_and_sure, wrong = 0, 0
    base = occ.load_preset("phone-136us").replace(enhancement="none")
    for _ in range(amount(120, 500)):
        scene = base.replace(
            code=int(rng.integers(1024)),
            switching_frequency=float(rng.uniform(40e3, 60e3)),
            start_time=float(rng.uniform(0, 0.02)),
            columns=int(rng.integers(80, 300)),
        )
        profile = occ.column_profile(scene)
        noisy = profile + rng.normal(0, float(10 ** rng.uniform(0, 1)), len(profile))
        result = occ.decode(noisy, scene, "matched")
        if result.code is not None and result.code != scene.transmitter.code:
            wrong += 1
            wrong_and_sure += result.confidence >= HIGH_CONFIDENCE
    assert wrong_and_sure == 0
    assert wrong > 0  # otherwise the trials are too easy to prove anything


@pytest.mark.parametrize("bits", [2, 5])
@pytest.mark.parametrize("exposure", [Fraction(1, 2), Fraction(7, 3)])
def test_levels_are_quantiles_of_all_codes_profiles(bits: int, exposure: Fraction) -> None:
    """There are as many evenly spaced quantiles as bins."""
    templates = make_code_templates(bits, exposure)
    profiles = templates.profiles(np.arange(2**bits))
    bins = profiles.shape[1]
    expected = np.quantile(profiles, (np.arange(bins) + 0.5) / bins)
    assert templates.levels == pytest.approx(expected, abs=1e-9)
