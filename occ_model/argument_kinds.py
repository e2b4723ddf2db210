"""Refuse arguments of a wrong kind, by the annotations of the public functions.

A public function therefore need not check what its annotations say.
"""

import types
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, wraps
from inspect import Signature, signature
from numbers import Integral, Real
from pathlib import Path
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from occ_model.errors import OccError, ParameterError, quote

_Function = TypeVar("_Function", bound=Callable[..., Any])

_MADE_BY = {  # what returns a value of a class, for its sentence
    "Scene": "load_preset('phone-136us')",
    "Room": "load_room('office')",
    "Photo": "load_photo",
    "Video": "load_video",
    "DecodeResult": "decode",
}

_OURS = ("occ_model", "concurrent.futures")  # packages whose classes are refused before work
_NUMBERS: dict[type, Any] = {float: Real, int: Integral, bool: bool | np.bool_}
_ROWS = (Iterable, Iterator, Sequence)

_WORDS: dict[Any, str] = {  # names of kinds that are not those of classes
    float: "a number", int: "a whole number", bool: "True or False", str: "a text",
    Path: "a path", Callable: "a function", Mapping: "a mapping", np.ndarray: "an array of numbers",
    type(None): "None", **dict.fromkeys(_ROWS, "a sequence"),
}  # fmt: skip


def checked(function: _Function) -> _Function:
    """Let a public function refuse arguments of another kind than it is annotated with.

    Objects are checked before any work. Numbers, texts and arrays are left to the function, which
    knows the range and accepts all that works, such as a list for an array: the argument is named
    only where it fails by an error that is not ours.
    """
    form = signature(function)

    @wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:
        try:
            given = form.bind(*arguments, **named).arguments
        except TypeError as error:
            raise TypeError(f"{function.__name__}() {error}") from None
        hints = _hints(function)
        # What fails later, while it is iterated over, is not seen to fail here.
        is_lazy = _class_of(hints.get("return")) is Iterator
        _refuse_wrong(given, hints, form, at_once=not is_lazy)
        try:
            return function(*arguments, **named)
        except OccError:
            raise
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            _refuse_wrong(given, hints, form, at_once=False)
            raise

    # As which it is found again where it is sent to another process.
    call.__module__, call.__qualname__ = "occ_model", function.__name__
    return call  # type: ignore[return-value]


@cache
def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    return get_type_hints(function)


def _refuse_wrong(
    given: Mapping[str, Any], hints: Mapping[str, Any], form: Signature, *, at_once: bool
) -> None:
    """Refuse the first argument of a wrong kind; with ``at_once`` only objects are checked."""
    for name, value in given.items():
        hint = hints.get(name, Any)
        is_left = value is form.parameters[name].default or (at_once and not _is_of_objects(hint))
        if not is_left and not _fits(value, hint):
            raise ParameterError.of(name, quote(value), _allowed(hint))


def _parts(hint: Any) -> tuple[Any, ...]:
    return get_args(hint) if get_origin(hint) in {Union, types.UnionType} else (hint,)


def _class_of(hint: Any) -> Any:
    origin = get_origin(hint)
    # Newer versions of numpy have an alias for their arrays, of which the origin is that alias.
    origin = get_origin(getattr(origin, "__value__", None)) or origin
    return origin if isinstance(origin, type) else hint


def _is_of_objects(hint: Any) -> bool:
    """Whether a hint means only objects of these classes, or functions."""
    kinds = {_class_of(part) for part in _parts(hint)} - {type(None), Callable}
    return all(isinstance(kind, type) and kind.__module__.startswith(_OURS) for kind in kinds)


def _fits(value: Any, hint: Any) -> bool:
    return any(_is_one(value, part) for part in _parts(hint))


def _is_one(value: Any, hint: Any) -> bool:
    if get_origin(hint) is Literal:
        return isinstance(value, str)
    kind = _class_of(hint)
    if not isinstance(kind, type):
        return True
    if kind is np.ndarray:
        return _is_array(value)
    if kind in _NUMBERS:
        is_switch = isinstance(value, _NUMBERS[bool])
        return isinstance(value, _NUMBERS[kind]) and is_switch == (kind is bool)
    is_no_row = isinstance(value, str | bytes) or getattr(value, "ndim", 1) == 0
    return isinstance(value, kind) and not (kind in _ROWS and is_no_row)


def _is_array(value: Any) -> bool:
    try:
        return np.asarray(value).dtype.kind in "biuf" and np.ndim(value) > 0
    except ValueError:  # rows of several lengths
        return False


def _allowed(hint: Any) -> str:
    return " or ".join(_named(part) for part in _parts(hint))


def _named(hint: Any) -> str:
    if get_origin(hint) is Literal:
        return ", ".join(map(str, get_args(hint)))
    kind = _class_of(hint)
    if kind in _WORDS:
        return _WORDS[kind]
    article = "an" if kind.__name__[0] in "AEIOU" else "a"
    made = _MADE_BY.get(kind.__name__)
    return f"{article} {kind.__name__}" + (f", such as {made} gives" if made else "")
