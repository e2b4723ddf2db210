"""The parameters of a scene, each declared once: range, unit, slider, default, meaning.

Sliders, number fields, tooltips, command-line settings, validation, the keys of a scene file and
the manual's table are all made from these declarations. Values are in SI units.
"""

from collections.abc import Iterable
from typing import TypeVar

from occ_model.errors import ParameterError, quote
from occ_model.scene.parameter_kinds import Count, OpenChoice, Parameter, Payload, Quantity
from occ_model.scene.parameters.camera import Camera, Lens, Sensor
from occ_model.scene.parameters.colour import Colours
from occ_model.scene.parameters.group import Group
from occ_model.scene.parameters.light import Surroundings, Transmitter
from occ_model.scene.parameters.pose_receiver_model import Model, Pose, Receiver

_Kind = TypeVar("_Kind", bound=Parameter)

_GROUPS: tuple[type[Group], ...] = (
    Transmitter,
    Camera,
    Lens,
    Sensor,
    Pose,
    Surroundings,
    Receiver,
    Model,
    Colours,
)

PARAMETERS: dict[str, Parameter] = {
    name: declared for group in _GROUPS for name, declared in group.declarations().items()
}


def parameter_named(name: str, among: Iterable[str] = PARAMETERS) -> Parameter:
    names = list(among)
    if name in names:
        return PARAMETERS[name]
    from difflib import get_close_matches  # slow to import, and needed only after a mistake

    near = get_close_matches(name, names, n=1)
    hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(names)}."
    raise ParameterError(f"There is no parameter {quote(name)}; {hint}")


def _declaration_of_kind(name: str, kind: type[_Kind]) -> _Kind:
    """Return a declaration; TypeError if it is of another kind."""
    declared = PARAMETERS[name]
    if not isinstance(declared, kind):
        raise TypeError(f"{name} is declared as a {type(declared).__name__}, not a {kind.__name__}")
    return declared


def count(name: str) -> Count:
    return _declaration_of_kind(name, Count)


def quantity(name: str) -> Quantity:
    return _declaration_of_kind(name, Quantity)


def open_choice(name: str) -> OpenChoice:
    return _declaration_of_kind(name, OpenChoice)


def payload_parameter() -> Payload:
    return _declaration_of_kind("payload", Payload)
