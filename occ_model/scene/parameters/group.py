"""Groups of parameters as frozen dataclasses, each field of which declares a parameter."""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import Field, field
from functools import cache
from typing import Any, ClassVar, Concatenate, ParamSpec, Protocol, Self, TypeVar

from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.parameter_kinds import (
    ChipPattern,
    Choice,
    Count,
    OpenChoice,
    Parameter,
    ParameterValue,
    Payload,
    Quantity,
)

_Arguments = ParamSpec("_Arguments")
_Value_co = TypeVar("_Value_co", covariant=True)


class _HasDefault(Protocol[_Value_co]):
    """A declaration with a default of some type."""

    @property
    def default(self) -> _Value_co: ...


def _field_of(
    kind: Callable[Concatenate[str, _Arguments], _HasDefault[_Value_co]],
) -> Callable[_Arguments, _Value_co]:
    """Make a function that declares a field, with the arguments and type of its declaration."""

    def declare(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> _Value_co:
        declared = kind("", *args, **kwargs)
        return field(default=declared.default, metadata={"declared": declared})

    return declare


quantity_field = _field_of(Quantity)
count_field = _field_of(Count)
choice_field = _field_of(Choice)
open_choice_field = _field_of(OpenChoice)
pattern_field = _field_of(ChipPattern)
payload_field = _field_of(Payload)
text_field = _field_of(CanonicalText)


class Group:
    """Base of the groups, which checks every field against its declaration."""

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    def __post_init__(self) -> None:
        for name, declared in self.declarations().items():
            object.__setattr__(self, name, declared.check(getattr(self, name)))
        self._check_together()

    def _check_together(self) -> None:
        """Refuse values that are allowed one by one but not together."""

    @classmethod
    @cache
    def declarations(cls) -> Mapping[str, Parameter]:
        return {
            name: dataclasses.replace(made.metadata["declared"], name=name)
            for name, made in cls.__dataclass_fields__.items()
        }

    def replace(self, **changes: ParameterValue) -> Self:
        """Return the group with some values changed; only these are checked."""
        made = object.__new__(type(self))
        declarations = self.declarations()
        for name in declarations:
            object.__setattr__(made, name, getattr(self, name))
        for name, value in changes.items():
            object.__setattr__(made, name, declarations[name].check(value))
        made._check_together()
        return made
