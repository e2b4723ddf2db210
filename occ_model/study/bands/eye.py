"""Flicker of a lamp for the eye: flicker index, IEEE 1789-2015, SVM.

The texts of IEEE Std 1789-2015 and IEC TR 63158:2018 were not available. The limits of the former
are those that manufacturers quote from its recommended practices 1 and 2; of SVM two thresholds are
published.
"""

from collections.abc import Callable

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.bands import EyeFlicker, RiskLines
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import edge_in_chips
from occ_model.study.bands.exposed_light import exposed_light
from occ_model.transmitter.scheme import sent_chips

NO_EFFECT, LOW_RISK, ABOVE = "no effect", "low risk", "above low risk"

_BREAK_FREQUENCY = 90.0  # Hz below which the limits of IEEE 1789-2015 are stricter
_LOW_RISK = (0.025, 0.08, 1250.0)
_NO_EFFECT = (0.01, 0.0333, 3000.0)  # % per Hz below and above 90 Hz, and the line's end in Hz
_SVM_BAND = (80.0, 2000.0)  # Hz
_SVM_EXPONENT = 3.7  # of the Minkowski sum over the components
_MAX_CHIPS = 64  # highest component in switching frequencies; higher ones are below 1 %
_MAX_SINES = 10_000  # components that are returned; a long payload has millions


def eye_flicker(scene: Scene) -> EyeFlicker:
    """Return the flicker measures of a scene's lamp while its code is repeated.

    They hold for the lamp's own light, including its edges: ambient light reduces them, and a code
    that changes between packets adds slower components.
    """
    chips = _lit_chips(scene)
    frequency = scene.transmitter.switching_frequency / len(chips)
    lit = float(chips.mean())
    least, most, above = _levels(scene)
    percent = 100.0 * (most - least) / (most + least) if most else 0.0
    frequencies, modulations = _sines(scene)
    whole = np.array([frequency]), np.array([percent])
    strongest = np.sort(np.argsort(modulations)[-_MAX_SINES:])
    return EyeFlicker(
        percent_flicker=percent,
        flicker_index=above / lit if lit else 0.0,
        visibility=_visibility(frequencies, modulations / 100.0, threshold),
        visibility_2016=_visibility(frequencies, modulations / 100.0, threshold_2016),
        frequency=frequency,
        frequencies=frequencies[strongest],
        modulations=modulations[strongest],
        risk=_risk(*whole),
        parts_risk=_risk(frequencies, modulations),
    )


def risk_limits(frequencies: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the limits of modulation in percent for no effect and low risk."""
    lines = []
    for slow, fast, end in (_NO_EFFECT, _LOW_RISK):
        line = np.where(frequencies < _BREAK_FREQUENCY, slow, fast) * frequencies
        lines.append(np.where(frequencies > end, np.inf, line))
    return lines[0], lines[1]


def risk_lines() -> RiskLines:
    """Return the corners of both lines in a log-log chart from 1 Hz on."""
    lines = [
        np.array([
            (at, rate * at)
            for rate, ends in ((slow, (1.0, _BREAK_FREQUENCY)), (fast, (_BREAK_FREQUENCY, end)))
            for at in ends
        ])
        for slow, fast, end in (_NO_EFFECT, _LOW_RISK)
    ]  # fmt: skip
    return RiskLines(*lines)


def threshold(frequencies: FloatArray) -> FloatArray:
    """Return the modulation, 0 to 1, at which half of the observers see the effect.

    Of M. Perz and others, Stroboscopic effect: contrast threshold function and dependence on
    illumination level, J. Opt. Soc. Am. A 35 (2018) 309.
    """
    return np.asarray(2.865e-5 * frequencies**1.543 + 0.225)


def threshold_2016(frequencies: FloatArray) -> FloatArray:
    """Return the same by CIE TN 006:2016, Visual aspects of time-modulated lighting systems.

    Both are alike up to some 700 Hz; faster, this one rises no further than to 1.
    """
    rising = 1.0 / (1.0 + np.exp(-0.00518 * (frequencies - 306.6)))
    return np.asarray(rising + 20.0 * np.exp(-frequencies / 10.0))


def _visibility(
    frequencies: FloatArray,
    modulations: FloatArray,
    threshold_of: Callable[[FloatArray], FloatArray],
) -> float:
    seen = (frequencies >= _SVM_BAND[0]) & (frequencies <= _SVM_BAND[1])
    ratios = modulations[seen] / threshold_of(frequencies[seen])
    return float((ratios**_SVM_EXPONENT).sum() ** (1.0 / _SVM_EXPONENT))


def _risk(frequencies: FloatArray, modulations: FloatArray) -> str:
    no_effect, low_risk = risk_limits(frequencies)
    if (modulations <= no_effect).all():
        return NO_EFFECT
    return LOW_RISK if (modulations <= low_risk).all() else ABOVE


def _lit_chips(scene: Scene) -> ByteArray:
    """Return the lit chips; none for a lamp without luminance."""
    chips = sent_chips(scene.transmitter)
    return chips if scene.transmitter.luminance else np.zeros_like(chips)


def _levels(scene: Scene) -> tuple[float, float, float]:
    """Return the minimum and maximum light over a period, and the mean excess above the mean."""
    chips = _lit_chips(scene)
    lit = float(chips.mean())
    edge = edge_in_chips(scene)
    if not edge:
        return float(chips.min()), float(chips.max()), lit * (1.0 - lit)
    # The ramps are a moving average of the chips over the edge time, as an exposure is.
    light = exposed_light(chips, edge, edge * 0)
    lengths, (first, _, last) = light.lengths / len(chips), light.values.T / float(edge)
    low, high = (value / float(edge) for value in light.extremes)
    over, under = np.maximum(first, last), np.minimum(first, last)
    crossing = (over > 0.0) & (under < 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(crossing, over**2 / (2.0 * (over - under)), 0.5 * (over + under))
    return lit + low, lit + high, float((lengths * np.maximum(part, 0.0)).sum())


def _sines(scene: Scene) -> tuple[FloatArray, FloatArray]:
    """Return the Fourier components: frequencies in Hz, amplitudes in percent of the mean."""
    chips = _lit_chips(scene)
    period, total = len(chips), int(chips.sum())
    base = scene.transmitter.switching_frequency / period
    count = int(min(_NO_EFFECT[2] / base, _MAX_CHIPS * period))
    order = np.arange(1, count + 1)
    of_a_chip = order / period
    sent = 2.0 * np.abs(np.fft.fft(chips))[order % period] / max(total, 1)
    ramp = np.sinc(of_a_chip * float(edge_in_chips(scene)))
    return np.asarray(order * base), 100.0 * sent * np.abs(np.sinc(of_a_chip) * ramp)
