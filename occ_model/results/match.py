"""Results of matching a photo: its stripes, the scene that explains them, a comparison."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.decoding import Region
from occ_model.scene.light_words import (
    BlinkingLamp,
    blinking_lamp,
    frequency_parameter,
    lamp_of_chips,
)
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, Transmitter

ESTIMATES = ("readout_time", "switching_frequency")
"""Two parameters, one of which is estimated from the other, as stripes show only their product.

The frequency of a lamp is ``lamp_frequency`` in place of ``switching_frequency``.
"""


def known_parameter(estimate: str, transmitter: Transmitter) -> str:
    """Return the parameter of a scene that must be known to estimate one of :data:`ESTIMATES`."""
    return frequency_parameter(transmitter) if estimate == "readout_time" else "readout_time"


def known_value(estimate: str, scene: Scene) -> tuple[str, float]:
    """Return the name and the scene's value of the known parameter; of a lamp, its frequency."""
    name, lamp = known_parameter(estimate, scene.transmitter), blinking_lamp(scene.transmitter)
    if lamp is not None and name != "readout_time":
        return "lamp_frequency", lamp.frequency
    return name, float(scene.value(name))


NEVER_CHANGES = "What the scene sends never changes: it makes no stripes."

PLAIN_STRIPES = (  # advice if a repeating pulse is refused as a code
    "These look like the plain stripes of a lamp; if it is one, choose a lamp as what was sent."
)


@dataclass(frozen=True, eq=False, slots=True)
class Stripes:
    """The stripes in a photo.

    Parameters
    ----------
    region
        The rectangle of the photo that contains them.
    profile : ndarray of float64, shape (columns of the region,)
        Mean of each column of the region, in grey levels.
    low, high : ndarray of float64, shape as ``profile``
        Slowly varying dark and bright levels of the stripes.
    period
        Period of the stripes in columns; None if they do not repeat in the region.
    period_uncertainty
        Its standard deviation in columns.
    saturated
        Fraction of the region's pixels that are white.
    """

    region: Region
    profile: FloatArray
    low: FloatArray
    high: FloatArray
    period: float | None
    period_uncertainty: float | None
    saturated: float

    @property
    def flattened(self) -> FloatArray:
        """The profile corrected for uneven light, from 0 (dark) to 1 (bright), shape (columns,)."""
        return (self.profile - self.low) / (self.high - self.low)


@dataclass(frozen=True, slots=True)
class Alternative:
    """An explanation of a photo's stripes other than that of the match.

    Parameters
    ----------
    sent
        What is sent, in words.
    pattern
        The chips sent, from the start of a period; empty if there is no code.
    correlation
        Correlation of its profile with the photo's, both corrected for uneven light.
    evidence
        Natural logarithm of its likelihood ratio to the match, with a penalty for free parameters;
        negative if it is less likely.
    readout_time, switching_frequency, exposure_time
        In SI units, or None.
    """

    sent: str
    pattern: str
    correlation: float
    evidence: float
    readout_time: float | None = None
    switching_frequency: float | None = None
    exposure_time: float | None = None

    @property
    def lamp(self) -> BlinkingLamp | None:
        """The lamp that its chips describe; None if they are a code's."""
        frequency = self.switching_frequency
        return None if frequency is None else lamp_of_chips(self.pattern, frequency)

    @property
    def lamp_frequency(self) -> float | None:
        """The frequency of that lamp in Hz, or None."""
        return None if self.lamp is None else self.lamp.frequency


_EXPOSURE_DEPENDENT = ("exposure_time", "start_time", "gamma")
"""Estimates that depend on the exposure, which starts half its length before its middle."""

_FEW_CHANGES = 3  # most parameters by which a scene differs from that of a match that it shows
_DISPLAY_TOLERANCE = 5e-7  # relative difference of values that agree in the six displayed digits
_ERROR_TOLERANCE = 1e-3  # difference of equal values, as a fraction of the standard deviation

_ONLY_EXPOSURE = "Only the exposure time, and with it the start time, is doubtful."


@dataclass(frozen=True, eq=False, slots=True)
class Match:
    """The scene that explains a photo's stripes.

    Parameters
    ----------
    scene
        The given scene with the parameters estimated from the photo. A lamp has full depth, because
        a photo does not distinguish its steady light from that of others.
    stripes
        The matched stripes, with the fitted levels.
    readout_time, exposure_time, start_time, gamma
        Those of the scene, in SI units; ``start_time`` is that of the photo's first column.
    switching_frequency
        Chips of ``pattern`` a second; the scene's, if it sends a code.
    uncertainties
        Standard deviations of the estimates, in SI units, by name; for a lamp ``lamp_frequency``
        and ``duty`` in place of ``switching_frequency``.
    pattern
        The chips sent, from the start of a period; for a lamp ``"10"``, as a cycle counts as two.
    pattern_was_read
        Whether it was read from the photo.
    profile : ndarray of float64, shape (columns of the region,)
        Profile of the fitted scene, aligned with the photo and at its brightness, in grey levels.
    correlation
        Correlation of that profile with the photo's, both corrected for uneven light.
    other_exposures
        Other exposure times in seconds that explain the stripes equally well, shortest first.
    reasons
        Sentences on why the match is doubtful; empty if it is sure.
    alternatives
        Other explanations of the stripes, most likely first.
    exposure_reasons
        Sentences on why the exposure time is doubtful; the chips and the readout time or frequency
        do not depend on it.
    lines_at_once
        Lines that the sensor reads together, as a lamp's stripes show; 1 for others.
    """

    scene: Scene
    stripes: Stripes
    readout_time: float
    switching_frequency: float
    exposure_time: float
    start_time: float
    gamma: float
    uncertainties: Mapping[str, float]
    pattern: str
    pattern_was_read: bool
    profile: FloatArray
    correlation: float
    other_exposures: tuple[float, ...] = ()
    reasons: tuple[str, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    exposure_reasons: tuple[str, ...] = ()
    lines_at_once: int = 1

    @property
    def lamp(self) -> BlinkingLamp | None:
        """The lamp in the photo; None if a code is sent."""
        transmitter = self.scene.transmitter
        return blinking_lamp(transmitter) if transmitter.light == "lamp" else None

    @property
    def lamp_frequency(self) -> float | None:
        """Cycles of the lamp a second; None if a code is sent."""
        return None if self.lamp is None else self.lamp.frequency

    @property
    def duty(self) -> float | None:
        """Fraction of a cycle in which the lamp is lit, from 0 to 1; None if a code is sent."""
        return None if self.lamp is None else self.lamp.duty

    @property
    def _frequency(self) -> str:
        return "switching_frequency" if self.lamp is None else "lamp_frequency"

    @property
    def known(self) -> str:
        """The parameter that was given: the readout time or the frequency."""
        return "readout_time" if self._frequency in self.uncertainties else self._frequency

    @property
    def estimate(self) -> str:
        """The parameter that was estimated: the other one of the two."""
        return self._frequency if self.known == "readout_time" else "readout_time"

    @property
    def verdict(self) -> str:
        """``"sure"``, or ``"doubtful"`` if there is a reason to doubt the match."""
        return "doubtful" if self.reasons else "sure"

    @property
    def exposure_verdict(self) -> str:
        """``"sure"``, or ``"doubtful"`` if the match or its exposure time is doubtful."""
        return "doubtful" if self.reasons or self.exposure_reasons else "sure"

    @property
    def only_exposure_is_doubtful(self) -> bool:
        """Whether everything except the exposure time is sure."""
        return bool(self.exposure_reasons) and not self.reasons

    @property
    def doubtful_alone(self) -> tuple[str, ...]:
        """Names of the estimates that are doubtful although the match is sure."""
        return _EXPOSURE_DEPENDENT if self.only_exposure_is_doubtful else ()

    @property
    def all_reasons(self) -> tuple[str, ...]:
        """The reasons to doubt the match and its exposure time."""
        if not self.only_exposure_is_doubtful:
            return (*self.reasons, *self.exposure_reasons)
        first, *others = self.exposure_reasons
        return (f"{_ONLY_EXPOSURE} {first}", *others)

    def is_applied_to(self, scene: Scene) -> bool:
        """Return whether a scene has the estimates of the match.

        A match that starts from its own scene gives that scene again, up to rounding.
        """
        return scene == self.scene or not self._count_changes(scene)

    def is_origin_of(self, scene: Scene) -> bool:
        """Return whether a scene is that of the match, apart from a few parameters."""
        return self._count_changes(scene) <= _FEW_CHANGES

    def _count_changes(self, scene: Scene) -> int:
        return sum(
            not self._is_same(name, scene.value(name), self.scene.value(name))
            for name in PARAMETERS
        )

    def _is_same(self, name: str, scene_value: object, match_value: object) -> bool:
        if not isinstance(scene_value, float) or not isinstance(match_value, float):
            return scene_value == match_value
        tolerance = _ERROR_TOLERANCE * self.uncertainties.get(name, 0.0)
        return math.isclose(scene_value, match_value, rel_tol=_DISPLAY_TOLERANCE, abs_tol=tolerance)

    @property
    def columns_per_chip(self) -> float:
        """Length of a chip in columns."""
        return 1.0 / (self.switching_frequency * self.readout_time)

    @property
    def periods_in_view(self) -> float:
        """Periods of the pattern sent during the readout of the region."""
        return len(self.profile) / (self.columns_per_chip * len(self.pattern))

    @property
    def exposure_in_chips(self) -> float:
        """The exposure time in chips."""
        return self.exposure_time * self.switching_frequency

    @property
    def exposure_in_periods(self) -> float:
        """The exposure time in periods of what is sent."""
        return self.exposure_in_chips / len(self.pattern)

    @property
    def region(self) -> Region:
        """The rectangle of the photo that was matched."""
        return self.stripes.region

    @property
    def residual(self) -> FloatArray:
        """The photo's profile minus the aligned one, in grey levels, shape (columns,)."""
        return self.stripes.profile - self.profile

    @property
    def rmse(self) -> float:
        """Root mean square of the residual, in grey levels."""
        return float(np.sqrt(np.mean(self.residual**2)))
