"""Figures and tables for print. No other package imports matplotlib."""

import logging
import os
import sys
from contextlib import suppress

from occ_model.errors import OutputError, one_line

_SET_ASIDE = ("MATPLOTLIBRC", "MPLBACKEND")
"""Environment variables that name a settings file and a backend; a damaged file or an unknown
backend would stop the import."""


def import_matplotlib() -> None:
    """Import matplotlib without the user's settings; a notebook keeps its own backend."""
    if "matplotlib" in sys.modules:
        return
    logger = logging.getLogger("matplotlib")
    level = logger.level
    named = {name: os.environ.pop(name) for name in _SET_ASIDE if name in os.environ}
    os.environ["MATPLOTLIBRC"] = os.devnull  # in place of the user's file
    # It would log a warning about a missing cache folder, but works without one.
    logger.setLevel(logging.ERROR)
    try:
        import matplotlib
        import matplotlib.figure  # which also searches for fonts, once
    except (OSError, RuntimeError) as error:
        raise OutputError(
            f"Figures cannot be drawn, as matplotlib does not start: {one_line(str(error))}."
        ) from None
    finally:
        logger.setLevel(level)
        del os.environ["MATPLOTLIBRC"]
        os.environ.update(named)
    if backend := named.get("MPLBACKEND"):
        with suppress(ValueError):
            matplotlib.rcParams["backend"] = backend


# This comes before any module of this package imports matplotlib.
import_matplotlib()
