"""Plug-ins: objects that installed packages provide by entry points, imported when first needed."""

import re
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeVar

from occ_model.errors import ParameterError, PluginError, one_line, quote

if TYPE_CHECKING:  # its import is slow, and most scenes ask for no plug-in
    from importlib.metadata import EntryPoint

LINE_CODES = "occ_explorer.line_codes"
FRAMINGS = "occ_explorer.framings"
DECODERS = "occ_explorer.decoders"

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}")  # allowed names of plug-ins

_Kind = TypeVar("_Kind")


@lru_cache(maxsize=8)
def _find_entries(group: str) -> "dict[str, EntryPoint]":
    """Find a group's entry points by name, the first of each name that is safe in a path."""
    from importlib.metadata import entry_points

    try:
        entries = tuple(entry_points(group=group))
    except Exception:  # noqa: BLE001 - a package's description may be damaged in any way
        return {}
    by_name: dict[str, EntryPoint] = {}
    for entry in entries:
        # Names appear in lists and scene files, and a package may contain any text.
        if isinstance(entry.name, str) and _NAME.fullmatch(entry.name):
            by_name.setdefault(entry.name, entry)
    return by_name


def plugin_names(group: str) -> tuple[str, ...]:
    """Return the names of plug-ins in a group, without importing any of them."""
    return tuple(_find_entries(group))


def load_plugin(group: str, name: str, kind: type[_Kind]) -> _Kind:
    """Import a plug-in's object of this name, and check its kind and its own name."""
    entry = _find_entries(group).get(name)
    if entry is None:
        raise PluginError(f"There is no plug-in {one_line(name)!r} of {group}.")
    who = describe(group, name)

    def check(plugin: object) -> _Kind:
        if not isinstance(plugin, kind):
            raise PluginError(f"{who} is a {type(plugin).__name__}, not a {kind.__name__}.")
        name_of_object = getattr(plugin, "name", None)
        if not isinstance(name_of_object, str) or name_of_object != name:
            raise PluginError(f"{who} calls itself {quote(name_of_object)}.")
        return plugin

    return call(who, "be imported", check, entry.load)


def describe(group: str, name: str) -> str:
    """Name a plug-in and the package that it comes from, as the start of a sentence."""
    entry = _find_entries(group).get(name)
    package = entry.dist.name if entry is not None and entry.dist is not None else "?"
    return f"The plug-in {one_line(name)!r} of the package {one_line(str(package))!r}"


def call(
    who: str,
    verb: str,
    check: Callable[[Any], _Kind],
    function: Callable[..., Any],
    *arguments: Any,
) -> _Kind:
    """Call a plug-in's function, and return its result after a check.

    An exception of either becomes a sentence, also one that would end the program. Ctrl-C passes.
    """
    try:
        return check(function(*arguments))
    except (ParameterError, PluginError):
        raise
    except (Exception, SystemExit) as error:  # noqa: BLE001 - a plug-in raises anything
        text = one_line(str(error)).rstrip(".")
        reason = f"{type(error).__name__}{': ' * bool(text)}{text}."
        raise PluginError(f"{who} cannot {verb}: {reason}") from None


def of_kind(who: str, kind: type[_Kind]) -> Callable[[object], _Kind]:
    """Return a check that a plug-in's result is of a kind."""

    def check(result: object) -> _Kind:
        if not isinstance(result, kind):
            raise PluginError(f"{who} gives a {type(result).__name__}, not a {kind.__name__}.")
        return result

    return check


_counting: ContextVar[tuple["Faults", ...]] = ContextVar("_counting", default=())


class Faults:
    """The number of failures of plug-ins for each decoder, within :meth:`counting`."""

    def __init__(self) -> None:
        self._readings, self._failed = Counter[str](), Counter[str]()
        self._first: dict[str, str] = {}

    @contextmanager
    def counting(self) -> Iterator["Faults"]:
        """Count the readings by this thread within the context."""
        token = _counting.set((*_counting.get(), self))
        try:
            yield self
        finally:
            _counting.reset(token)

    def __str__(self) -> str:
        """State how often plug-ins failed, and the first failure; empty if none failed."""
        return " ".join(
            f"With the {decoder} decoder a plug-in failed in {failures:,} of "
            f"{self._readings[decoder]:,} readings; first: {self._first[decoder]}"
            for decoder, failures in self._failed.items()
        )

    def _note(self, decoder: str, fault: str | None) -> None:
        self._readings[decoder] += 1
        if fault is not None:
            self._failed[decoder] += 1
            self._first.setdefault(decoder, fault)


def note_reading(decoder: str, fault: str | None) -> None:
    """Count a decoder's reading, and the fault of a plug-in if one failed in it."""
    for faults in _counting.get():
        faults._note(decoder, fault)
