"""How the lamp's light flickers for the eye: flicker index, IEEE 1789-2015, SVM.

The texts of IEEE Std 1789-2015 and IEC TR 63158:2018 are not free and were not checked. The lines
of the former are as lighting makers quote its recommended practices 1 and 2; the measure of the
latter is as published by M. Perz and others, Stroboscopic effect: contrast threshold function and
dependence on illumination level, J. Opt. Soc. Am. A 35 (2018) 309.
"""

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.bands import EyeFlicker, RiskLines
from occ_model.scene.scene import Scene, check_scene
from occ_model.study.bands.depth import edge_in_chips
from occ_model.study.bands.exposed_light import exposed_light
from occ_model.transmitter.packet import sent_chips

NO_EFFECT, LOW_RISK, ABOVE = "no effect", "low risk", "above low risk"

_SLOW = 90.0
"""Hz below which the lines of IEEE 1789-2015 are lower."""

_LOW_RISK = (0.025, 0.08, 1250.0)
_NO_EFFECT = (0.01, 0.0333, 3000.0)
"""Percent of modulation for each Hz below 90 Hz and above, and where the line ends, in Hz."""

_VISIBLE = (80.0, 2000.0)
"""Hz between which SVM counts sines."""

_EXPONENT = 3.7
"""Of the sum of the sines in SVM."""

_MOST_CHIPS = 64
"""Sines are counted to as many times the switching frequency; those above are weaker than 1 %."""


def eye_flicker(scene: Scene) -> EyeFlicker:
    """Return how the light of a scene's lamp flickers for the eye, as its code is sent repeatedly.

    The lamp's own light alone, with its edges: light from elsewhere makes all measures smaller, and
    a code that changes from packet to packet has slower parts besides.

    Parameters
    ----------
    scene
        The scene.
    """
    check_scene(scene)
    chips = _lit_chips(scene)
    frequency = scene.transmitter.switching_frequency / len(chips)
    lit = float(chips.mean())
    least, most, above = _levels(scene)
    percent = 100.0 * (most - least) / (most + least) if most else 0.0
    frequencies, modulations = _sines(scene)
    whole = np.array([frequency]), np.array([percent])
    return EyeFlicker(
        percent_flicker=percent,
        flicker_index=above / lit if lit else 0.0,
        visibility=_visibility(frequencies, modulations / 100.0),
        frequency=frequency,
        frequencies=frequencies,
        modulations=modulations,
        risk=_risk(*whole),
        parts_risk=_risk(frequencies, modulations),
    )


def risk_limits(frequencies: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the largest modulation in percent of no effect and of low risk at some frequencies."""
    lines = []
    for slow, fast, end in (_NO_EFFECT, _LOW_RISK):
        line = np.where(frequencies < _SLOW, slow, fast) * frequencies
        lines.append(np.where(frequencies > end, np.inf, line))
    return lines[0], lines[1]


def risk_lines() -> RiskLines:
    """Return the corners of both lines on a chart of logarithms, from 1 Hz on."""
    lines = [
        np.array([(at, rate * at) for rate, ends in ((slow, (1.0, _SLOW)), (fast, (_SLOW, end)))
                  for at in ends])
        for slow, fast, end in (_NO_EFFECT, _LOW_RISK)
    ]  # fmt: skip
    return RiskLines(*lines)


def threshold(frequencies: FloatArray) -> FloatArray:
    """Return the modulation, 0 to 1, of which half of the observers see the stroboscopic effect."""
    return np.asarray(2.865e-5 * frequencies**1.543 + 0.225)


def _visibility(frequencies: FloatArray, modulations: FloatArray) -> float:
    seen = (frequencies >= _VISIBLE[0]) & (frequencies <= _VISIBLE[1])
    ratios = modulations[seen] / threshold(frequencies[seen])
    return float((ratios**_EXPONENT).sum() ** (1.0 / _EXPONENT))


def _risk(frequencies: FloatArray, modulations: FloatArray) -> str:
    no_effect, low_risk = risk_limits(frequencies)
    if (modulations <= no_effect).all():
        return NO_EFFECT
    return LOW_RISK if (modulations <= low_risk).all() else ABOVE


def _lit_chips(scene: Scene) -> ByteArray:
    """Return the chips in which there is light: none of a lamp that is off."""
    chips = sent_chips(scene.transmitter)
    return chips if scene.transmitter.luminance else np.zeros_like(chips)


def _levels(scene: Scene) -> tuple[float, float, float]:
    """Return the least and the most light over a period, and the mean light above the mean."""
    chips = _lit_chips(scene)
    lit = float(chips.mean())
    edge = edge_in_chips(scene)
    if not edge:
        return float(chips.min()), float(chips.max()), lit * (1.0 - lit)
    # The ramps are the running mean of the chips over the edge time: as of an exposure with none.
    light = exposed_light(chips, edge, edge * 0)
    lengths, (first, _, last) = light.lengths / len(chips), light.values.T / float(edge)
    low, high = (value / float(edge) for value in light.extremes)
    over, under = np.maximum(first, last), np.minimum(first, last)
    crossing = (over > 0.0) & (under < 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(crossing, over**2 / (2.0 * (over - under)), 0.5 * (over + under))
    return lit + low, lit + high, float((lengths * np.maximum(part, 0.0)).sum())


def _sines(scene: Scene) -> tuple[FloatArray, FloatArray]:
    """Return the frequencies in Hz of the light's sines, and amplitudes in % of the mean."""
    chips = _lit_chips(scene)
    period, total = len(chips), int(chips.sum())
    base = scene.transmitter.switching_frequency / period
    count = int(min(_NO_EFFECT[2] / base, _MOST_CHIPS * period))
    order = np.arange(1, count + 1)
    of_a_chip = order / period
    sent = 2.0 * np.abs(np.fft.fft(chips))[order % period] / max(total, 1)
    ramp = np.sinc(of_a_chip * float(edge_in_chips(scene)))
    return np.asarray(order * base), 100.0 * sent * np.abs(np.sinc(of_a_chip) * ramp)
