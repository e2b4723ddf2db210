"""Choices of a match: what the LED sent, what is known, and what is estimated."""

from dataclasses import dataclass

KNOWN = ("switching_frequency", "readout_time")
"""Stripes determine only the product of these two: one must be known to estimate the other."""

SENT = ("auto", "scene", "square", "read")
"""What an LED has sent: to be found out, what the scene does, a square wave, or to be read."""


@dataclass(frozen=True, slots=True)
class MatchChoice:
    sent: str = "auto"  # what was sent, one of SENT
    square_frequency: float = 1000.0  # cycles per second of the square wave, in Hz, if one was sent
    # ``"readout_time"`` or ``"switching_frequency"``; the other one is known
    estimate: str = "readout_time"
    fit_gamma: bool = False  # whether gamma is estimated too
