"""Facts of an advice on a scene: limits found by trial and limits of theory."""

from dataclasses import dataclass

from occ_model.results.limits import Limits


@dataclass(frozen=True, slots=True)
class TheoryLimits:
    """Values of one parameter at which theory places a limit, the others unchanged."""

    band_model: float  # Where the band model ends: t = t_LED
    null: float  # Where an alternating pattern has no stripes: t = 2 t_LED
    # Frequency below which two packets do not fit the panel's image; None for an exposure time or
    # without a panel in view
    two_packets: float | None = None
    # Exposure time from which the lit panel is white, infinite without light; None for a frequency
    saturation: float | None = None


@dataclass(frozen=True, slots=True)
class Advice:
    """How fast a scene can go with one decoder, and how long it can be exposed."""

    limits: Limits
    # What theory says of each
    frequency: TheoryLimits
    exposure: TheoryLimits
