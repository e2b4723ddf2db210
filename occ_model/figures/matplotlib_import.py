"""Import matplotlib with its default settings, whatever the user has set for other figures."""

import logging
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import get_ident

from occ_model.errors import OutputError, one_line

_SETTINGS_HERE = "matplotlibrc"
"""The file in the working folder that matplotlib reads before any other."""

_SETTINGS_ELSEWHERE = "MATPLOTLIBRC"
"""The variable that names the settings file that matplotlib reads next."""

_BACKEND = "MPLBACKEND"
"""The variable that names the backend, which draws windows; an unknown one stops the import."""


def import_matplotlib() -> None:
    """Import matplotlib with its default settings, if it is not imported yet.

    A settings file that is damaged, unreadable or endless would stop the import, and any other
    would change the figures. The backend that the environment names is set afterwards, where it
    exists: a notebook draws its own figures with it.
    """
    if "matplotlib" in sys.modules:
        return
    logger = logging.getLogger("matplotlib")
    level, backend = logger.level, os.environ.get(_BACKEND)
    # It logs warnings of a missing folder for its cache, and works without one.
    logger.setLevel(logging.ERROR)
    try:
        with _without_settings():
            import matplotlib
            import matplotlib.figure  # and the fonts, which are looked for once
    except (OSError, RuntimeError) as error:
        raise OutputError(
            f"Figures cannot be drawn: matplotlib does not start: {one_line(str(error))}."
        ) from None
    finally:
        logger.setLevel(level)
    if backend:
        with suppress(ValueError):
            matplotlib.rcParams["backend"] = backend


@contextmanager
def _without_settings() -> Iterator[None]:
    """Hide all settings files from the import in this thread, and from nothing else."""
    before = {name: os.environ.pop(name, None) for name in (_SETTINGS_ELSEWHERE, _BACKEND)}
    os.environ[_SETTINGS_ELSEWHERE] = os.devnull
    exists, thread = os.path.exists, get_ident()

    def exists_but_for_settings(path: str) -> bool:
        return exists(path) and not (path == _SETTINGS_HERE and get_ident() == thread)

    # The working folder's file is read before any that a variable names, and a change of the
    # working folder would concern all threads.
    os.path.exists = exists_but_for_settings  # type: ignore[assignment]
    try:
        yield
    finally:
        os.path.exists = exists
        for name, value in before.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
