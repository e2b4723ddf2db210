"""What a parameter's names stand for: objects of the program's own files and of plug-ins."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Generic, TypeVar

from occ_model import plugins
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
