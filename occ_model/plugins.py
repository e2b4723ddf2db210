"""Plug-ins: what installed packages offer under an entry point, read when first needed."""

import re
import signal
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from threading import get_ident
from traceback import walk_tb
from typing import TYPE_CHECKING, Any, TypeVar

from occ_model.errors import ParameterError, PluginError, one_line, shown

if TYPE_CHECKING:  # its import is slow, and most scenes ask for no plug-in
    from importlib.metadata import EntryPoint

LINE_CODES = "occ_explorer.line_codes"
FRAMINGS = "occ_explorer.framings"
DECODERS = "occ_explorer.decoders"

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}")  # what a plug-in can be called

_Kind = TypeVar("_Kind")

_LONGEST_SENTENCE = 1000  # characters of an error of a plug-in that is taken as it is

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
def _find_entries(group: str) -> "dict[str, EntryPoint]":
    """Find the entry points of a group by names that cannot leave a folder, the first of each."""
    from importlib.metadata import entry_points

    try:
        offered = tuple(entry_points(group=group))
    except Exception:  # noqa: BLE001 - a package's description may be damaged in any way
        return {}
    found: dict[str, EntryPoint] = {}
    for entry in offered:
        # Names are shown in lists and written to scene files; a package may have any.
        if isinstance(entry.name, str) and _NAME.fullmatch(entry.name):
            found.setdefault(entry.name, entry)
    return found


def plugin_names(group: str) -> tuple[str, ...]:
    """Return the names of plug-ins in a group, without importing any of them."""
    return tuple(_find_entries(group))


def load_plugin(group: str, name: str, kind: type[_Kind]) -> _Kind:
    """Import a plug-in's object of this name, and check its kind and its own name."""
    entry = _find_entries(group).get(name)
    if entry is None:
        raise PluginError(f"There is no plug-in {one_line(name)!r} of {group}.")
    who = describe(group, name)

    def check(offered: object) -> _Kind:
        if not isinstance(offered, kind):
            raise PluginError(f"{who} is a {type(offered).__name__}, not a {kind.__name__}.")
        own = getattr(offered, "name", None)
        if not isinstance(own, str) or own != name:
            raise PluginError(f"{who} calls itself {shown(own)}.")
        return offered

    return call(who, "be imported", check, entry.load)


def describe(group: str, name: str) -> str:
    """Name a plug-in and the package that it comes from, as the start of a sentence."""
    entry = _find_entries(group).get(name)
    package = entry.dist.name if entry is not None and entry.dist is not None else "?"
    return f"The plug-in {one_line(name)!r} of the package {one_line(str(package))!r}"


def call(
    who: str, verb: str, check: Callable[[Any], _Kind], function: Callable[..., Any], *given: Any
) -> _Kind:
    """Call a plug-in's function, and return what a check makes of its result.

    An exception of either becomes a sentence; even reading a result's attributes may raise one.
    Only the exceptions of signal handlers pass: Ctrl+C, or an order to end the program.
    """
    try:
        with at_work(who):
            return check(function(*given))
    except BaseException as error:
        if _is_of_signal(error):
            raise
        text = _message(error)
        is_sentence = isinstance(error, ParameterError | PluginError) and text.isprintable()
        if is_sentence and len(text) <= _LONGEST_SENTENCE:
            raise
        raise PluginError(f"{who} cannot {verb}: {reason(error)}") from None


def of_kind(who: str, kind: type[_Kind]) -> Callable[[object], _Kind]:
    """Return a check that a plug-in's result is of a kind."""

    def check(result: object) -> _Kind:
        if not isinstance(result, kind):
            raise PluginError(f"{who} gives a {type(result).__name__}, not a {kind.__name__}.")
        return result

    return check


def _is_of_signal(error: BaseException) -> bool:
    if isinstance(error, KeyboardInterrupt):
        return True
    handlers = map(signal.getsignal, signal.valid_signals())
    codes = {getattr(handler, "__code__", None) for handler in handlers}
    return any(frame.f_code in codes for frame, _ in walk_tb(error.__traceback__))


def reason(error: BaseException) -> str:
    """Format a plug-in's exception as the end of a sentence."""
    text = one_line(_message(error)).rstrip(".")
    return f"{one_line(type(error).__name__)}{': ' * bool(text)}{text}."


def _message(error: BaseException) -> str:
    try:
        return str(error)
    except BaseException as another:
        if _is_of_signal(another):
            raise
        return "it has no message that could be read"


_counting: ContextVar[tuple["Faults", ...]] = ContextVar("_counting", default=())


class Faults:
    """How often plug-ins have failed, decoder by decoder, while :meth:`counting`."""

    def __init__(self) -> None:
        self._readings, self._failed = Counter[str](), Counter[str]()
        self._first: dict[str, str] = {}

    @contextmanager
    def counting(self) -> Iterator["Faults"]:
        """Count what is read within the context by this thread."""
        token = _counting.set((*_counting.get(), self))
        try:
            yield self
        finally:
            _counting.reset(token)

    def __str__(self) -> str:
        """Say how often a plug-in has failed, and how first; empty where none has."""
        return " ".join(
            f"With the {decoder} decoder a plug-in failed in {failed:,} of "
            f"{self._readings[decoder]:,} readings; first: {self._first[decoder]}"
            for decoder, failed in self._failed.items()
        )

    def _note(self, decoder: str, fault: str | None) -> None:
        self._readings[decoder] += 1
        if fault is not None:
            self._failed[decoder] += 1
            self._first.setdefault(decoder, fault)


def note_reading(decoder: str, fault: str | None) -> None:
    """Count a decoder's reading, and the fault of a plug-in that has failed in it."""
    for faults in _counting.get():
        faults._note(decoder, fault)
