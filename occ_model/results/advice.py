"""The facts that advice on a scene states: the limits found by trial and those of theory.

The window and the command line put the same facts into sentences.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from occ_model.results.limits import Limits, Trial, WorkingRange, stated_end

Side: TypeAlias = Literal["lowest", "highest"]


@dataclass(frozen=True, slots=True)
class TheoryLimits:
    """The values of one parameter at which theory places a limit, all others as they are."""

    band_model: float  # Where the band model ends: t = t_LED
    null: float  # Where an alternating pattern has no stripes: t = 2 t_LED
    # The frequency below which no two packets fit the panel's image; None for an exposure time, or
    # where the image shows no panel
    two_packets: float | None = None
    # The exposure time from which the lit panel is white, infinite without light; None for a
    # frequency
    saturation: float | None = None


@dataclass(frozen=True, slots=True)
class EndFacts:
    """One end of a working range."""

    parameter: str
    side: Side
    # As of RangeEnd
    works: Trial
    fails: Trial | None
    inside: Trial | None = None
    interval: tuple[float, float] | None = None

    @property
    def value(self) -> float:
        """The last value at which the decoder reads, in SI units."""
        return stated_end(self.works, self.interval)


@dataclass(frozen=True, slots=True)
class RangeFacts:
    """What is known of the values of one parameter at which a decoder reads a scene."""

    found: WorkingRange
    # Its lowest end and its highest; empty where the decoder reads nowhere
    ends: tuple[EndFacts, ...]
    theory: TheoryLimits


@dataclass(frozen=True, slots=True)
class Advice:
    """How fast a scene can go with one decoder, and how long it can be exposed."""

    limits: Limits
    frequency: RangeFacts
    exposure: RangeFacts
