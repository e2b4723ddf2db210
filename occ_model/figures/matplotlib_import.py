"""Import matplotlib so that what the environment names for other figures does not stop it."""

import logging
import os
import sys
from contextlib import suppress

from occ_model.errors import OutputError, one_line

_SET_ASIDE = ("MATPLOTLIBRC", "MPLBACKEND")
"""Variables that name a settings file and a backend: one that is damaged or unknown stops the
import."""


def import_matplotlib() -> None:
    """Import matplotlib without its user's settings; a notebook keeps its own backend."""
    if "matplotlib" in sys.modules:
        return
    logger = logging.getLogger("matplotlib")
    level = logger.level
    named = {name: os.environ.pop(name) for name in _SET_ASIDE if name in os.environ}
    os.environ["MATPLOTLIBRC"] = os.devnull  # in place of the user's own
    # It logs warnings of a missing folder for its cache, and works without one.
    logger.setLevel(logging.ERROR)
    try:
        import matplotlib
        import matplotlib.figure  # and the fonts, which are looked for once
    except (OSError, RuntimeError) as error:
        raise OutputError(
            f"Figures cannot be drawn: matplotlib does not start: {one_line(str(error))}."
        ) from None
    finally:
        logger.setLevel(level)
        del os.environ["MATPLOTLIBRC"]
        os.environ.update(named)
    if backend := named.get("MPLBACKEND"):
        with suppress(ValueError):
            matplotlib.rcParams["backend"] = backend
