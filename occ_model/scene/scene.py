"""A scene, on which one simulated picture depends, and the settings of its simulation."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import InitVar, dataclass, field, replace
from typing import Any, Literal, Self, TypeAlias

from occ_model.errors import ParameterError, SceneFileError, one_line, quote
from occ_model.scene import toml_format
from occ_model.scene.argument_checks import check_choice, check_seed, check_switches
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import parameter_named
from occ_model.scene.parameters.camera import Camera as Camera, Lens as Lens, Sensor as Sensor
from occ_model.scene.parameters.colour import Colours as Colours
from occ_model.scene.parameters.light import (
    Surroundings as Surroundings,
    Transmitter as Transmitter,
)
from occ_model.scene.parameters.pose_receiver_model import (
    Model as Model,
    Pose as Pose,
    Receiver as Receiver,
)
from occ_model.scene.units import LEVEL

Observable: TypeAlias = Literal["signal", "profile", "image", "decision"]
"""The quantity to which a tolerance refers. "image": the camera's pixels in the panel's bounding
rectangle; "profile": the means of its columns; "signal": these means after the receiver's
enhancement, which a decoder reads; "decision": the code that is read, by the signal's distance from
the threshold."""

OBSERVABLES: tuple[Observable, ...] = ("signal", "profile", "image", "decision")


def unit_of(observable: Observable) -> str:
    """Return the unit of tolerances and errors, as written after a number."""
    return "margins" if observable == "decision" else LEVEL.symbol


TOLERANCE = Quantity(
    "tolerance",
    "Tolerance",
    "",
    "How much the omitted effects may change the observable, in levels of the stretched profile.",
    unit=LEVEL, low=0.0, high=math.inf, slider=(0.01, 100.0), scale="log", default=0.5,
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class SimulationSettings:
    """The settings of :func:`occ_model.render`, which takes them one by one.

    Parameters
    ----------
    tolerance
        How much the omitted effects may change the observable, root mean square in levels of the
        stretched profile.
    observable
        The quantity to which the tolerance refers.
    force
        Effects that the user has switched on (True) or off (False).
    noise
        Ignored: noise is always drawn for every pixel.
    seed
        Seed of all random numbers.
    """

    tolerance: float = TOLERANCE.default
    observable: Observable = "image"
    force: Mapping[str, bool] = field(default_factory=dict)
    noise: InitVar[object] = None
    seed: int = 1

    def check(self, effects: Sequence[str]) -> Self:
        """Return the settings with the tolerance as a float; ParameterError if any is wrong.

        ``effects`` are the names that ``force`` may have.
        """
        check_seed(self.seed)
        tolerance = TOLERANCE.check(self.tolerance)
        check_choice("observable", self.observable, OBSERVABLES)
        force = check_switches(self.force, effects)
        if tolerance is self.tolerance and force == self.force:
            return self
        return replace(self, tolerance=tolerance, force=force)


# No slots: with them, ``scene.code = 5`` gives an obscure message about super() in Python 3.11.
@dataclass(frozen=True, kw_only=True)
class Scene:
    """Everything that one simulated picture depends on.

    A scene is a value: it never changes, compares by content, and can be a dictionary's key. Its
    parameters are in groups; :meth:`replace` and :meth:`value` find them by name.
    """

    transmitter: Transmitter = field(default_factory=Transmitter)
    camera: Camera = field(default_factory=Camera)
    lens: Lens = field(default_factory=Lens)
    sensor: Sensor = field(default_factory=Sensor)
    pose: Pose = field(default_factory=Pose)
    surroundings: Surroundings = field(default_factory=Surroundings)
    receiver: Receiver = field(default_factory=Receiver)
    model: Model = field(default_factory=Model)
    colours: Colours = field(default_factory=Colours)

    def replace(self, **changes: ParameterValue) -> Self:
        """Return the scene with some parameters changed.

        Parameters
        ----------
        **changes
            Parameters by name, in SI units.

        Raises
        ------
        ParameterError
            A name is unknown, or a value is not of its kind or out of range.
        """
        by_group: dict[str, dict[str, Any]] = {}
        for name, value in changes.items():
            by_group.setdefault(group_of(name), {})[name] = value
        groups = {
            group: getattr(self, group).replace(**values) for group, values in by_group.items()
        }
        return dataclasses.replace(self, **groups)

    def value(self, name: str) -> ParameterValue:
        """Return one parameter by name."""
        value: ParameterValue = getattr(getattr(self, group_of(name)), name)
        return value

    def tables(self) -> dict[str, dict[str, ParameterValue]]:
        """Return all parameters, one table for each group.

        There is no table of colours if all of them are at their defaults.
        """
        groups = (group for group in GROUPS if group != "colours" or self.colours != Colours())
        return {
            group: {name: getattr(getattr(self, group), name) for name in GROUPS[group]}
            for group in groups
        }

    def check_one_colour(self) -> None:
        """Raise a ParameterError for a scene of three colours, where only one is simulated."""
        if self.colours.bayer != "none" or self.colours.colour_light != "white":
            from occ_model.scene.colour_scenes import check_monochrome

            check_monochrome(self)

    def colour(self, name: str = "") -> "Scene":
        """Return the ordinary scene of one LED and the colour camera's own pixels for it.

        ``name`` is ``"red"``, ``"green"`` or ``"blue"``; by default the scene's ``shown_colour``.
        See :mod:`occ_model.scene.colour_scenes`.

        Raises
        ------
        ParameterError
            There is no such colour, the camera is monochrome, or a parameter is not allowed for a
            colour camera, such as averaging of pixel values.
        """
        from occ_model.scene.colour_scenes import colour_scene  # needed by colour cameras only

        return colour_scene(self, name or self.colours.shown_colour)

    def to_toml(self) -> str:
        """Write the scene as the text of a scene file."""
        return toml_format.to_toml(self.tables())

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Read the text of a scene file; parameters that it does not name get their defaults.

        Raises
        ------
        SceneFileError
            The text is not a scene file, or has a key that is not a parameter.
        ParameterError
            A value is not of its kind or out of range.
        """
        return cls().with_tables(toml_format.from_toml(text))

    def with_tables(self, tables: Mapping[str, object]) -> Self:
        """Return the scene with the parameters in ``tables`` changed; each table is a group."""
        changes: dict[str, Any] = {}
        for group, values in tables.items():
            if group not in GROUPS:
                raise SceneFileError(
                    f"A scene file has no table [{one_line(group)}]; known are {', '.join(GROUPS)}."
                )
            for name, value in toml_format.table_of(values, group).items():
                try:
                    parameter_named(name, GROUPS[group])
                except ParameterError as error:
                    raise SceneFileError(f"Table [{group}]: {error}") from None
                changes[name] = (
                    _NEW_CHOICES.get((name, value), value) if isinstance(value, str) else value
                )
        return self.replace(**changes)


GROUPS: dict[str, tuple[str, ...]] = {  # names of the parameters by group
    part.name: tuple(getattr(Scene(), part.name).declarations())
    for part in dataclasses.fields(Scene)
}

_NEW_CHOICES = {("band_reading", "charitable"): "aligned"}  # choices renamed since
_GROUP_OF = {name: group for group, names in GROUPS.items() for name in names}


def group_of(name: str) -> str:
    parameter_named(name)
    return _GROUP_OF[name]


def check_scene(value: object) -> None:
    if not isinstance(value, Scene):
        raise ParameterError.of(
            "scene", quote(value), "a Scene, such as load_preset('phone-136us') gives"
        )
