"""A scene: everything that one simulated picture depends on, as frozen values."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Self

from occ_model.errors import ParameterError, SceneFileError, one_line, shown
from occ_model.scene import toml_format
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS, parameter_named
from occ_model.scene.payload import bits_of_payload

_DIAGONAL_35MM = 0.04327
"""Diagonal of a 24 mm x 36 mm picture in metres, to which equivalent focal lengths refer."""


def _declared(name: str) -> Any:
    """Make a dataclass field whose default is the declaration's."""
    return field(default=PARAMETERS[name].default)


class _Checked:
    """Base of the parameter groups: checks every field against its declaration."""

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Any]]

    def __post_init__(self) -> None:
        for name in self.__dataclass_fields__:
            if name in PARAMETERS:
                object.__setattr__(self, name, PARAMETERS[name].check(getattr(self, name)))
        self._check_together()

    def _check_together(self) -> None:
        """Refuse values that are allowed each but not together."""

    def replaced(self, changes: Mapping[str, ParameterValue]) -> Self:
        """Return the group with some values changed; only these are checked again."""
        made = object.__new__(type(self))
        for name in self.__dataclass_fields__:
            object.__setattr__(made, name, getattr(self, name))
        for name, value in changes.items():
            object.__setattr__(made, name, PARAMETERS[name].check(value))
        made._check_together()
        return made


@dataclass(frozen=True, slots=True, kw_only=True)
class Transmitter(_Checked):
    """The LED panel, its light and its code."""

    code: int = _declared("code")
    bits: int = _declared("bits")
    payload: str = _declared("payload")
    line_code: str = _declared("line_code")
    framing: str = _declared("framing")
    preamble: str = _declared("preamble")
    error_correction: str = _declared("error_correction")
    pattern: str = _declared("pattern")
    switching_frequency: float = _declared("switching_frequency")
    luminance: float = _declared("luminance")
    panel_width: float = _declared("panel_width")
    panel_height: float = _declared("panel_height")
    edge_time: float = _declared("edge_time")
    lambertian_order: float = _declared("lambertian_order")

    def _check_together(self) -> None:
        if self.code >= 2**self.bits:
            raise ParameterError(
                f"code is {self.code}; allowed with {self.bits} bits: 0 to {2**self.bits - 1}.",
                parameters=("code", "bits"),
            )

    @property
    def payload_bits(self) -> tuple[int, ...]:
        """The bits that are sent, first sent first: the payload's, or the code's without one."""
        if self.payload:
            return bits_of_payload(self.payload)
        return tuple(self.code >> place & 1 for place in reversed(range(self.bits)))

    @property
    def payload_length(self) -> int:
        """How many bits are sent."""
        return len(self.payload_bits) if self.payload else self.bits

    @property
    def switching_period(self) -> float:
        """Length of one chip, t_LED = 1/f, in seconds."""
        return 1.0 / self.switching_frequency


@dataclass(frozen=True, slots=True, kw_only=True)
class Camera(_Checked):
    """The rolling-shutter camera and its settings."""

    exposure_time: float = _declared("exposure_time")
    readout_time: float = _declared("readout_time")
    iso: float = _declared("iso")
    f_number: float = _declared("f_number")
    gamma: float = _declared("gamma")
    meter_constant: float = _declared("meter_constant")
    rows: int = _declared("rows")
    columns: int = _declared("columns")
    equivalent_focal_length: float = _declared("equivalent_focal_length")
    jpeg_quality: int = _declared("jpeg_quality")

    @property
    def focal_length_pixels(self) -> float:
        """Focal length in pixels; it does not depend on the size of a pixel."""
        diagonal: float = (self.rows**2 + self.columns**2) ** 0.5
        return self.equivalent_focal_length / _DIAGONAL_35MM * diagonal


@dataclass(frozen=True, slots=True, kw_only=True)
class Lens(_Checked):
    """The lens: vignetting, distortion, point spread and focus."""

    vignetting_exponent: float = _declared("vignetting_exponent")
    radial_k1: float = _declared("radial_k1")
    radial_k2: float = _declared("radial_k2")
    tangential_p1: float = _declared("tangential_p1")
    tangential_p2: float = _declared("tangential_p2")
    point_spread: float = _declared("point_spread")
    focus_distance: float = _declared("focus_distance")

    @property
    def distorts(self) -> bool:
        """Whether it bends straight lines."""
        return any((self.radial_k1, self.radial_k2, self.tangential_p1, self.tangential_p2))


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor(_Checked):
    """The sensor's pixels: size, efficiency, capacity, noise, converter."""

    pixel_pitch: float = _declared("pixel_pitch")
    quantum_efficiency: float = _declared("quantum_efficiency")
    full_well: float = _declared("full_well")
    read_noise: float = _declared("read_noise")
    gain_variation: float = _declared("gain_variation")
    adc_bits: int = _declared("adc_bits")


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose(_Checked):
    """The panel's position and rotation as seen by the camera."""

    distance: float = _declared("distance")
    offset_x: float = _declared("offset_x")
    offset_y: float = _declared("offset_y")
    yaw: float = _declared("yaw")
    pitch: float = _declared("pitch")
    roll: float = _declared("roll")


@dataclass(frozen=True, slots=True, kw_only=True)
class Surroundings(_Checked):
    """The light that does not come from the panel, and its flicker."""

    illuminance: float = _declared("illuminance")
    reflectance: float = _declared("reflectance")
    flicker_depth: float = _declared("flicker_depth")
    flicker_frequency: float = _declared("flicker_frequency")
    flicker_phase: float = _declared("flicker_phase")


@dataclass(frozen=True, slots=True, kw_only=True)
class Receiver(_Checked):
    """Settings of the receiver."""

    bright_fraction: float = _declared("bright_fraction")
    equalizer: str = _declared("equalizer")


@dataclass(frozen=True, slots=True, kw_only=True)
class Model(_Checked):
    """The start time, and the choices that the model leaves open."""

    start_time: float = _declared("start_time")
    averaging: str = _declared("averaging")
    enhancement: str = _declared("enhancement")
    band_reading: str = _declared("band_reading")


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Everything that one simulated picture depends on.

    A scene is a value: it never changes, compares by content, and can be a dictionary's key.
    Its parameters stand in groups; :meth:`replace` and :meth:`value` find them by name.
    """

    transmitter: Transmitter = field(default_factory=Transmitter)
    camera: Camera = field(default_factory=Camera)
    lens: Lens = field(default_factory=Lens)
    sensor: Sensor = field(default_factory=Sensor)
    pose: Pose = field(default_factory=Pose)
    surroundings: Surroundings = field(default_factory=Surroundings)
    receiver: Receiver = field(default_factory=Receiver)
    model: Model = field(default_factory=Model)

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
            group: getattr(self, group).replaced(values) for group, values in by_group.items()
        }
        return dataclasses.replace(self, **groups)

    def value(self, name: str) -> ParameterValue:
        """Return one parameter by name."""
        value: ParameterValue = getattr(getattr(self, group_of(name)), name)
        return value

    def tables(self) -> dict[str, dict[str, ParameterValue]]:
        """Return all parameters, one table for each group."""
        return {
            group: {name: getattr(getattr(self, group), name) for name in names}
            for group, names in GROUPS.items()
        }

    def to_toml(self) -> str:
        """Write the scene as the text of a scene file."""
        return toml_format.to_toml(self.tables())

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Read the text of a scene file; parameters that it does not name have their defaults.

        Raises
        ------
        SceneFileError
            The text is no scene file, or has a key that is not a parameter.
        ParameterError
            A value is not of its kind or out of range.
        """
        return cls().with_tables(toml_format.from_toml(text))

    def with_tables(self, tables: Mapping[str, object]) -> Self:
        """Return the scene with the parameters of ``tables`` changed, each in its own group."""
        changes: dict[str, Any] = {}
        for group, values in tables.items():
            if group not in GROUPS:
                raise SceneFileError(
                    f"A scene file has no table [{one_line(group)}]; known are {', '.join(GROUPS)}."
                )
            if not isinstance(values, Mapping):
                raise SceneFileError(f"{group} must be a table: a line '[{group}]' and its keys.")
            for name, value in values.items():
                try:
                    parameter_named(name, GROUPS[group])
                except ParameterError as error:
                    raise SceneFileError(f"Table [{group}]: {error}") from None
                changes[name] = value
        return self.replace(**changes)


_GROUP_TYPES: dict[str, type[_Checked]] = {
    "transmitter": Transmitter,
    "camera": Camera,
    "lens": Lens,
    "sensor": Sensor,
    "pose": Pose,
    "surroundings": Surroundings,
    "receiver": Receiver,
    "model": Model,
}

GROUPS: dict[str, tuple[str, ...]] = {
    group: tuple(kind.__dataclass_fields__) for group, kind in _GROUP_TYPES.items()
}
"""The names of the parameters, group by group."""

_GROUP_OF = {name: group for group, names in GROUPS.items() for name in names}


def group_of(name: str) -> str:
    """Return the group of a scene that a parameter belongs to."""
    parameter_named(name)
    return _GROUP_OF[name]


def check_scene(value: object) -> None:
    """Refuse a value that is not a scene.

    Raises
    ------
    ParameterError
        Naming the value and how to load a scene.
    """
    if not isinstance(value, Scene):
        raise ParameterError(
            f"scene is {shown(value)}; allowed: a Scene, such as load_preset('phone-136us') gives."
        )
