"""Checks of arguments that are no parameters of a scene."""

from collections.abc import Sequence
from numbers import Integral, Real

from occ_model.errors import ParameterError


def check_count(name: str, value: object, least: int) -> None:
    """Refuse what is no whole number from ``least``.

    Raises
    ------
    ParameterError
        Naming the argument, its value and what is allowed.
    """
    whole = isinstance(value, Integral) and not isinstance(value, bool)
    if not whole or value < least:  # type: ignore[operator]  # an Integral by now
        raise ParameterError(f"{name} is {value!r}; allowed: a whole number from {least}.")


def check_level(name: str, value: object, largest: float) -> None:
    """Refuse what is no number of grey levels from 0 to ``largest``.

    Raises
    ------
    ParameterError
        Naming the argument, its value and what is allowed.
    """
    number = isinstance(value, Real) and not isinstance(value, bool)
    if not number or not 0.0 <= value <= largest:  # type: ignore[operator]  # a Real by now
        raise ParameterError(f"{name} is {value!r} grey levels; allowed: 0 to {largest:g}.")


def check_choice(name: str, value: object, choices: Sequence[str]) -> None:
    """Refuse what is none of a few words.

    Raises
    ------
    ParameterError
        Naming the argument, its value and what is allowed.
    """
    if not isinstance(value, str) or value not in choices:
        raise ParameterError(f"{name} is {value!r}; allowed: {', '.join(choices)}.")


def check_seed(seed: object) -> None:
    """Refuse what is no seed of random numbers."""
    check_count("seed", seed, 0)


def check_tolerance(tolerance: object) -> None:
    """Refuse what is no tolerance."""
    check_level("tolerance", tolerance, float("inf"))
