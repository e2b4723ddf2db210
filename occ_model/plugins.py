"""Plug-ins: what installed packages offer under an entry point, read when first needed."""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from threading import get_ident
from typing import TYPE_CHECKING, Any, TypeVar

from occ_model.errors import ParameterError, PluginError, one_line, shown

if TYPE_CHECKING:  # its import is slow, and most scenes ask for no plug-in
    from importlib.metadata import EntryPoint

LINE_CODES = "occ_explorer.line_codes"
FRAMINGS = "occ_explorer.framings"
DECODERS = "occ_explorer.decoders"

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}")  # what a plug-in can be called

_Kind = TypeVar("_Kind")

FAULTS = (Exception, SystemExit)  # what a plug-in may raise that does not end the program


_at_work: dict[int, str] = {}  # the plug-in that each thread is in


@contextmanager
def at_work(who: str) -> Iterator[None]:
    """Note that this thread is in a plug-in, to name it where it hangs."""
    thread = get_ident()
    before = _at_work.get(thread)
    _at_work[thread] = who
    try:
        yield
    finally:
        if before is None:
            del _at_work[thread]
        else:
            _at_work[thread] = before


def all_at_work() -> tuple[str, ...]:
    """Name the plug-ins that threads of this process are in, each as the start of a sentence."""
    return tuple(dict.fromkeys(_at_work.copy().values()))


@lru_cache(maxsize=8)
def _found(group: str) -> "dict[str, EntryPoint]":
    """Find the entry points of a group by names that cannot leave a folder, the first of each."""
    from importlib.metadata import entry_points

    try:
        offered = tuple(entry_points(group=group))
    except Exception:  # noqa: BLE001 - a package's description may be damaged in any way
        return {}
    found: dict[str, EntryPoint] = {}
    for entry in offered:
        if _is_name(entry.name):
            found.setdefault(entry.name, entry)
    return found


def _is_name(name: object) -> bool:
    """Whether a name is safe in lists, scene files and names of files; a package may have any."""
    return isinstance(name, str) and _NAME.fullmatch(name) is not None


def plugin_names(group: str) -> tuple[str, ...]:
    """Return the names of plug-ins in a group, without importing any of them."""
    return tuple(_found(group))


def load_plugin(group: str, name: str, kind: type[_Kind]) -> _Kind:
    """Import a plug-in's object of this name, and check its kind and its own name."""
    entry = _found(group).get(name)
    if entry is None:
        raise PluginError(f"There is no plug-in {one_line(name)!r} of {group}.")
    try:
        with at_work(described(group, name)):
            offered = entry.load()
    except FAULTS as error:
        raise PluginError(f"{described(group, name)} cannot be imported: {reason(error)}") from None
    if not isinstance(offered, kind):
        raise PluginError(
            f"{described(group, name)} is a {type(offered).__name__}, not a {kind.__name__}."
        )
    own = getattr(offered, "name", None)
    if not isinstance(own, str) or own != name:
        raise PluginError(f"{described(group, name)} calls itself {shown(own)}.")
    return offered


def described(group: str, name: str) -> str:
    """Name a plug-in and the package that it comes from, as the start of a sentence."""
    entry = _found(group).get(name)
    package = entry.dist.name if entry is not None and entry.dist is not None else "?"
    return f"The plug-in {one_line(name)!r} of the package {one_line(str(package))!r}"


def called(
    who: str, verb: str, kind: type[_Kind], function: Callable[..., Any], *given: Any
) -> _Kind:
    """Call a plug-in's function; its error becomes a sentence, and its result is checked."""
    try:
        with at_work(who):
            result = function(*given)
    except FAULTS as error:
        if isinstance(error, ParameterError | PluginError) and str(error).isprintable():
            raise  # a sentence already
        raise PluginError(f"{who} cannot {verb}: {reason(error)}") from None
    if not isinstance(result, kind):
        raise PluginError(f"{who} gives a {type(result).__name__}, not a {kind.__name__}.")
    return result


def reason(error: BaseException) -> str:
    """Format a plug-in's exception as the end of a sentence."""
    return f"{type(error).__name__}: {one_line(str(error))}."
