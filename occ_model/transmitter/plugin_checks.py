"""Check what plug-ins return and declare: return it in the program's own type, or raise an error.

``who`` is the start of a sentence, which names the plug-in; ``what`` is the name of its value.
"""

import math
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.errors import PluginError, one_line, quote

_ROUNDING = 1e-9  # by which a number may exceed its range: a correlation may be 1.000000000000001


def require_number(
    who: str, what: str, value: object, low: float = -math.inf, high: float = math.inf
) -> float | None:
    """Return a number from ``low`` to ``high``, or None."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, Real):
        raise _wrong_type_error(who, what, value)
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number) or not low - _ROUNDING <= number <= high + _ROUNDING:
        raise PluginError(
            f"{who} gives {what} = {quote(value)}; allowed: {_describe_range(low, high)}."
        )
    return min(max(number, low), high)


def require_count(who: str, what: str, value: object, low: int, high: int) -> int:
    """Return an integer from ``low`` to ``high``."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise _wrong_type_error(who, what, value)
    count = int(value)
    if not low <= count <= high:
        raise PluginError(f"{who} gives {what} = {quote(count)}; allowed: {low} to {high:,}.")
    return count


def require_text(who: str, what: str, value: object) -> str:
    """Return a short text of one line."""
    if not isinstance(value, str):
        raise _wrong_type_error(who, what, value)
    return one_line(value)


def require_failure(who: str, value: object) -> str | None:
    """Return why nothing was read, or None."""
    return None if value is None else require_text(who, "failure", value) or None


def require_places(who: str, what: str, places: object, count: int) -> tuple[int, ...]:
    """Return a tuple of integers from 0 to below ``count``."""
    if not isinstance(places, tuple) or not all(
        isinstance(place, Integral) and 0 <= int(place) < count for place in places
    ):
        raise PluginError(f"{who} gives {what} that are not places among {count:,}.")
    return tuple(map(int, places))


def require_bits(who: str, what: str, values: object, most: int) -> ByteArray:
    """Return zeros and ones as bytes, in an array that the plug-in cannot change later."""
    array = _check_array(who, what, values, most)
    if array.dtype.kind not in "biuf" or not np.isin(array, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not zeros and ones.")
    return array.astype(np.uint8)


def require_counts(who: str, what: str, values: object, most: int) -> IndexArray:
    """Return at most ``most`` integers from 0 to ``most``."""
    array = _check_array(who, what, values, most)
    if array.dtype.kind not in "iu" or not np.all((array >= 0) & (array <= most)):
        raise PluginError(f"{who} gives {what} that are not whole numbers up to {most:,}.")
    return array.astype(np.int64)


def require_numbers(
    who: str, what: str, values: object, length: int, low: float = -math.inf, high: float = math.inf
) -> FloatArray | None:
    """Return ``length`` numbers from ``low`` to ``high``, or None."""
    if values is None:
        return None
    array = _check_array(who, what, values, length)
    if len(array) < length:
        raise PluginError(f"{who} gives {len(array):,} {what} in place of {length:,}.")
    if array.dtype.kind in "biuf":
        with np.errstate(over="ignore"):  # of more than double precision
            numbers = array.astype(np.float64)
        is_in_range = (numbers >= low - _ROUNDING) & (numbers <= high + _ROUNDING)
        if np.isfinite(numbers).all() and is_in_range.all():
            return np.clip(numbers, low, high)
    raise PluginError(f"{who} gives {what} that are not all {_describe_range(low, high)}.")


def _check_array(who: str, what: str, values: object, most: int) -> NDArray[Any]:
    if not isinstance(values, np.ndarray) or values.ndim != 1:
        raise PluginError(f"{who} gives {what} that are not an array of one dimension.")
    if len(values) > most:
        raise PluginError(f"{who} gives {len(values):,} {what}; allowed: up to {most:,}.")
    return np.asarray(values)


def _wrong_type_error(who: str, what: str, value: object) -> PluginError:
    return PluginError(f"{who} gives {what} = {quote(value)} of the type {type(value).__name__}.")


def _describe_range(low: float, high: float) -> str:
    if math.isinf(low) and math.isinf(high):
        return "finite numbers"
    return f"numbers from {low:g}" + (f" to {high:g}" if math.isfinite(high) else "")
