"""What a parameter's names stand for: the program's own objects, and those of plug-ins, checked."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from numbers import Integral
from typing import Any, Generic, TypeVar

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, one_line, shown
from occ_model.scene.parameters import open_choice

_Kind = TypeVar("_Kind")


@dataclass(frozen=True, eq=False)
class Registry(Generic[_Kind]):
    """The objects that a parameter chooses among, each imported when it is first asked for."""

    parameter: str  # The parameter, which declares the names of the built-in ones
    kind: type[_Kind]
    constant: str  # What a module calls the object that it offers
    package: str  # The folder of the built-in ones, each in its name's file: c_ook.py, _4b6b.py
    group: str  # The entry point of the plug-ins
    guarded: Callable[[_Kind], _Kind]  # Turns the faults of a plug-in's object into sentences

    def names(self) -> tuple[str, ...]:
        """Return all names, those of plug-ins last."""
        return open_choice(self.parameter).all_choices()

    def is_built_in(self, name: str) -> bool:
        return name in open_choice(self.parameter).choices

    def built_in(self) -> dict[str, _Kind]:
        return {name: self.named(name) for name in open_choice(self.parameter).choices}

    @cache  # noqa: B019 - the registries live as long as the program, and names are few
    def named(self, name: str) -> _Kind:
        open_choice(self.parameter).check(name)
        if self.is_built_in(name):
            file = ("_" if name[0].isdigit() else "") + name.replace("-", "_")
            built_in: _Kind = getattr(import_module(f"{self.package}.{file}"), self.constant)
            return built_in
        return self.guarded(plugins.load_plugin(self.group, name, self.kind))


MOST_CHIPS = 65_536  # of a plug-in's period or result: more than any built-in packet has (57,116)


def check_kinds(who: str, given: object, **kinds: Any) -> None:
    """Refuse what a plug-in gives if a part, by its name, is of another kind."""
    for name, kind in kinds.items():
        value = getattr(given, name)
        if not isinstance(value, kind):
            raise PluginError(
                f"{who} gives {name} = {shown(value)} of the type {type(value).__name__}."
            )


def check_places(who: str, what: str, places: object, count: int) -> None:
    """Refuse places that are not a tuple of whole numbers from 0 to before a count."""
    if not isinstance(places, tuple) or not all(
        isinstance(place, Integral) and 0 <= int(place) < count for place in places
    ):
        raise PluginError(f"{who} gives {what} that are not places among {count:,}.")


def checked_bits(who: str, what: str, values: object, most: int) -> ByteArray:
    """Return a plug-in's bits or chips as bytes, which it cannot change later."""
    if not isinstance(values, np.ndarray) or values.ndim != 1:
        raise PluginError(f"{who} gives {what} that are not an array of one dimension.")
    if len(values) > most:
        raise PluginError(f"{who} gives {len(values):,} {what}; allowed: up to {most:,}.")
    if values.dtype.kind not in "biuf" or not np.isin(values, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not zeros and ones.")
    return np.array(values, dtype=np.uint8)


def plain_reason(failure: str | None) -> str | None:
    return one_line(failure) if failure else None
