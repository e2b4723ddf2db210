"""Checks of the values that plug-ins give: bits, chips, places among them, and reasons."""

from collections.abc import Sized

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, one_line

MOST_CHIPS = 65_536  # of a plug-in's period or result: more than any built-in packet has (57,116)


def excess(what: str, values: object, most: int) -> str | None:
    """Say that there are more values than anything shows or counts, before looking at each."""
    if isinstance(values, np.ndarray):
        count = values.size
    else:
        count = len(values) if isinstance(values, Sized) else 0
    return f"{count:,} {what}; allowed: up to {most:,}" if count > most else None


def is_bits(values: object) -> bool:
    """Whether values are an array of zeros and ones of one dimension."""
    return (
        isinstance(values, np.ndarray)
        and values.ndim == 1
        and values.dtype.kind in "biu"
        and bool(np.isin(values, (0, 1)).all())
    )


def plain_bits(bits: ByteArray) -> ByteArray:
    """Return a plug-in's bits as an array of bytes, of no other class and not changed later."""
    return np.array(bits, dtype=np.uint8, subok=False)


def are_places(places: object, count: int) -> bool:
    """Whether places are a tuple of whole numbers from 0 to before a number."""
    return (
        isinstance(places, tuple)
        and len(places) <= count
        and all(type(place) is int and 0 <= place < count for place in places)
    )


def is_reason(failure: object) -> bool:
    return failure is None or (isinstance(failure, str) and bool(failure))


def plain_reason(failure: str | None) -> str | None:
    """Return a plug-in's failure in one line that ends as a sentence does."""
    if failure is None:
        return None
    line = one_line(failure)
    return line if line.endswith((".", "?", "!")) else f"{line}."


def checked_chips(chips: object, who: str, count: int | None = None) -> ByteArray:
    """Return a plug-in's chips as bytes."""
    if problem := excess("chips", chips, MOST_CHIPS):
        raise PluginError(f"{who} gives {problem}.")
    if not isinstance(chips, np.ndarray) or not is_bits(chips) or not chips.size:
        raise PluginError(f"{who} gives no chips, which are zeros and ones.")
    if count is not None and len(chips) != count:
        raise PluginError(f"{who} gives {len(chips)} chips in place of {count}.")
    return plain_bits(chips)
