"""What measured times rest on: the frequency, or the readout time, that is taken as known."""

import math
from collections.abc import Mapping

from occ_model.results.assumption import assumption


def is_certain(name: str, value: float, certain: Mapping[str, float]) -> bool:
    """Whether a known value is confirmed and not only assumed.

    Parameters
    ----------
    certain
        The values that the user has confirmed, in SI units by name.
    """
    return math.isclose(value, certain.get(name, math.nan), rel_tol=1e-9)


def is_stale(
    name: str, then: float, given: float, now: float, certain: Mapping[str, float]
) -> bool:
    """Whether the scene has another known value than the one that a result was found with.

    Parameters
    ----------
    name, certain
        As for :func:`is_certain`: what is certain of a photo holds whatever the scene becomes.
    then, now
        The value that the result was found with, and the scene's, in SI units.
    given
        What the scene had when the result was found: a square wave is known by its own frequency.
    """
    return now not in {then, given} and not is_certain(name, then, certain)


def condition(name: str, value: float, certain: Mapping[str, float], chips: int) -> str:
    """Name the value that estimates rest on, as ``"if f = 10 kHz: "``; empty where it is certain.

    Parameters
    ----------
    chips
        Chips of a period: a lamp that only blinks is known by its cycles.
    """
    if is_certain(name, value, certain):
        return ""
    return assumption(name, value, chips)
