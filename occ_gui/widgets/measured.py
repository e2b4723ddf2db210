"""Measured values: a number with its standard deviation, to the digits that mean something."""

import math

from occ_model.scene.units import Unit

_MOST_DECIMALS = 12


def with_error(unit: Unit, value: float, error: float | None) -> str:
    """Format a value with its standard deviation, to the digits that are significant.

    Parameters
    ----------
    unit
        The unit of both, which are in SI units.
    value
        The value.
    error
        Its standard deviation; None, zero or infinite where it has none.
    """
    if error is None or not 0.0 < error < math.inf:
        return unit.format(value)
    symbol, factor = unit.display(value)
    # Two digits of the error, and the value to the same decimal place.
    decimals = min(max(0, 1 - math.floor(math.log10(error / factor))), _MOST_DECIMALS)
    number = f"{value / factor:.{decimals}f} ± {error / factor:.{decimals}f}"
    return f"{number} {symbol}".rstrip()
