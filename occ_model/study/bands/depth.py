"""Depth of the bars in a scene's picture, in its light and its pixels, and what of it is seen."""

import math
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import (
    ColumnLight,
    luminance_levels,
    panel_values,
    saturate,
    saturation_value,
)
from occ_model.effects.light_effects import depth_in_exposure
from occ_model.errors import ParameterError, shown
from occ_model.results.bands import BandDepth, Depth
from occ_model.scene.scene import Scene
from occ_model.study.bands.exposed_light import ExposedLight, exposed_light
from occ_model.transmitter.packet import sent_chips

_DISPLAY_EXPONENT = 2.2  # approximates sRGB by one power
_NODES = 16  # Gauss-Legendre nodes in each piece of the light, for the mean of the pixel values
_FLICKER_PHASES = 32

_HARMONICS_PER_CHIP = 4  # harmonics of the code that are searched; higher ones are below a quarter
_ROUNDING_DEPTH = 1e-12


def band_depth(scene: Scene) -> BandDepth:
    """Return the depth of the bars in a scene's picture, relative to its mean.

    Each column sees the code from another start. The depth is taken over all starts and over all
    phases of the ambient flicker, which is not synchronous with the code; a single picture with few
    bars shows less. LED edges, flicker, tone curve, saturation and full well are included; noise,
    blur and vignetting are not. The relative error of the light's depth is below 1e-9 with sharp
    edges; with LED edges it is below 1e-13 of the mean.

    Returns
    -------
    BandDepth
        Depths of 0 where there is no light.
    """
    exposed = exposed_light_of(scene)
    light = light_depth(scene, exposed)
    if not luminance_levels(scene)[1]:
        return BandDepth(light, light, 0.0, math.inf, 0.0, contrast_threshold(scene, math.inf))
    frequency, period = (
        strongest_part(scene) if light.peak_to_peak > _ROUNDING_DEPTH else (0.0, math.inf)
    )
    pixel, contrast = _of_pixels(scene, exposed)
    threshold = contrast_threshold(scene, period)
    return BandDepth(light, pixel, frequency, period, contrast, threshold)


def light_depth(scene: Scene, exposed: ExposedLight | None = None) -> Depth:
    """Return the depth of the light of a scene's exposure, before the tone curve.

    Extremes and variances of the code's light and of the flicker add, as all phases combine.
    """
    exposed = exposed or exposed_light_of(scene)
    of_lamp, of_flicker = light_fractions(scene)
    low, high = exposed.extremes
    of_lamp /= float(exposure_in_chips(scene))
    of_flicker *= depth_in_exposure(scene)
    return Depth(
        of_lamp * (high - low) + 2.0 * of_flicker,
        math.hypot(of_lamp * math.sqrt(exposed.variance), of_flicker / math.sqrt(2.0)),
    )


def light_fractions(scene: Scene) -> tuple[float, float]:
    """Return the light of the lit lamp and of the surroundings, relative to the mean of both."""
    dark, bright = (float(each) for each in luminance_levels(scene))
    mean = dark + (bright - dark) * duty(scene)
    return ((bright - dark) / mean, dark / mean) if mean else (0.0, 0.0)


def exposure_in_chips(scene: Scene) -> Fraction:
    return Fraction(scene.camera.exposure_time) * Fraction(scene.transmitter.switching_frequency)


def edge_in_chips(scene: Scene) -> Fraction:
    """Return the LED's rise time in chips, exactly."""
    return Fraction(scene.transmitter.edge_time) * Fraction(scene.transmitter.switching_frequency)


def duty(scene: Scene) -> float:
    """Return the fraction of the time in which the lamp is lit."""
    return float(sent_chips(scene.transmitter).mean())


def exposed_light_of(scene: Scene) -> ExposedLight:
    """Return the light of a scene's exposure minus its mean, over all starts."""
    chips = sent_chips(scene.transmitter)
    return exposed_light(chips, exposure_in_chips(scene), edge_in_chips(scene))


def _of_pixels(scene: Scene, exposed: ExposedLight) -> tuple[Depth, float]:
    """Return the depth of the pixel values, and the peak-to-peak contrast on the display."""
    chips, lit = float(exposure_in_chips(scene)), duty(scene)
    full = saturation_value(scene)

    def values(above_mean: FloatArray, cycle: FloatArray) -> FloatArray:
        fraction = np.clip(lit + above_mean / chips, 0.0, 1.0)
        ambient = 1.0 + depth_in_exposure(scene) * np.cos(cycle)[:, None]
        return np.minimum(saturate(panel_values(scene, ColumnLight(fraction, ambient))), full)

    of_light, weights = exposed.sampled(_NODES)
    phases = _FLICKER_PHASES if depth_in_exposure(scene) else 1
    cycle = 2.0 * math.pi * (np.arange(phases) + 0.5) / phases
    sampled = values(of_light.ravel(), cycle)
    each = weights.ravel() / phases
    mean = float((sampled * each).sum())
    spread = math.sqrt(float(((sampled - mean) ** 2 * each).sum()))
    ends = values(np.array(exposed.extremes), np.array([math.pi, 0.0]))
    low, high = float(ends[0, 0]), float(ends[1, 1])
    shown = (high**_DISPLAY_EXPONENT - low**_DISPLAY_EXPONENT) / mean**_DISPLAY_EXPONENT
    return Depth((high - low) / mean, spread / mean), shown


def strongest_part(scene: Scene) -> tuple[float, float]:
    """Return the frequency in Hz of the strongest component, and the period of its bars in columns.

    Components are the code's harmonics and the flicker; above half the row rate, aliases.
    """
    chips = sent_chips(scene.transmitter)
    dark, bright = (float(each) for each in luminance_levels(scene))
    period = len(chips)
    cycles = np.arange(1, _HARMONICS_PER_CHIP * period + 1)
    of_a_chip = cycles / period
    exposure = exposure_in_chips(scene)
    amplitudes = 2.0 * (bright - dark) * np.abs(np.fft.fft(chips))[cycles % period] / period
    amplitudes *= np.abs(np.sinc(of_a_chip) * np.sinc(of_a_chip * float(edge_in_chips(scene))))
    # |sinc| of the exposure; whole periods are subtracted before the sine.
    amplitudes *= np.abs(np.sin(np.pi * of_a_chip * float(exposure % period)))
    amplitudes /= np.pi * of_a_chip * float(exposure)
    best = int(amplitudes.argmax())
    base = Fraction(scene.transmitter.switching_frequency) / period
    frequency = base * int(cycles[best])
    if dark * depth_in_exposure(scene) > amplitudes[best]:
        frequency = Fraction(scene.surroundings.flicker_frequency)
    step = frequency * Fraction(scene.camera.readout_time)
    seen = abs(float(step - round(step)))
    return float(frequency), 1.0 / seen if seen else math.inf


_WEBER_FRACTION = 0.01
"""Smallest visible relative difference of luminance. Values from 0.5 to 2 % are in use (C. Poynton,
Digital Video and HD, 2012)."""

_VIEWING_ANGLE = 40.0  # degrees that the picture's scan axis spans for the viewer
_PEAK_FREQUENCY = 7.89  # cycles per degree of the maximum of the sensitivity curve below


def contrast_threshold(scene: Scene, period: float) -> float:
    """Return the contrast, peak to peak over the mean, from which bars of a period are visible.

    1 % at the peak of the eye's sensitivity and for wider bars, as these have edges; finer bars
    follow the sensitivity of J. L. Mannos and D. J. Sakrison, The effects of a visual fidelity
    criterion on the encoding of images, IEEE Trans. Inf. Theory 20 (1974) 525. It is a rule of
    thumb, within a factor of two: noise, texture and motion hide bars.
    """
    cycles = scene.camera.columns / _VIEWING_ANGLE / period
    relative = _sensitivity(max(cycles, _PEAK_FREQUENCY)) / _sensitivity(_PEAK_FREQUENCY)
    return _WEBER_FRACTION / relative if relative else math.inf


def _sensitivity(cycles: float) -> float:
    """Return the eye's sensitivity to a sine, up to a factor; in cycles per degree."""
    scaled = 0.114 * cycles
    return (0.0192 + scaled) * math.exp(-(scaled**1.1))


def pulse_depth(duty: float, periods: float | Fraction) -> Depth:
    """Return the depth of the bars of a lamp with pulse-width modulation.

    Of an exposure of a = n + r periods the n whole ones hold the same light for any start.
    The light of the rest varies by h = min(r, 1 - r, D, 1 - D) periods: a trapezoid over the start,
    h / (a D) peak to peak relative to the mean. With M = max(min(r, 1 - r), min(D, 1 - D)) its root
    mean square is sqrt(h^2 (M (1 - M) - h / 3)) / (a D).

    Parameters
    ----------
    duty
        Fraction D of a period in which the lamp is lit, above 0 and at most 1.
    periods
        Length a of the exposure in periods, above 0, exact as a fraction.

    Raises
    ------
    ParameterError
        An argument is out of range.
    """
    if not 0.0 < duty <= 1.0:
        raise ParameterError.of("duty", shown(duty), "above 0, up to 1")
    if not 0.0 < periods < math.inf:
        raise ParameterError.of("periods", shown(periods), "above 0")
    exact, lit = Fraction(periods), Fraction(duty)
    rest = exact % 1
    short = sorted([min(rest, 1 - rest), min(lit, 1 - lit)])
    height, longer = short
    mean = exact * lit
    spread = longer * (1 - longer) - height / 3
    return Depth(float(height / mean), float(height / mean) * math.sqrt(spread))
