"""The levels of a lamp's columns by its wave, envelope, floor and the camera's processing."""

import math
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.lamp_fit.profile import LampProfile
from occ_model.photo.lamp_fit.tone import PowerTone
from occ_model.photo.lamp_fit.wave import Wave

PERIOD, PLACE, WIDTH, RAMP, BLUR, FLOOR, AMBIENT, GAMMA, TOE, BEND, NEAR, FAR = range(12)
"""Places of the parameters: logarithms of the period, blur, gamma and toe, logits of width and
ramp, and the floor by a hyperbolic sine, so that it may be large and of either sign. NEAR and FAR
are the parts of each level that go to the columns beside it and to the next ones: cameras blur and
sharpen levels, not only light."""

COUNT = 12  # parameters before those of the envelope

_FLOOR_SCALE = 0.05

# Mean and standard deviation of each parameter's prior: tone curves of cameras are near sRGB's or a
# power of 2.2, and processing blurs by about half a column.
_PRIORS = {
    WIDTH: (0.0, 3.0),
    RAMP: (0.0, 3.0),
    BLUR: (math.log(0.4), 0.35),
    FLOOR: (0.0, 2.5),
    AMBIENT: (0.0, 0.01),
    GAMMA: (math.log(2.2), 0.18),
    TOE: (math.log(0.002), 1.2),
    BEND: (0.0, 0.2),
    NEAR: (0.0, 0.1),
    FAR: (0.0, 0.04),
}
_LINEAR = {GAMMA: (0.0, 1e-3), TOE: (math.log(0.002), 1e-2), BEND: (0.0, 1e-3)}

_LARGEST_LOG = 25.0  # of an envelope's brightness, so that it stays finite

ENDS = {
    WIDTH: (-4.5, 4.5), RAMP: (-6.0, 6.0), BLUR: (-3.0, 2.0), FLOOR: (-7.5, 7.5),
    GAMMA: (-0.5, 3.0), NEAR: (-0.3, 0.3), FAR: (-0.1, 0.1),
}  # fmt: skip
"""Least and largest values; a smaller gamma would make levels of white columns infinite."""

MOST_STEPS = np.array([0.1, 0.25, 1.0, 1.0, 0.7, 1.5, 0.05, 0.3, 1.0, 0.3, 0.1, 0.05])
"""Largest steps of the parameters; that of the place is in periods."""


@dataclass(frozen=True, eq=False)
class LampModel:
    """The model of a profile's levels, as fractions of white."""

    profile: LampProfile  # Of n columns
    envelope: FloatArray  # Shape (n, knots): the spline's values
    bending: FloatArray  # Shape (knots - 2, knots): of its coefficients, in standard deviations
    is_linear: bool  # Whether levels are in proportion to the light

    @property
    def priors(self) -> dict[int, tuple[float, float]]:
        return {**_PRIORS, **_LINEAR} if self.is_linear else _PRIORS

    def wave(self, values: FloatArray) -> Wave:
        width, ramp = (1.0 / (1.0 + math.exp(-values[each])) for each in (WIDTH, RAMP))
        return Wave(math.exp(values[PERIOD]), values[PLACE], width, ramp, math.exp(values[BLUR]))

    def floor(self, values: FloatArray) -> float:
        """Return the light between the pulses, as a fraction of their height."""
        return _FLOOR_SCALE * math.sinh(values[FLOOR])

    def tone(self, values: FloatArray) -> PowerTone:
        return PowerTone(math.exp(values[GAMMA]), math.exp(values[TOE]), values[BEND])

    def unusual_tone(self, values: FloatArray) -> float:
        """Return how far the tone curve is from its prior's mean, in standard deviations."""
        believed = {each: self.priors[each] for each in (GAMMA, TOE, BEND)}
        return math.hypot(*((values[at] - mean) / off for at, (mean, off) in believed.items()))

    def levels(self, values: FloatArray) -> FloatArray:
        light = self._light(values, self.wave(values).values(self.profile.columns))[0]
        return self._process(values, self.tone(values).levels(light))

    def ends(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the levels where the wave is 0 and where it is 1."""
        tone, size = self.tone(values), len(self.profile.columns)
        dark, lit = (
            tone.levels(self._light(values, np.full(size, wave))[0]) for wave in (0.0, 1.0)
        )
        return dark, lit

    def slopes(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the levels and their slopes, shapes (n,) and (n, parameters)."""
        wave, by_wave = self.wave(values).slopes(self.profile.columns)
        light, brightness, scale = self._light(values, wave)
        tone = self.tone(values)
        levels = tone.levels(light)
        by_light, by_tone = tone.slopes(light)
        floor, steep = self.floor(values), _FLOOR_SCALE * math.cosh(values[FLOOR])
        by_floor = brightness * (scale - math.copysign(scale * scale, floor) * (wave + floor))
        by_envelope = by_light * (light - values[AMBIENT])
        slopes = np.concatenate([
            by_light * brightness * scale * by_wave,
            (by_light * by_floor * steep)[None],
            by_light[None],
            by_tone,
            _mix(levels, -2.0, 1.0, 0.0)[None],
            _mix(levels, -2.0, 0.0, 1.0)[None],
            by_envelope * self.envelope.T,
        ])  # fmt: skip
        before = [*range(NEAR), *range(COUNT, len(slopes))]
        slopes[before] = self._process(values, slopes[before])
        return self._process(values, levels), slopes.T

    def _process(self, values: FloatArray, levels: FloatArray) -> FloatArray:
        near, far = values[NEAR], values[FAR]
        return _mix(levels, 1.0 - 2.0 * (near + far), near, far)

    def _light(self, values: FloatArray, wave: FloatArray) -> tuple[FloatArray, FloatArray, float]:
        log = np.clip(self.envelope @ values[COUNT:], -_LARGEST_LOG, _LARGEST_LOG)
        brightness, floor = np.exp(log), self.floor(values)
        scale = 1.0 / (1.0 + abs(floor))
        return brightness * (wave + floor) * scale + values[AMBIENT], brightness, scale

    def weighted_residual(self, values: FloatArray, noise: FloatArray) -> FloatArray:
        """Return the levels less the profile, and then the beliefs, in standard deviations."""
        excess = self.profile.excess(self.levels(values)) / noise
        return np.concatenate([excess, self.beliefs(values)[0]])

    def weighted_slopes(self, values: FloatArray, noise: FloatArray) -> FloatArray:
        """Return the slopes of the weighted residual over the parameters."""
        levels, slopes = self.slopes(values)
        slopes = slopes / noise[:, None]
        slopes[self.profile.clipped & (self.profile.excess(levels) == 0.0)] = 0.0
        return np.concatenate([slopes, self.beliefs(values)[1]])

    def beliefs(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return how far parameters are from their priors, in standard deviations, and slopes."""
        means, slopes = self._linear_beliefs
        return slopes @ values - means, slopes

    @cached_property
    def _linear_beliefs(self) -> tuple[FloatArray, FloatArray]:
        places = list(self.priors)
        means, deviations = np.array(list(self.priors.values())).T
        bends, splines = self.bending.shape
        slopes = np.zeros((len(places) + bends, COUNT + splines))
        slopes[np.arange(len(places)), places] = 1.0 / deviations
        slopes[len(places) :, COUNT:] = self.bending
        return np.concatenate([means / deviations, np.zeros(bends)]), slopes


def _mix(levels: FloatArray, own: float, near: float, far: float) -> FloatArray:
    """Mix each column with the two on either side; beyond the ends the outermost level goes on.

    The last axis of ``levels`` counts the columns; the result has the same shape.
    """
    kernel = np.array([[far, near, own, near, far]])
    rows = levels.reshape(-1, levels.shape[-1])
    mixed = cv2.filter2D(rows, -1, kernel, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(mixed, dtype=np.float64).reshape(levels.shape)


def envelope_basis(count: int, knots: int) -> FloatArray:
    """Return the values of cubic B-splines over evenly spaced columns, shape (count, splines).

    By the recursion of Cox and de Boor: SciPy's takes 0.2 s to import.
    """
    ends = np.concatenate([np.zeros(3), np.linspace(0.0, 1.0, knots + 1), np.ones(3)])
    places = np.linspace(0.0, 1.0, count)[:, None]
    last = places == 1.0  # belongs to the last interval, whose end is else excluded
    within = (ends[:-1] <= places) & ((places < ends[1:]) | (last & (ends[1:] == 1.0)))
    splines = (within & (ends[:-1] < ends[1:])).astype(np.float64)
    for degree in (1, 2, 3):
        spans = ends[degree:] - ends[:-degree]
        parts = splines / np.where(spans > 0.0, spans, 1.0)
        rising = (places - ends[: -degree - 1]) * parts[:, :-1]
        falling = (ends[degree + 1 :] - places) * parts[:, 1:]
        splines = rising + falling
    return np.asarray(splines, dtype=np.float64)
