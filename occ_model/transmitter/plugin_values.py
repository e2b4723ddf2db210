"""The checks of what plug-ins give: the types of its parts, and how many bits and chips."""

from numbers import Integral
from typing import Any

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, one_line, shown

MOST_CHIPS = 65_536  # of a plug-in's period or result: more than any built-in packet has (57,116)


def check_kinds(who: str, given: object, **kinds: Any) -> None:
    """Refuse what a plug-in gives if a part, by its name, is of another kind."""
    for name, kind in kinds.items():
        value = getattr(given, name)
        if not isinstance(value, kind):
            raise PluginError(
                f"{who} gives {name} = {shown(value)} of the type {type(value).__name__}."
            )


def check_places(who: str, what: str, places: object, count: int) -> None:
    """Refuse places that are not a tuple of whole numbers from 0 to before a count."""
    if not isinstance(places, tuple) or not all(
        isinstance(place, Integral) and 0 <= int(place) < count for place in places
    ):
        raise PluginError(f"{who} gives {what} that are not places among {count:,}.")


def checked_bits(who: str, what: str, values: object, most: int) -> ByteArray:
    """Return a plug-in's bits or chips as bytes, which it cannot change later."""
    if not isinstance(values, np.ndarray) or values.ndim != 1:
        raise PluginError(f"{who} gives {what} that are not an array of one dimension.")
    if len(values) > most:
        raise PluginError(f"{who} gives {len(values):,} {what}; allowed: up to {most:,}.")
    if values.dtype.kind not in "biuf" or not np.isin(values, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not zeros and ones.")
    return np.array(values, dtype=np.uint8)


def plain_reason(failure: str | None) -> str | None:
    return one_line(failure) if failure else None
