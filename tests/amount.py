"""How much is tried: a sample every day, all of it with ``--whole``."""

import os
from typing import TypeVar

WHOLE_VARIABLE = "OCC_WHOLE"
"""Is set while all is tried."""

_Amount = TypeVar("_Amount")


def amount(everyday: _Amount, whole: _Amount) -> _Amount:
    """Return how many cases are tried, how far they are apart, or which."""
    return whole if WHOLE_VARIABLE in os.environ else everyday
