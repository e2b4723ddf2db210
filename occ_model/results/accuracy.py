"""What an accuracy study measures."""

from dataclasses import dataclass

ACCURACY_PARTS = {
    "integration": "exposure: samples in time, closed form",
    "effects": "effects, one after the other",
    "path": "columns alone, whole pictures",
    "noise": "noise drawn, noise used again",
}
"""What an accuracy study compares, and how it is called."""

CHAINED_PARTS = ("integration", "effects")
"""The parts whose points follow from each other, all but the last."""

LEAST_ERROR = 1e-3
"""Levels below which an error is drawn as this one: a thousandth of one is no error to anyone."""


@dataclass(frozen=True, slots=True)
class AccuracyPoint:
    """What one way of simulating costs in time, and how wrong it is.

    Parameters
    ----------
    part
        What is compared: a name from ``ACCURACY_PARTS``.
    name
        The way.
    seconds
        Time that it takes.
    error
        How far it is from the best that is compared, in levels of the stretched profile.
    current
        Whether the settings at hand are this way.
    """

    part: str
    name: str
    seconds: float
    error: float
    current: bool = False
