"""How much is tried: a sample every day, all of it with ``--whole``."""

import os

VARIABLE = "OCC_WHOLE"
"""Is set while all is tried."""


def amount(everyday: int, whole: int) -> int:
    """Return how many cases are tried, or how far they are apart."""
    return whole if VARIABLE in os.environ else everyday
