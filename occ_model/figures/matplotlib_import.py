"""The import of matplotlib, out of reach of what its users have set for figures of their own."""

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
"""The variable that names the file that it reads next."""

_BACKEND = "MPLBACKEND"
"""The variable that names its window; an unknown one stops the import."""


def import_matplotlib() -> None:
    """Import matplotlib with its own defaults, if it is not imported yet.

    A settings file that is damaged, cannot be read or never ends would stop the import, and one of
    another taste would change the figures. The backend that the environment asks for is set
    afterwards, where there is such a backend: a notebook draws its own figures with it.

    Raises
    ------
    OutputError
        matplotlib cannot be imported: say, there is no folder at all that it can write to.
    """
    if "matplotlib" in sys.modules:
        return
    logger = logging.getLogger("matplotlib")
    level, backend = logger.level, os.environ.get(_BACKEND)
    # It tells at length of a folder for its cache that is not there; it does without.
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
    """Hide all settings from this thread's import; nothing else in the process sees a change."""
    before = {name: os.environ.pop(name, None) for name in (_SETTINGS_ELSEWHERE, _BACKEND)}
    os.environ[_SETTINGS_ELSEWHERE] = os.devnull
    exists, thread = os.path.exists, get_ident()

    def exists_but_for_settings(path: str) -> bool:
        return exists(path) and not (path == _SETTINGS_HERE and get_ident() == thread)

    # No variable stands before the working folder's file, and to change the folder would change
    # it for all threads.
    os.path.exists = exists_but_for_settings  # type: ignore[assignment]
    try:
        yield
    finally:
        os.path.exists = exists
        for name, value in before.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
