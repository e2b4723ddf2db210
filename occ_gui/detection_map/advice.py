"""How far a decoder reaches, and what theory says of it."""

from dataclasses import dataclass

from occ_model.results import Limits


@dataclass(frozen=True, slots=True)
class TheoryNumbers:
    """The limits that theory gives for one scene.

    Parameters
    ----------
    band_frequency, null_frequency, packets_frequency
        Switching frequencies in Hz: where the band model ends, where an alternating pattern has no
        stripes, and below which no two packets fit the panel's image (None: there is no panel).
    band_exposure, null_exposure, saturation_exposure
        Exposure times in seconds: the first two of these, and where the lit panel is white
        (infinite: there is no light).
    """

    band_frequency: float
    null_frequency: float
    packets_frequency: float | None
    band_exposure: float
    null_exposure: float
    saturation_exposure: float


@dataclass(frozen=True, slots=True)
class Advice:
    """How far one decoder reaches.

    Parameters
    ----------
    limits
        What was found by trying.
    theory
        What theory says.
    """

    limits: Limits
    theory: TheoryNumbers
