"""What an accuracy study measures."""

from dataclasses import dataclass

ACCURACY_PARTS = {
    "integration": "exposure: samples in time against the closed form",
    "effects": "effects, one after the other",
    "path": "columns alone against whole pictures",
    "noise": "noise drawn against noise used again",
}
"""What an accuracy study compares, and how it is called."""


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
