"""The parameters of a scene, each declared once: range, unit, slider, default, meaning.

Sliders, number fields, tooltips, command-line settings, validation, the keys of a scene file and
the manual's table are all made from these declarations. Values are in SI units.
"""

from collections.abc import Iterable
from difflib import get_close_matches

from occ_model.errors import ParameterError, shown
from occ_model.scene.parameter_kinds import Count, OpenChoice, Parameter, Payload, Quantity
from occ_model.scene.parameters.camera import Camera, Lens, Sensor
from occ_model.scene.parameters.group import Group
from occ_model.scene.parameters.light import Surroundings, Transmitter
from occ_model.scene.parameters.pose_receiver_model import Model, Pose, Receiver

_GROUPS: tuple[type[Group], ...] = (
    Transmitter,
    Camera,
    Lens,
    Sensor,
    Pose,
    Surroundings,
    Receiver,
    Model,
)

PARAMETERS: dict[str, Parameter] = {
    name: declared for group in _GROUPS for name, declared in group.declarations().items()
}


def parameter_named(name: str, among: Iterable[str] = PARAMETERS) -> Parameter:
    """Find a declaration.

    Raises
    ------
    ParameterError
        There is no parameter of that name among ``among``; the closest one is suggested.
    """
    names = list(among)
    if name in names:
        return PARAMETERS[name]
    near = get_close_matches(name, names, n=1)
    hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(names)}."
    raise ParameterError(f"There is no parameter {shown(name)}; {hint}")


def count(name: str) -> Count:
    """Return the declaration of a parameter that is a whole number.

    Raises
    ------
    TypeError
        It is of another kind.
    """
    declared = PARAMETERS[name]
    if not isinstance(declared, Count):
        raise TypeError(f"{name} is no count")
    return declared


def quantity(name: str) -> Quantity:
    """Return the declaration of a parameter that is a quantity, with a unit and a slider.

    Raises
    ------
    TypeError
        It is a choice, a count or a pattern.
    """
    declared = PARAMETERS[name]
    if not isinstance(declared, Quantity):
        raise TypeError(f"{name} is no quantity")
    return declared


def open_choice(name: str) -> OpenChoice:
    """Return the declaration of a parameter that is a choice which plug-ins extend.

    Raises
    ------
    TypeError
        It is of another kind.
    """
    declared = PARAMETERS[name]
    if not isinstance(declared, OpenChoice):
        raise TypeError(f"{name} is no choice that plug-ins extend")
    return declared


def payload_parameter() -> Payload:
    """Return the declaration of the payload.

    Raises
    ------
    TypeError
        It is of another kind.
    """
    declared = PARAMETERS["payload"]
    if not isinstance(declared, Payload):
        raise TypeError("payload is no payload")
    return declared
