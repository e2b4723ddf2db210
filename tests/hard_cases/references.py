"""References for the laws: exact arithmetic, and strategies with wide ranges."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import mpmath
import numpy as np
from hypothesis import strategies as st

import occ_model as occ
from occ_model.camera.projection import rotation_of
from occ_model.scene.parameter_kinds import Count, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Camera, Scene

PATTERNS = st.one_of(st.just(""), st.text(alphabet="01", min_size=1, max_size=40))
"""Packets, or raw chips."""


def decades(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw positive numbers, equally many in each decade."""
    lowest, highest = math.log10(low), math.log10(high)
    return st.floats(lowest, highest).map(lambda x: min(max(10.0**x, low), high))


def signed_decades(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw numbers of both signs, equally many in each decade."""
    return st.tuples(st.sampled_from([-1.0, 1.0]), decades(low, high)).map(math.prod)


STARTS = st.one_of(
    st.floats(-1e9, 1e9), signed_decades(1e-12, 1e9), st.integers(-(10**9), 10**9).map(float)
)
"""Start times in seconds."""


def within(name: str, value: float) -> float:
    """Return the nearest allowed value of a parameter."""
    declared = PARAMETERS[name]
    assert isinstance(declared, Quantity | Count)
    return min(max(value, declared.low), declared.high)


@dataclass(frozen=True)
class ExactTimes:
    """A scene's times as exact fractions in chips, and the light during them."""

    scene: Scene

    @cached_property
    def chips(self) -> list[int]:
        return [int(chip) for chip in occ.packet(self.scene)]

    @cached_property
    def frequency(self) -> Fraction:
        return Fraction(self.scene.transmitter.switching_frequency)

    @cached_property
    def exposure(self) -> Fraction:
        return Fraction(self.scene.camera.exposure_time) * self.frequency

    @cached_property
    def edge(self) -> Fraction:
        return Fraction(self.scene.transmitter.edge_time) * self.frequency

    @cached_property
    def _tables(self) -> tuple[list[int], list[int]]:
        """Lit chips before each chip, and twice the integral of that up to each chip; both end with
        the values of a whole period."""
        lit, doubled = [0], [0]
        for chip in self.chips:
            doubled.append(doubled[-1] + 2 * lit[-1] + chip)
            lit.append(lit[-1] + chip)
        return lit, doubled

    def start(self, column: int) -> Fraction:
        camera = self.scene.camera
        seconds = Fraction(self.scene.model.start_time) + column * Fraction(camera.readout_time)
        return seconds * self.frequency

    def lit_until(self, x: Fraction) -> Fraction:
        periods, remainder = divmod(x, len(self.chips))
        lit, _ = self._tables
        chip = int(remainder)
        return (
            periods * lit[-1] + lit[chip] + (remainder - chip) * self.chips[chip % len(self.chips)]
        )

    def lit_until_integrated(self, x: Fraction) -> Fraction:
        """The integral of :meth:`lit_until` from 0 to ``x``."""
        length = len(self.chips)
        periods, remainder = divmod(x, length)
        lit, doubled = self._tables
        chip = int(remainder)
        part = remainder - chip
        whole = periods * doubled[-1] + lit[-1] * length * periods * (periods - 1)
        within = doubled[chip] + part * (2 * lit[chip] + part * self.chips[chip])
        return (whole + within) / 2 + lit[-1] * periods * remainder

    def fraction(self, column: int) -> Fraction:
        """Return the lit fraction of a column's exposure with sharp edges of the LED."""
        x = self.start(column)
        return (self.lit_until(x + self.exposure) - self.lit_until(x)) / self.exposure

    def edged_fraction(self, column: int) -> Fraction:
        """Return the same with slow edges."""
        x, t, tau = self.start(column), self.exposure, self.edge
        until = self.lit_until_integrated
        now, before = until(x + t) - until(x), until(x + t - tau) - until(x - tau)
        return (now - before) / (tau * t)


def exact_pixel_value(luminance: mpmath.mpf, camera: Camera) -> mpmath.mpf:
    """Return the pixel value by equations (1) and (2), in the present precision of mpmath."""
    gain = mpmath.mpf(camera.iso) * mpmath.mpf(camera.exposure_time)
    gain /= mpmath.mpf(camera.meter_constant) * mpmath.mpf(camera.f_number) ** 2
    return 118 * mpmath.power(gain * luminance, 1 / mpmath.mpf(camera.gamma))


def exact_column_value(scene: Scene, fraction: mpmath.mpf) -> mpmath.mpf:
    """Return a column's pixel value by equations (1) to (3), not saturated.

    ``fraction`` is the lit fraction of its exposure.
    """
    surroundings, camera = scene.surroundings, scene.camera
    dark = mpmath.mpf(surroundings.illuminance) * mpmath.mpf(surroundings.reflectance) / mpmath.pi
    lit = mpmath.mpf(scene.transmitter.luminance)
    if scene.model.averaging == "light":
        return exact_pixel_value(dark + lit * fraction, camera)
    low, high = exact_pixel_value(dark, camera), exact_pixel_value(dark + lit, camera)
    return high * fraction + low * (1 - fraction)


def some_columns(scene: Scene) -> set[int]:
    """Return the first column, the last one, and some between."""
    last = scene.camera.columns - 1
    return {0, 1 % (last + 1), last // 3, last // 2, last}


STEEP = math.radians(89.99)
ANGLES = st.floats(-STEEP, STEEP) | st.sampled_from([0.0, STEEP, -STEEP])
POSES = "d 1 mm to 10 km, panels 0.1 mm to 100 m, turned to 89.99 degrees"
GEOMETRY = {"sensor-noise": False, "fixed-pattern": False, "distortion": True, "defocus": True}


@st.composite
def poses(draw: st.DrawFn) -> Scene:
    """Draw the scene of a panel of any size, at any place and angle, in a small picture."""
    distance = draw(decades(1e-3, 1e4))
    size = decades(1e-3, 1e4).map(lambda fraction: within("panel_width", fraction * distance))
    aside = st.just(0.0) | st.floats(-1.0, 1.0) | signed_decades(1e-6, 1.0)
    scene = Scene().replace(
        rows=draw(st.integers(1, 24)),
        columns=draw(st.integers(1, 32)),
        equivalent_focal_length=draw(decades(1e-3, 2.0)),
        distance=distance,
        panel_width=draw(size),
        panel_height=draw(size),
        offset_x=distance * draw(aside),
        offset_y=distance * draw(aside),
        yaw=draw(ANGLES),
        pitch=draw(ANGLES),
        roll=draw(st.floats(-math.pi, math.pi) | st.just(0.0)),
        pattern="1",
        illuminance=0.0,
        enhancement="none",
        iso=4e6,
    )
    return draw(st.just(scene) | decades(1e-10, 1.0).map(lambda remainder: graze(scene, remainder)))


def graze(scene: Scene, remainder: float) -> Scene:
    """Move a panel so near that its nearest corner is just in front of the camera, on its axis."""
    half = np.array([scene.transmitter.panel_width, scene.transmitter.panel_height]) / 2
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners = signs * [*half, 0.0] @ rotation_of(scene.pose).T
    nearest = corners[corners[:, 2].argmin()]
    distance = within("distance", -nearest[2] * (1.0 + remainder))
    return scene.replace(distance=distance, offset_x=-nearest[0], offset_y=-nearest[1])


@st.composite
def lenses(draw: st.DrawFn) -> dict[str, float]:
    """Draw coefficients of distortion of all sizes, up to the largest allowed."""
    small = st.just(0.0) | signed_decades(1e-9, 1.0)
    k1, k2 = (10.0 * draw(small) for _ in range(2))
    p1, p2 = (draw(small) for _ in range(2))
    return {"radial_k1": k1, "radial_k2": k2, "tangential_p1": p1, "tangential_p2": p2}


SMALL: dict[str, float | str] = {
    "rows": 30,
    "columns": 40,
    "pattern": "1",
    "illuminance": 0.0,
    "enhancement": "none",
}
