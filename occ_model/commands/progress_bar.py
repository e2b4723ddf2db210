"""Progress bars on standard error, which never stop a command."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

from occ_model.program import discard

_SETTINGS = "TQDM_"  # prefix of the environment variables that change tqdm's bars


def progress_bar(**options: Any) -> Any:
    """Return a tqdm bar, shown on a terminal regardless of the user's environment."""
    return _bar_class()(file=sys.stderr, **{"disable": None, **options})


def print_above_bar(sentence: str) -> None:
    """Print a line on standard error, above the bar if one is shown."""
    with _ignore_full_disk():
        _bar_class().write(sentence, file=sys.stderr)


@lru_cache(maxsize=1)
def _bar_class() -> Any:
    with _hide_settings():
        # Slow to import, and needed only by long commands. It reads its settings at import.
        from tqdm import tqdm

    class Bar(tqdm):  # type: ignore[misc]  # tqdm has no types
        """A bar that is abandoned if it cannot be written, as only the result matters."""

        def display(self, *arguments: Any, **options: Any) -> None:
            with _ignore_full_disk():
                super().display(*arguments, **options)

        def clear(self, *arguments: Any, **options: Any) -> None:
            with _ignore_full_disk():
                super().clear(*arguments, **options)

        def close(self) -> None:
            with _ignore_full_disk():
                super().close()

    return Bar


@contextmanager
def _hide_settings() -> Iterator[None]:
    hidden = {name: os.environ.pop(name) for name in list(os.environ) if name.startswith(_SETTINGS)}
    try:
        yield
    finally:
        os.environ.update(hidden)


@contextmanager
def _ignore_full_disk() -> Iterator[None]:
    """Discard standard error after the first write that fails."""
    try:
        yield
    except OSError:
        discard(sys.stderr)
