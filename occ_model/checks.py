"""Checks of arguments that are no parameters of a scene."""

from collections.abc import Sequence
from numbers import Integral

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
