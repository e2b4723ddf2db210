"""Flicker of a lamp for the eye: flicker index, IEEE 1789-2015, SVM.

The texts of IEEE Std 1789-2015 and IEC TR 63158:2018 were not available. The limits of the former
are those that manufacturers quote from its recommended practices 1 and 2. Two thresholds of SVM
have been published.
"""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.results.bands import EyeFlicker, RiskLines
from occ_model.scene.scene import Scene, Transmitter
from occ_model.study.bands.depth import mean_light
from occ_model.study.bands.exposed_light import exposed_light
from occ_model.study.bands.sines import repeat_time, sines_of

NO_EFFECT, LOW_RISK, ABOVE_LOW_RISK = "no effect", "low risk", "above low risk"

_BREAK_FREQUENCY = 90.0  # Hz below which the limits of IEEE 1789-2015 are stricter
_LOW_RISK_LINE = (0.025, 0.08, 1250.0)
_NO_EFFECT_LINE = (0.01, 0.0333, 3000.0)  # % per Hz below and above 90 Hz, and the line's end in Hz
_SVM_BAND = (80.0, 2000.0)  # Hz
_SVM_EXPONENT = 3.7  # exponent of the Minkowski sum over the components
_SINES_PER_PIECE = 64  # sines per shortest piece of light; higher ones are below 1 %
_MAX_SINES = 10_000  # components that are returned; a long payload has millions


def eye_flicker(scene: Scene) -> EyeFlicker:
    """Return the flicker measures of a scene's lamp, whose light repeats.

    They hold for the lamp's own light, including its edges: ambient light reduces them, and a code
    that changes between packets adds slower components.
    """
    transmitter = scene.transmitter
    mean = mean_light(transmitter) if transmitter.luminance else 0.0
    least, most, excess = _light_range(transmitter) if mean else (0.0, 0.0, 0.0)
    percent = 100.0 * (most - least) / (most + least) if most else 0.0
    sines = sines_of(transmitter, _SINES_PER_PIECE, _NO_EFFECT_LINE[2])
    frequencies = sines.frequencies
    modulations = 100.0 * sines.amplitudes / mean if mean else 0.0 * frequencies
    period = repeat_time(transmitter)
    frequency = float(1 / period) if period else 0.0
    fundamental = np.array([frequency]), np.array([percent])
    strongest = np.sort(np.argsort(modulations)[-_MAX_SINES:])
    return EyeFlicker(
        percent_flicker=percent,
        flicker_index=excess / mean if mean else 0.0,
        visibility=_visibility(frequencies, modulations / 100.0, threshold_2018),
        visibility_2016=_visibility(frequencies, modulations / 100.0, threshold_2016),
        frequency=frequency,
        frequencies=frequencies[strongest],
        modulations=modulations[strongest],
        risk=_risk(*fundamental),
        parts_risk=_risk(frequencies, modulations),
    )


def risk_limits(frequencies: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the limits of modulation in percent for no effect and low risk."""
    lines = []
    for slow, fast, end in (_NO_EFFECT_LINE, _LOW_RISK_LINE):
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
        for slow, fast, end in (_NO_EFFECT_LINE, _LOW_RISK_LINE)
    ]  # fmt: skip
    return RiskLines(*lines)


def threshold_2018(frequencies: FloatArray) -> FloatArray:
    """Return the modulation, 0 to 1, at which half of the observers see the effect.

    Of M. Perz and others, Stroboscopic effect: contrast threshold function and dependence on
    illumination level, J. Opt. Soc. Am. A 35 (2018) 309.
    """
    return np.asarray(2.865e-5 * frequencies**1.543 + 0.225)


def threshold_2016(frequencies: FloatArray) -> FloatArray:
    """Return the threshold of CIE TN 006:2016, Visual aspects of time-modulated lighting systems.

    Both thresholds agree up to some 700 Hz; above, this one does not exceed 1.
    """
    rising = 1.0 / (1.0 + np.exp(-0.00518 * (frequencies - 306.6)))
    return np.asarray(rising + 20.0 * np.exp(-frequencies / 10.0))


def _visibility(
    frequencies: FloatArray,
    modulations: FloatArray,
    threshold_of: Callable[[FloatArray], FloatArray],
) -> float:
    in_band = (frequencies >= _SVM_BAND[0]) & (frequencies <= _SVM_BAND[1])
    ratios = modulations[in_band] / threshold_of(frequencies[in_band])
    return float((ratios**_SVM_EXPONENT).sum() ** (1.0 / _SVM_EXPONENT))


def _risk(frequencies: FloatArray, modulations: FloatArray) -> str:
    no_effect, low_risk = risk_limits(frequencies)
    if (modulations <= no_effect).all():
        return NO_EFFECT
    return LOW_RISK if (modulations <= low_risk).all() else ABOVE_LOW_RISK


def _light_range(transmitter: Transmitter) -> tuple[float, float, float]:
    """Return the minimum and maximum light over a period, and the mean excess above the mean."""
    light, edge = light_of(transmitter), Fraction(transmitter.edge_time)
    if isinstance(light, Cosine):
        swing = light.depth * abs(light.response(edge))
        return 1.0 - swing, 1.0 + swing, swing / np.pi
    waveform, mean = light.waveform, light.mean
    if not edge:
        levels = waveform.levels.astype(np.float64)
        lengths = (waveform.lengths / waveform.period).astype(np.float64)
        excess = float((lengths * np.maximum(levels - mean, 0.0)).sum())
        return float(levels.min()), float(levels.max()), excess
    # The ramps are a moving average of the light over the edge time, as an exposure is.
    units = edge * light.rate
    ramps = exposed_light(waveform, units, Fraction(0))
    lengths, (first, _, last) = ramps.lengths / waveform.period, ramps.values.T / float(units)
    low, high = (value / float(units) for value in ramps.extremes)
    higher, lower = np.maximum(first, last), np.minimum(first, last)
    crosses = (higher > 0.0) & (lower < 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        excess_of_piece = np.where(
            crosses, higher**2 / (2.0 * (higher - lower)), 0.5 * (higher + lower)
        )
    return mean + low, mean + high, float((lengths * np.maximum(excess_of_piece, 0.0)).sum())
