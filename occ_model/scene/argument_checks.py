"""Checks of arguments: counts, choices, switches, seeds."""

from collections.abc import Mapping, Sequence
from numbers import Integral, Real
from typing import TypeGuard

import numpy as np

from occ_model.errors import ParameterError, quote


def check_count(name: str, value: object, least: int, most: int | None = None) -> None:
    """Refuse a value that is not a whole number from ``least`` to ``most``; None is no limit."""
    whole = isinstance(value, Integral) and not isinstance(value, bool)
    if not whole or value < least or (most is not None and value > most):  # type: ignore[operator]
        top = "" if most is None else f" to {most:,}"
        raise ParameterError.of(name, quote(value), f"a whole number from {least}{top}")


def is_number(value: object) -> TypeGuard[float]:
    """Return whether a value is a real number, which True and False are not."""
    return isinstance(value, Real) and not isinstance(value, bool)


def check_choice(name: str, value: object, choices: Sequence[str]) -> None:
    if not isinstance(value, str) or value not in choices:
        raise ParameterError.of(name, quote(value), ", ".join(choices))


def check_switches(switches: object, names: Sequence[str]) -> dict[str, bool]:
    """Return switches, True or False by name; refuse a value that is not such a mapping."""
    if switches is None:
        return {}
    if not isinstance(switches, Mapping):
        raise ParameterError.of("force", quote(switches), "effects by name, True or False each")
    for name, on in switches.items():
        check_choice("effect", name, names)
        if not isinstance(on, bool | np.bool_):
            raise ParameterError.of(f"effect {quote(name)}", f"switched {quote(on)}", "True, False")
    return {name: bool(on) for name, on in switches.items()}


def check_seed(seed: object) -> None:
    """Refuse a value that is not a seed of random numbers, a whole number from 0."""
    check_count("seed", seed, 0)
