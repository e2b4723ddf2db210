"""Checks of what plug-ins give and declare: a value of the type that the program uses, or an error.

Each takes the start of a sentence that names the plug-in, and what its value is called.
"""

import math
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.errors import PluginError, one_line, quote

_ROUNDING = 1e-9  # by which a number may miss its range: a correlation may be 1.000000000000001


def checked_number(
    who: str, what: str, value: object, low: float = -math.inf, high: float = math.inf
) -> float | None:
    """Return a number between two others, or None."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, Real):
        raise _other_type(who, what, value)
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number) or not low - _ROUNDING <= number <= high + _ROUNDING:
        raise PluginError(f"{who} gives {what} = {quote(value)}; allowed: {_range(low, high)}.")
    return min(max(number, low), high)


def checked_count(who: str, what: str, value: object, low: int, high: int) -> int:
    """Return a whole number between two others."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise _other_type(who, what, value)
    count = int(value)
    if not low <= count <= high:
        raise PluginError(f"{who} gives {what} = {quote(count)}; allowed: {low} to {high:,}.")
    return count


def checked_text(who: str, what: str, value: object) -> str:
    """Return a text of one line, which is short."""
    if not isinstance(value, str):
        raise _other_type(who, what, value)
    return one_line(value)


def checked_failure(who: str, value: object) -> str | None:
    """Return why nothing was read, or None."""
    return None if value is None else checked_text(who, "failure", value) or None


def checked_places(who: str, what: str, places: object, count: int) -> tuple[int, ...]:
    """Return a tuple of whole numbers from 0 to before a count."""
    if not isinstance(places, tuple) or not all(
        isinstance(place, Integral) and 0 <= int(place) < count for place in places
    ):
        raise PluginError(f"{who} gives {what} that are not places among {count:,}.")
    return tuple(map(int, places))


def checked_bits(who: str, what: str, values: object, most: int) -> ByteArray:
    """Return zeros and ones as bytes, which the plug-in cannot change later."""
    array = _array(who, what, values, most)
    if array.dtype.kind not in "biuf" or not np.isin(array, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not zeros and ones.")
    return array.astype(np.uint8)


def checked_counts(who: str, what: str, values: object, most: int) -> IndexArray:
    """Return whole numbers from 0 to ``most``, and as many of them at most."""
    array = _array(who, what, values, most)
    if array.dtype.kind not in "iu" or not np.all((array >= 0) & (array <= most)):
        raise PluginError(f"{who} gives {what} that are not whole numbers up to {most:,}.")
    return array.astype(np.int64)


def checked_numbers(
    who: str, what: str, values: object, length: int, low: float = -math.inf, high: float = math.inf
) -> FloatArray | None:
    """Return so many numbers between two others, or None."""
    if values is None:
        return None
    array = _array(who, what, values, length)
    if len(array) < length:
        raise PluginError(f"{who} gives {len(array):,} {what} in place of {length:,}.")
    if array.dtype.kind in "biuf":
        with np.errstate(over="ignore"):  # of more than double precision
            numbers = array.astype(np.float64)
        within = (numbers >= low - _ROUNDING) & (numbers <= high + _ROUNDING)
        if np.isfinite(numbers).all() and within.all():
            return np.clip(numbers, low, high)
    raise PluginError(f"{who} gives {what} that are not all {_range(low, high)}.")


def _array(who: str, what: str, values: object, most: int) -> NDArray[Any]:
    if not isinstance(values, np.ndarray) or values.ndim != 1:
        raise PluginError(f"{who} gives {what} that are not an array of one dimension.")
    if len(values) > most:
        raise PluginError(f"{who} gives {len(values):,} {what}; allowed: up to {most:,}.")
    return np.asarray(values)


def _other_type(who: str, what: str, value: object) -> PluginError:
    return PluginError(f"{who} gives {what} = {quote(value)} of the type {type(value).__name__}.")


def _range(low: float, high: float) -> str:
    if math.isinf(low) and math.isinf(high):
        return "finite numbers"
    return f"numbers from {low:g}" + (f" to {high:g}" if math.isfinite(high) else "")
