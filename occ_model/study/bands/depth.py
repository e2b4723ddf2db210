"""Depth of the bars in a scene's picture, in its light and its pixels, and what of it is seen."""

import math
from dataclasses import replace
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
from occ_model.effects.effect import LightEffect
from occ_model.effects.light_effects import depth_in_exposure
from occ_model.effects.registry import NAMES, effects_named
from occ_model.errors import ParameterError, shown
from occ_model.results.bands import ROUNDING_DEPTH, BandDepth, Depth
from occ_model.scene.scene import Scene
from occ_model.study.bands.exposed_light import ExposedLight, exposed_light
from occ_model.transmitter.scheme import sent_chips

_DISPLAY_EXPONENT = 2.2  # approximates sRGB by one power
_BLACK = 0.5  # grey levels that a file rounds to 0
_NO_DEPTH = Depth(0.0, 0.0)

_HARMONICS_PER_CHIP = 4  # harmonics of the code that are searched; higher ones are below a quarter
_ROUNDING_LIGHT = 1e-12  # part of a column's exposure that is lit by rounding errors
_PADDING = 4  # times that a spectrum is finer than its columns tell apart
_WINDOW_BINS = 0.75  # of unpadded columns, within which a sine lies from its peak


def band_depth(scene: Scene) -> BandDepth:
    """Return the depth of the bars of a scene's light, and what of it the scene's picture shows.

    The depth of the light is taken over all starts of an exposure within the code, and over all
    phases of the ambient flicker, which is not synchronous with the code. Its relative error is
    below 1e-9 with sharp edges; with LED edges it is below 1e-13 of the mean. The picture's columns
    are those of the scene: they start where its readout time and start time put them. LED edges,
    flicker, tone curve, saturation and full well are included; noise, blur and vignetting are not.

    Returns
    -------
    BandDepth
        Depths of 0 where there is no light.
    """
    exposed = exposed_light_of(scene)
    light = light_depth(scene, exposed)
    columns = _column_light(scene)
    dark, bright = luminance_levels(scene)
    of_columns = dark * columns.ambient + (bright - dark) * columns.lit
    frequency, period = 0.0, math.inf
    if _depth(of_columns).peak_to_peak > ROUNDING_DEPTH:
        frequency, period = _strongest_part(scene, of_columns)
    values = panel_values(scene, columns)
    pixels = np.minimum(saturate(values), saturation_value(scene))
    found = BandDepth(
        light=light,
        columns=_depth(of_columns),
        pixel=_depth(pixels),
        frequency=frequency,
        period=period,
        contrast=_contrast(pixels),
        threshold=contrast_threshold(scene, period),
    )
    return replace(found, hidden=_what_hides(found, pixels, values, _extremes(scene, exposed)))


def _what_hides(
    found: BandDepth, pixels: FloatArray, values: FloatArray, extremes: FloatArray
) -> str:
    """Return why the picture does not show the light's bars, as a clause; empty if it does.

    ``values`` are those of the columns before saturation, ``extremes`` those over all starts.
    """
    if float(pixels.max()) < _BLACK:
        return "the picture is black"
    if found.is_visible:
        return ""
    if _contrast(values) > found.threshold:
        return "the picture is overexposed"
    sees_part = found.columns.peak_to_peak < 0.5 * found.light.peak_to_peak
    if sees_part and _contrast(extremes) > found.threshold:
        return "the picture's columns all start at like places of the light's period"
    return ""


def _column_light(scene: Scene) -> ColumnLight:
    light = ColumnLight.of(scene)
    for effect in effects_named(NAMES, LightEffect):
        light = effect.apply(scene, light)
    # Of a dark column rounding would otherwise leave some light, and bars of it.
    return replace(light, lit=np.where(light.lit > _ROUNDING_LIGHT, light.lit, 0.0))


def _extremes(scene: Scene, exposed: ExposedLight) -> FloatArray:
    """Return the least and the largest pixel value over all starts, before saturation."""
    lit = duty(scene) + np.array(exposed.extremes) / float(exposure_in_chips(scene))
    ambient = 1.0 + depth_in_exposure(scene) * np.array([-1.0, 1.0])
    return panel_values(scene, ColumnLight(np.clip(lit, 0.0, 1.0), ambient))


def _depth(values: FloatArray) -> Depth:
    mean = float(values.mean())
    return Depth(float(np.ptp(values)) / mean, float(values.std()) / mean) if mean else _NO_DEPTH


def _contrast(values: FloatArray) -> float:
    """Return the depth, peak to peak, of what a display shows of pixel values."""
    return _depth(values**_DISPLAY_EXPONENT).peak_to_peak


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


def _strongest_part(scene: Scene, light: FloatArray) -> tuple[float, float]:
    """Return the frequency in Hz of the strongest part of the columns' light, and its period.

    The period is in columns, as these sample the light: above half the row rate, an alias. The
    columns' spectrum says near which period they vary most, and of the code's harmonics and the
    flicker the strongest near it is the exact one.
    """
    count = len(light)
    spectrum = np.abs(np.fft.rfft((light - light.mean()) * np.hanning(count), _PADDING * count))
    peak = int(spectrum.argmax()) / (_PADDING * count)
    frequencies, steps, amplitudes = _parts(scene)
    near = np.abs(np.abs(steps) - peak) < _WINDOW_BINS / count
    best = int(np.where(near, amplitudes * _swing_of_columns(steps, count), 0.0).argmax())
    step = abs(float(steps[best]))
    return float(frequencies[best]), 1.0 / step if step else math.inf


def _parts(scene: Scene) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the sines of an exposure's light: frequencies in Hz, cycles a column, amplitudes.

    Those of the code, and the flicker. Of the cycles from one column's start to the next whole ones
    are left out.
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
    base = Fraction(scene.transmitter.switching_frequency) / period
    flicker = Fraction(scene.surroundings.flicker_frequency)
    steps = np.append(_step(scene, base) * cycles, _step(scene, flicker))
    return (
        np.append(float(base) * cycles, float(flicker)),
        steps - np.round(steps),
        np.append(amplitudes, dark * depth_in_exposure(scene)),
    )


def _step(scene: Scene, frequency: Fraction) -> float:
    """Return the cycles from one column's start to the next, less whole ones."""
    step = frequency * Fraction(scene.camera.readout_time)
    return float(step - round(step))


def _swing_of_columns(steps: FloatArray, columns: int) -> FloatArray:
    """Return the deviation of a sine's samples from their mean, relative to the sine's own.

    It is that of the root mean square over all phases, sqrt(1 - D^2), where N samples in steps of s
    cycles have the mean D = sin(pi N s) / (N sin(pi s)).
    """
    mean = np.sinc(columns * steps) / np.sinc(steps)
    return np.sqrt(np.maximum(1.0 - mean * mean, 0.0))


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
