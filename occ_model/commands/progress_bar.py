"""Progress bars on standard error, which never stop the command that shows them."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

from occ_model.program import discard

_SETTINGS = "TQDM_"  # prefix of the environment variables by which a user changes tqdm's bars


def progress_bar(**options: Any) -> Any:
    """Return a tqdm bar, shown on a terminal whatever the user's environment says."""
    return _bar_class()(file=sys.stderr, **{"disable": None, **options})


def print_above_bar(sentence: str) -> None:
    """Print a line on standard error, above the bar if one is shown."""
    with _full_disk_ignored():
        _bar_class().write(sentence, file=sys.stderr)


@lru_cache(maxsize=1)
def _bar_class() -> Any:
    with _settings_hidden():
        # Slow to import, and only needed where a command takes long. It reads its settings then.
        from tqdm import tqdm

    class Bar(tqdm):  # type: ignore[misc]  # tqdm has no types
        """A bar that is abandoned where it cannot be written: the result counts."""

        def display(self, *arguments: Any, **options: Any) -> None:
            with _full_disk_ignored():
                super().display(*arguments, **options)

        def clear(self, *arguments: Any, **options: Any) -> None:
            with _full_disk_ignored():
                super().clear(*arguments, **options)

        def close(self) -> None:
            with _full_disk_ignored():
                super().close()

    return Bar


@contextmanager
def _settings_hidden() -> Iterator[None]:
    hidden = {name: os.environ.pop(name) for name in list(os.environ) if name.startswith(_SETTINGS)}
    try:
        yield
    finally:
        os.environ.update(hidden)


@contextmanager
def _full_disk_ignored() -> Iterator[None]:
    """Discard all of standard error from the first failing write on."""
    try:
        yield
    except OSError:
        discard(sys.stderr)
