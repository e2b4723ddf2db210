"""Depth of the bars in a scene's light, in its picture and its pixels, and whether they show."""

import cmath
import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

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
from occ_model.errors import ParameterError, quote
from occ_model.light.cosine import Cosine
from occ_model.light.sent import PiecewiseLight, flicker_of, light_of
from occ_model.results.bands import ROUNDING_DEPTH, BandDepth, Depth
from occ_model.scene.scene import Scene, Transmitter
from occ_model.study.bands.exposed_light import ExposedLight, exposed_light
from occ_model.study.bands.sines import sines_of

_DISPLAY_EXPONENT = 2.2  # approximates sRGB by one power
_BLACK = 0.5  # grey levels that a file rounds to 0
_NO_DEPTH = Depth(0.0, 0.0)

_SINES_PER_PIECE = 4  # sines of the light that are searched; higher ones are below a quarter
_ROUNDING_LIGHT = 1e-12  # part of a column's exposure that is lit by rounding errors
_PADDING = 4  # length of the zero-padded spectrum, divided by the number of columns
_WINDOW_BINS = 0.75  # largest distance of a sine from its peak, in bins without padding


def band_depth(scene: Scene) -> BandDepth:
    """Return the depth of the bars of a scene's light, and of the bars in its picture.

    The depth of the light covers all starts of an exposure within the light's period, and all
    phases of the ambient flicker, which is not synchronous with it. Its relative error is
    below 1e-9 with sharp edges; with LED edges it is below 1e-13 of the mean. The picture's columns
    are those of the scene: they start where its readout time and start time put them. LED edges,
    flicker, tone curve, saturation and full well are included; noise, blur and vignetting are not.

    Returns
    -------
    BandDepth
        Depths of 0 where there is no light.
    """
    columns = _column_light(scene)
    dark, bright = luminance_levels(scene)
    light = dark * columns.ambient + (bright - dark) * columns.lit
    frequency, period = 0.0, math.inf
    if _depth(light).peak_to_peak > ROUNDING_DEPTH:
        frequency, period = _find_strongest_sine(scene, light)
    values = panel_values(scene, columns)
    pixels = np.minimum(saturate(values), saturation_value(scene))
    depth = BandDepth(
        light=light_depth(scene),
        columns=_depth(light),
        pixel=_depth(pixels),
        frequency=frequency,
        period=period,
        contrast=_contrast(pixels),
        threshold=contrast_threshold(scene, period),
    )
    return replace(depth, hidden=_explain_invisible_bars(depth, pixels, values, _extremes(scene)))


def _explain_invisible_bars(
    depth: BandDepth, pixels: FloatArray, values: FloatArray, extremes: FloatArray
) -> str:
    """Return why the picture does not show the light's bars, as a clause; empty if it does.

    ``values`` are those of the columns before saturation, ``extremes`` those over all starts.
    """
    if float(pixels.max()) < _BLACK:
        return "the picture is black"
    if depth.is_visible:
        return ""
    if _contrast(values) > depth.threshold:
        return "the picture is overexposed"
    is_reduced = depth.columns.peak_to_peak < 0.5 * depth.light.peak_to_peak
    if is_reduced and _contrast(extremes) > depth.threshold:
        return "the picture's columns all start at the same phase of the light"
    return ""


def _column_light(scene: Scene) -> ColumnLight:
    light = ColumnLight.of(scene)
    for effect in effects_named(NAMES, LightEffect):
        light = effect.apply(scene, light)
    # Rounding errors would otherwise leave some light, and bars, in dark columns.
    return replace(light, lit=np.where(light.lit > _ROUNDING_LIGHT, light.lit, 0.0))


def _depth(values: FloatArray) -> Depth:
    mean = float(values.mean())
    return Depth(float(np.ptp(values)) / mean, float(values.std()) / mean) if mean else _NO_DEPTH


def _contrast(values: FloatArray) -> float:
    """Return the depth, peak to peak, of what a display shows of pixel values."""
    return _depth(values**_DISPLAY_EXPONENT).peak_to_peak


def light_depth(scene: Scene) -> Depth:
    """Return the depth of the light of a scene's exposure, before the tone curve.

    The extremes and variances of the panel's light and of the flicker add, because all their phases
    occur together; a lamp on the mains is in phase with the flicker, except for its LED's edges.
    """
    lamp, flicker = light_fractions(scene)
    light = light_of(scene.transmitter)
    if isinstance(light, Cosine):
        amplitude = float(abs(_phasors(scene, light) @ [lamp, flicker]))
        return Depth(2.0 * amplitude, amplitude / math.sqrt(2.0))
    exposed, units = _light_of_exposure(scene, light)
    low, high = exposed.extremes
    lamp /= units
    flicker *= depth_in_exposure(scene)
    return Depth(
        lamp * (high - low) + 2.0 * flicker,
        math.hypot(lamp * math.sqrt(exposed.variance), flicker / math.sqrt(2.0)),
    )


def _phasors(scene: Scene, light: Cosine) -> NDArray[np.complex128]:
    """Return the complex amplitudes of a lamp on the mains and of the flicker, over their means."""
    swing = light.depth * light.response(Fraction(scene.camera.exposure_time))
    edge = Fraction(scene.transmitter.edge_time)
    delay = cmath.exp(-1j * math.pi * float(Fraction(light.frequency) * edge % 2))
    return np.array([swing * light.response(edge) * delay, complex(swing)])


def _light_of_exposure(scene: Scene, light: PiecewiseLight) -> tuple[ExposedLight, float]:
    """Return the light of the scene's exposure, and the exposure in the waveform's units."""
    units = Fraction(scene.camera.exposure_time) * light.rate
    edge = Fraction(scene.transmitter.edge_time) * light.rate
    return exposed_light(light.waveform, units, edge), float(units)


def _extremes(scene: Scene) -> FloatArray:
    """Return the smallest and the largest pixel value over all starts, before saturation."""
    light, ends = light_of(scene.transmitter), np.array([-1.0, 1.0])
    if isinstance(light, Cosine):
        phasors = _phasors(scene, light)
        total = phasors @ np.array(light_fractions(scene))
        in_phase = (phasors * np.conj(total)).real / (abs(total) or 1.0)
        return panel_values(scene, ColumnLight(*(1.0 + part * ends for part in in_phase)))
    exposed, units = _light_of_exposure(scene, light)
    lit = light.mean + np.array(exposed.extremes) / units
    ambient = 1.0 + depth_in_exposure(scene) * ends
    return panel_values(scene, ColumnLight(np.clip(lit, 0.0, 1.0), ambient))


def light_fractions(scene: Scene) -> tuple[float, float]:
    """Return the light of the lit lamp and of the surroundings, relative to the mean of both."""
    dark, bright = (float(each) for each in luminance_levels(scene))
    mean = dark + (bright - dark) * mean_light(scene.transmitter)
    return ((bright - dark) / mean, dark / mean) if mean else (0.0, 0.0)


def mean_light(transmitter: Transmitter) -> float:
    """Return the mean light of a lamp, 1 being the panel fully lit."""
    return light_of(transmitter).mean


def _find_strongest_sine(scene: Scene, light: FloatArray) -> tuple[float, float]:
    """Return the frequency in Hz and the period of the strongest sine of the columns' light.

    The period is in columns, as these sample the light; for frequencies above half the row rate it
    is that of an alias. The peak of the columns' spectrum gives it approximately; of the sines of
    the light and the flicker near this peak, the strongest gives it exactly.
    """
    count = len(light)
    spectrum = np.abs(np.fft.rfft((light - light.mean()) * np.hanning(count), _PADDING * count))
    peak = int(spectrum.argmax()) / (_PADDING * count)
    frequencies, steps, amplitudes = _list_sines(scene)
    near = np.abs(np.abs(steps) - peak) < _WINDOW_BINS / count
    best = int(np.where(near, amplitudes * _deviation_of_columns(steps, count), 0.0).argmax())
    step = abs(float(steps[best]))
    return float(frequencies[best]), 1.0 / step if step else math.inf


def _list_sines(scene: Scene) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the sines of an exposure's light: frequencies in Hz, cycles a column, amplitudes.

    They are the panel's sines and, last, the flicker. Whole cycles a column are subtracted.
    """
    dark, bright = (float(each) for each in luminance_levels(scene))
    sines, flicker = sines_of(scene.transmitter, _SINES_PER_PIECE), flicker_of(scene).frequency
    amplitudes = (bright - dark) * sines.in_exposure(Fraction(scene.camera.exposure_time))
    steps = np.append(
        _cycles_per_column(scene, sines.base) * sines.orders,
        _cycles_per_column(scene, Fraction(flicker)),
    )
    return (
        np.append(sines.frequencies, flicker),
        steps - np.round(steps),
        np.append(amplitudes, dark * depth_in_exposure(scene)),
    )


def _cycles_per_column(scene: Scene, frequency: Fraction) -> float:
    """Return the cycles from one column's start to the next, minus whole ones."""
    step = frequency * Fraction(scene.camera.readout_time)
    return float(step - round(step))


def _deviation_of_columns(steps: FloatArray, columns: int) -> FloatArray:
    """Return the standard deviation of a sine's samples, relative to that of the whole sine.

    Its root mean square over all phases is sqrt(1 - D^2), where N samples in steps of s cycles have
    the mean D = sin(pi N s) / (N sin(pi s)).
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

    In an exposure of a = n + r periods the n whole ones contain the same light for any start. The
    light of the remainder varies by h = min(r, 1 - r, D, 1 - D) periods: a trapezoid over the
    start, h / (a D) peak to peak relative to the mean. With M = max(min(r, 1 - r), min(D, 1 - D))
    its root mean square is sqrt(h^2 (M (1 - M) - h / 3)) / (a D).

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
        raise ParameterError.of("duty", quote(duty), "above 0, up to 1")
    if not 0.0 < periods < math.inf:
        raise ParameterError.of("periods", quote(periods), "above 0")
    exact, lit = Fraction(periods), Fraction(duty)
    rest = exact % 1
    height, longer = sorted([min(rest, 1 - rest), min(lit, 1 - lit)])
    mean = exact * lit
    spread = longer * (1 - longer) - height / 3
    return Depth(float(height / mean), float(height / mean) * math.sqrt(spread))
