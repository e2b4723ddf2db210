"""The check of the bits and chips that plug-ins give: their type and their number."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, one_line

MOST_CHIPS = 65_536  # of a plug-in's period or result: more than any built-in packet has (57,116)


def checked_bits(who: str, what: str, values: object, most: int) -> ByteArray:
    """Return a plug-in's bits or chips as bytes, which it cannot change later."""
    if not isinstance(values, np.ndarray) or values.ndim != 1:
        raise PluginError(f"{who} gives {what} that are not an array of one dimension.")
    if len(values) > most:
        raise PluginError(f"{who} gives {len(values):,} {what}; allowed: up to {most:,}.")
    if not np.isin(values, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not zeros and ones.")
    return np.array(values, dtype=np.uint8)


def plain_reason(failure: str | None) -> str | None:
    return None if failure is None else one_line(failure)
