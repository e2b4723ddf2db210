"""Round steps between the numbers of an axis."""

import math

_ROUNDING = 1e-9  # by how much, of its size, a step may be smaller than is asked for


def round_step(least: float) -> float:
    """Return the smallest of 1, 2 and 5 times a power of ten that is not below a number."""
    power = 10.0 ** math.floor(math.log10(least))
    steps = (factor * power for factor in (1.0, 2.0, 5.0, 10.0))
    return next(step for step in steps if step >= least * (1.0 - _ROUNDING))
