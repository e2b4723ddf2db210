"""What the user wants of a match between photo and scene."""

from dataclasses import dataclass

KNOWN = ("switching_frequency", "readout_time")
"""Stripes tell the product of these alone: one has to be known for the other to be found."""

CHIPS_OF_A_CYCLE = 2
"""A blinking LED is on for one chip and off for the next."""


@dataclass(frozen=True, slots=True)
class MatchChoice:
    """How a photo is to be matched.

    Parameters
    ----------
    sent
        What was sent: one of ``"auto"``, ``"scene"``, ``"read"`` and ``"square"``.
    square_frequency
        Cycles a second of the square wave, in Hz, where that was sent.
    estimate
        ``"readout_time"`` or ``"switching_frequency"``; the other one is known.
    fit_gamma
        Whether the gamma is to be found too.
    """

    sent: str = "auto"
    square_frequency: float = 1000.0
    estimate: str = "readout_time"
    fit_gamma: bool = False
