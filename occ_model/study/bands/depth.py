"""Depth of the bars in the picture of a scene: of its light and of its pixel values."""

import math
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import ColumnLight, luminance_levels, panel_values, saturate
from occ_model.camera.sensor import saturation_value
from occ_model.effects.flicker import seen_depth
from occ_model.results.bands import BandDepth, Depth
from occ_model.scene.scene import Scene, check_scene
from occ_model.study.bands.exposed_light import ExposedLight, exposed_light
from occ_model.study.bands.visibility import contrast_threshold
from occ_model.transmitter.packet import sent_chips

_DISPLAY = 2.2
"""Exponent of the display that the picture is seen on (sRGB's, as one power)."""

_NODES = 16
"""Of the rule of Gauss over each piece of the light for the mean of the pixel values."""

_PHASES = 32
"""Of the flicker over one cycle."""

_FOUR = 4
"""Multiples of the code's frequency, in times its chips, among which the strongest is looked for:
those above are weaker than a quarter."""

_NOTHING = 1e-12
"""Depth that is rounding."""


def band_depth(scene: Scene) -> BandDepth:
    """Return how deep the bars of a scene's picture are, relative to its mean.

    Each column sees the code from another start. The depth is that over all starts, and over all
    phases of the flicker of the surroundings' light, which is not tied to the code: two pictures of
    one scene differ, and one shows less where it holds few bars. LED edges, flicker, tone curve,
    saturation and full well are counted; noise, blur and the fall of light towards the rim are not.

    The light's depth is exact: its error is below 1e-9 of itself with sharp edges, and below 1e-13
    of the mean with an LED's edges.

    Parameters
    ----------
    scene
        The scene.

    Returns
    -------
    BandDepth
        Depths of 0 where there is no light.
    """
    check_scene(scene)
    exposed = exposed_light_of(scene)
    light = light_depth(scene, exposed)
    if not luminance_levels(scene)[1]:
        return BandDepth(light, light, 0.0, math.inf, 0.0, contrast_threshold(scene, math.inf))
    frequency, period = strongest_part(scene) if light.peak_to_peak > _NOTHING else (0.0, math.inf)
    pixel, contrast = _of_pixels(scene, exposed)
    threshold = contrast_threshold(scene, period)
    return BandDepth(light, pixel, frequency, period, contrast, threshold)


def light_depth(scene: Scene, exposed: ExposedLight | None = None) -> Depth:
    """Return the depth of the light of a scene's exposure, before the tone curve.

    Extremes of the code's light and of the flicker add up, and so do their variances: all starts of
    the one meet all phases of the other.
    """
    exposed = exposed or exposed_light_of(scene)
    of_lamp, of_flicker = light_shares(scene)
    low, high = exposed.extremes
    of_lamp /= float(exposure_in_chips(scene))
    of_flicker *= seen_depth(scene)
    return Depth(
        of_lamp * (high - low) + 2.0 * of_flicker,
        math.hypot(of_lamp * math.sqrt(exposed.variance), of_flicker / math.sqrt(2.0)),
    )


def light_shares(scene: Scene) -> tuple[float, float]:
    """Return the light of the lit lamp and of the surroundings, relative to the mean of both."""
    dark, bright = (float(each) for each in luminance_levels(scene))
    mean = dark + (bright - dark) * duty(scene)
    return ((bright - dark) / mean, dark / mean) if mean else (0.0, 0.0)


def exposure_in_chips(scene: Scene) -> Fraction:
    """Return the exposure time in chips, exactly."""
    return Fraction(scene.camera.exposure_time) * Fraction(scene.transmitter.switching_frequency)


def edge_in_chips(scene: Scene) -> Fraction:
    """Return the LED's rise time in chips, exactly."""
    return Fraction(scene.transmitter.edge_time) * Fraction(scene.transmitter.switching_frequency)


def duty(scene: Scene) -> float:
    """Return the share of the time in which the lamp is lit."""
    return float(sent_chips(scene.transmitter).mean())


def exposed_light_of(scene: Scene) -> ExposedLight:
    """Return the light of a scene's exposure less its mean, over all starts."""
    chips = sent_chips(scene.transmitter)
    return exposed_light(chips, exposure_in_chips(scene), edge_in_chips(scene))


def _of_pixels(scene: Scene, exposed: ExposedLight) -> tuple[Depth, float]:
    """Return the depth of the pixel values, and that of the display's light, peak to peak."""
    chips, lit = float(exposure_in_chips(scene)), duty(scene)
    full = saturation_value(scene)

    def values(above_mean: FloatArray, cycle: FloatArray) -> FloatArray:
        share = np.clip(lit + above_mean / chips, 0.0, 1.0)
        ambient = 1.0 + seen_depth(scene) * np.cos(cycle)[:, None]
        return np.minimum(saturate(panel_values(scene, ColumnLight(share, ambient))), full)

    of_light, weights = exposed.sampled(_NODES)
    phases = _PHASES if seen_depth(scene) else 1
    cycle = 2.0 * math.pi * (np.arange(phases) + 0.5) / phases
    sampled = values(of_light.ravel(), cycle)
    each = weights.ravel() / phases
    mean = float((sampled * each).sum())
    spread = math.sqrt(float(((sampled - mean) ** 2 * each).sum()))
    ends = values(np.array(exposed.extremes), np.array([math.pi, 0.0]))
    low, high = float(ends[0, 0]), float(ends[1, 1])
    shown = (high**_DISPLAY - low**_DISPLAY) / mean**_DISPLAY
    return Depth((high - low) / mean, spread / mean), shown


def strongest_part(scene: Scene) -> tuple[float, float]:
    """Return the frequency in Hz of the strongest part of the light, and its bars in columns.

    Among the harmonics of the code and the flicker. The columns sample them: what is faster than
    half their rate shows bars of another period, of a frequency that is too low.
    """
    chips = sent_chips(scene.transmitter)
    dark, bright = (float(each) for each in luminance_levels(scene))
    period = len(chips)
    cycles = np.arange(1, _FOUR * period + 1)  # of the harmonics, in one period of the code
    of_a_chip = cycles / period
    exposure = exposure_in_chips(scene)
    amplitudes = 2.0 * (bright - dark) * np.abs(np.fft.fft(chips))[cycles % period] / period
    amplitudes *= np.abs(np.sinc(of_a_chip) * np.sinc(of_a_chip * float(edge_in_chips(scene))))
    # |sinc| of the exposure, from which whole periods are subtracted before the sine.
    amplitudes *= np.abs(np.sin(np.pi * of_a_chip * float(exposure % period)))
    amplitudes /= np.pi * of_a_chip * float(exposure)
    best = int(amplitudes.argmax())
    base = Fraction(scene.transmitter.switching_frequency) / period
    frequency = base * int(cycles[best])
    if dark * seen_depth(scene) > amplitudes[best]:
        frequency = Fraction(scene.surroundings.flicker_frequency)
    step = frequency * Fraction(scene.camera.readout_time)
    seen = abs(float(step - round(step)))
    return float(frequency), 1.0 / seen if seen else math.inf
