"""Results of an accuracy study: time and error of each simulation method."""

from dataclasses import dataclass

from occ_model.scene.units import LEVEL

ACCURACY_PARTS = {  # titles of the parts of an accuracy study, by name
    "integration": "exposure: samples in time, closed form",
    "effects": "effects, one after the other",
    "path": "columns alone, whole pictures",
    "draft": "drafts: every k-th row of the picture",
    "noise": "noise drawn, noise used again",
}

CHAINED_PARTS = ("integration", "effects")  # points form a curve, but for the present settings'
CLOSED_FORM = "closed form"  # name of the exposure that is integrated exactly

LEAST_ERROR = 1e-3
"""Smallest error drawn, in levels of the stretched profile; smaller ones are drawn there."""


@dataclass(frozen=True, slots=True)
class AccuracyPoint:
    """Time and error of one simulation method."""

    part: str  # The part of the study: a name from ``ACCURACY_PARTS``
    name: str
    seconds: float
    error: float  # Root mean square difference from the most exact way
    current: bool = False  # Whether the present settings simulate in this way: one point of a study
    effects: tuple[str, ...] = ()
    unit: str = LEVEL.symbol  # Of the error: of the stretched profile, or of a decision
