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

_SOURCES = {  # what returns an object of a class, for messages
    "Scene": "load_preset('phone-136us')",
    "Room": "load_room('office')",
    "Photo": "load_photo",
    "Video": "load_video",
    "DecodeResult": "decode",
}

# Packages whose objects are checked before a call
_CHECKED_PACKAGES = ("occ_model", "concurrent.futures")
_NUMBERS: dict[type, Any] = {float: Real, int: Integral, bool: bool | np.bool_}
_SEQUENCES = (Iterable, Iterator, Sequence)

_WORDS: dict[Any, str] = {  # names of kinds that are not those of classes
    float: "a number", int: "a whole number", bool: "True or False", str: "a text",
    Path: "a path", Callable: "a function", Mapping: "a mapping", np.ndarray: "an array of numbers",
    type(None): "None", **dict.fromkeys(_SEQUENCES, "a sequence"),
}  # fmt: skip


def check_arguments(function: _Function) -> _Function:
    """Let a public function refuse arguments of another kind than it is annotated with.

    Objects are checked before the call. Numbers, texts and arrays are left to the function, which
    knows their ranges and accepts what works, such as a list for an array; they are checked if it
    raises an error other than an OccError.
    """
    declared = signature(function)
    takes_colours = _takes_colours(function.__module__)

    @wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:
        try:
            values = declared.bind(*arguments, **named).arguments
        except TypeError as error:
            raise TypeError(f"{function.__name__}() {error}") from None
        hints = _hints(function)
        # An iterator fails later, when it is consumed, so that all arguments are checked now.
        is_lazy = _class_of(hints.get("return")) is Iterator
        _refuse_wrong(values, hints, declared, objects_only=not is_lazy)
        for value in () if takes_colours else values.values():
            check = getattr(type(value), "check_one_colour", None)
            if check is not None:
                check(value)
        try:
            return function(*arguments, **named)
        except OccError:
            raise
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            _refuse_wrong(values, hints, declared, objects_only=False)
            raise

    # The name by which pickle finds it in another process.
    call.__module__, call.__qualname__ = "occ_model", function.__name__
    return call  # type: ignore[return-value]


def _takes_colours(module: str) -> bool:
    """Return whether the functions of a module take scenes of three colours, not of one."""
    return module.endswith((".colour", ".video.render")) or module.startswith(
        ("occ_model.scene.", "occ_model.transmitter.")
    )


@cache
def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    return get_type_hints(function)


def _refuse_wrong(
    values: Mapping[str, Any], hints: Mapping[str, Any], declared: Signature, *, objects_only: bool
) -> None:
    """Refuse the first argument of a wrong kind; with ``objects_only`` only objects are checked."""
    for name, value in values.items():
        hint = hints.get(name, Any)
        is_accepted = value is declared.parameters[name].default or (
            objects_only and not _is_of_objects(hint)
        )
        if not is_accepted and not _fits(value, hint):
            raise ParameterError.of(name, quote(value), _describe_allowed(hint))


def _parts(hint: Any) -> tuple[Any, ...]:
    return get_args(hint) if get_origin(hint) in {Union, types.UnionType} else (hint,)


def _class_of(hint: Any) -> Any:
    origin = get_origin(hint)
    # In newer versions of NumPy, NDArray is an alias, which is then the origin.
    origin = get_origin(getattr(origin, "__value__", None)) or origin
    return origin if isinstance(origin, type) else hint


def _is_of_objects(hint: Any) -> bool:
    """Return whether a hint allows only functions and objects of the checked packages."""
    kinds = {_class_of(part) for part in _parts(hint)} - {type(None), Callable}
    return all(
        isinstance(kind, type) and kind.__module__.startswith(_CHECKED_PACKAGES) for kind in kinds
    )


def _fits(value: Any, hint: Any) -> bool:
    return any(_fits_part(value, part) for part in _parts(hint))


def _fits_part(value: Any, hint: Any) -> bool:
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
    is_no_sequence = isinstance(value, str | bytes) or getattr(value, "ndim", 1) == 0
    return isinstance(value, kind) and not (kind in _SEQUENCES and is_no_sequence)


def _is_array(value: Any) -> bool:
    try:
        return np.asarray(value).dtype.kind in "biuf" and np.ndim(value) > 0
    except ValueError:  # rows of several lengths
        return False


def _describe_allowed(hint: Any) -> str:
    return " or ".join(_name_kind(part) for part in _parts(hint))


def _name_kind(hint: Any) -> str:
    if get_origin(hint) is Literal:
        return ", ".join(map(str, get_args(hint)))
    kind = _class_of(hint)
    if kind in _WORDS:
        return _WORDS[kind]
    article = "an" if kind.__name__[0] in "AEIOU" else "a"
    source = _SOURCES.get(kind.__name__)
    return f"{article} {kind.__name__}" + (f", such as {source} gives" if source else "")
