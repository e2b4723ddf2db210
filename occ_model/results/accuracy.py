"""Results of an accuracy study: time and error of each way to simulate."""

from dataclasses import dataclass

ACCURACY_PARTS = {
    "integration": "exposure: samples in time, closed form",
    "effects": "effects, one after the other",
    "path": "columns alone, whole pictures",
    "draft": "drafts: every k-th row of the picture",
    "noise": "noise drawn, noise used again",
}
"""The parts of an accuracy study, with their titles."""

CHAINED_PARTS = ("integration", "effects")
"""The parts whose points, but for that of the present settings, form a curve."""

CLOSED_FORM = "closed form"
"""Name of the exposure that is integrated exactly."""

LEAST_ERROR = 1e-3
"""Least error in levels that is drawn; smaller ones are drawn as this one."""


@dataclass(frozen=True, slots=True)
class AccuracyPoint:
    """The time and the error of one way to simulate."""

    part: str  # The part of the study: a name from ``ACCURACY_PARTS``
    name: str
    seconds: float
    # Root mean square difference from the most exact way, in levels of the stretched profile
    error: float
    current: bool = False  # Whether the present settings simulate in this way: one point of a study
    effects: tuple[str, ...] = ()
