"""A room as a frozen value: lamps with places and directions, and a camera.

Room coordinates are in metres: x and y along the floor, z upwards. At angles of 0 the camera looks
straight up, with its columns along x and its rows along y, and a lamp faces straight down. Angles
turn about x (pitch), then y (yaw), then z (roll), like those of a scene's pose.
"""

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Self

from occ_model.errors import ParameterError, SceneFileError, one_line, quote
from occ_model.scene import toml_format
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.from_text import DEFAULT_PRESET
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import load_preset
from occ_model.scene.scene import GROUPS, Pose, Scene, Transmitter, check_scene
from occ_model.scene.units import METRE, SECOND

MOST_LAMPS = 200
SHAPES = ("rectangle", "disc")

_ANGLES = ("yaw", "pitch", "roll")


def _length(name: str, meaning: str) -> Quantity:
    slider = (-10.0, 10.0)
    return Quantity(
        name, name, "", meaning, unit=METRE, low=-1e3, high=1e3, slider=slider, scale="linear",
        default=0.0,
    )  # fmt: skip


_START = Quantity(
    "start_time", "Start time", "", "When the lamp's light starts, before the room's time 0.",
    unit=SECOND, low=-1e6, high=1e6, slider=(0.0, 0.02), scale="linear", default=0.0,
)  # fmt: skip

HEIGHT = _length("z", "Height.")
"""Height of a lamp or the camera in a room."""

_DECLARATIONS: dict[str, Any] = {
    "x": _length("x", "Place along x."),
    "y": _length("y", "Place along y."),
    "z": HEIGHT,
    **{name: PARAMETERS[name] for name in _ANGLES},
    "start_time": _START,
}


def _check_fields(value: object) -> None:
    for name, declaration in _DECLARATIONS.items():
        if hasattr(value, name):
            object.__setattr__(value, name, declaration.check(getattr(value, name)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """The place and the angles of a camera, in metres and radians.

    Parameters
    ----------
    yaw, pitch, roll
        Rotation about y, x and z; at 0 the camera looks straight up.

    Raises
    ------
    ParameterError
        A value is out of range.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0

    def __post_init__(self) -> None:
        _check_fields(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class RoomLamp:
    """A lamp of a room.

    Parameters
    ----------
    name
        Unique in its room.
    shape
        ``"rectangle"``, or ``"disc"`` of the diameter ``panel_width``.
    x, y, z
        Place of its centre in metres.
    yaw, pitch, roll
        Rotation about y, x and z; at 0 it faces straight down.
    start_time
        When its packet, or a period of its light, starts before the room's time 0, in seconds.
    transmitter
        Its size, light and luminance.

    Raises
    ------
    ParameterError
        A value is out of range.
    """

    name: str
    shape: str = "rectangle"
    x: float = 0.0
    y: float = 0.0
    z: float = 2.5
    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0
    start_time: float = 0.0
    transmitter: Transmitter = field(default_factory=Transmitter)

    def __post_init__(self) -> None:
        is_text = isinstance(self.name, str) and self.name.isprintable()
        if not is_text or not 0 < len(self.name) <= 60:
            raise ParameterError(
                f"A lamp's name is {quote(self.name)}; allowed: 1 to 60 characters in a line."
            )
        try:
            check_choice("shape", self.shape, SHAPES)
            _check_fields(self)
        except ParameterError as error:
            raise error.within(f"Lamp {self.name}") from None

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the lamp in metres; for a disc both are the diameter."""
        width = self.transmitter.panel_width
        return width, width if self.shape == "disc" else self.transmitter.panel_height


@dataclass(frozen=True, slots=True, kw_only=True)
class Room:
    """Lamps and a camera.

    Parameters
    ----------
    lamps
        At most 200.
    scene
        The camera's settings, lens and sensor, the light of the surroundings, and the model. Its
        transmitter is not used, and its pose is set to the default.

    Raises
    ------
    ParameterError
        There is no lamp or more than 200, two have the same name, or a value has the wrong type.
    """

    lamps: tuple[RoomLamp, ...]
    scene: Scene = field(default_factory=Scene)
    camera: Place = field(default_factory=Place)

    def __post_init__(self) -> None:
        check_scene(self.scene)
        # Rooms must not differ by an unused pose.
        object.__setattr__(self, "scene", dataclasses.replace(self.scene, pose=Pose()))
        if not isinstance(self.camera, Place):
            raise ParameterError.of("camera", quote(self.camera), "a Place")
        lamps = tuple(self.lamps) if isinstance(self.lamps, Iterable) else (self.lamps,)
        if not all(isinstance(lamp, RoomLamp) for lamp in lamps):
            raise ParameterError.of("lamps", quote(self.lamps), "a sequence of RoomLamps")
        object.__setattr__(self, "lamps", lamps)
        if not 1 <= len(self.lamps) <= MOST_LAMPS:
            raise ParameterError(f"A room has {len(self.lamps)} lamps; allowed: 1 to {MOST_LAMPS}.")
        names = [lamp.name for lamp in self.lamps]
        for name in names:
            if names.count(name) > 1:
                raise ParameterError(
                    f"Two lamps have the name {name}; allowed: a different name for each lamp."
                )

    @classmethod
    def of_scene(cls, scene: Scene, name: str = "lamp") -> Self:
        """Return the room whose only lamp is a scene's panel, seen from the origin."""
        check_scene(scene)
        pose = scene.pose
        lamp = RoomLamp(
            name=name, x=pose.offset_x, y=pose.offset_y, z=pose.distance,
            yaw=pose.yaw, pitch=pose.pitch, roll=pose.roll, transmitter=scene.transmitter,
        )  # fmt: skip
        return cls(lamps=(lamp,), scene=scene)

    def replace(self, **changes: Any) -> Self:
        """Return the room with changes to its lamps, scene, camera, or single values.

        Parameters
        ----------
        **changes
            ``lamps``, ``scene``, ``camera``; ``x``, ``y``, ``z``, ``yaw``, ``pitch``, ``roll`` of
            the camera; or any parameter of the scene by name.

        Raises
        ------
        ParameterError
            A name is unknown, or a value is out of range.
        """
        parts = {
            name: changes.pop(name) for name in ("lamps", "scene", "camera") if name in changes
        }
        room = dataclasses.replace(self, **parts)
        place = {name: changes.pop(name) for name in Place.__dataclass_fields__ if name in changes}
        for name in changes:
            if name in GROUPS["pose"]:
                raise ParameterError(
                    f"A room has no {name}: each lamp has its place, and the camera "
                    f"{', '.join(Place.__dataclass_fields__)}.",
                    parameters=(name,),
                )
        camera = dataclasses.replace(room.camera, **place)
        return dataclasses.replace(room, camera=camera, scene=room.scene.replace(**changes))

    def with_sent(self, **changes: Any) -> Self:
        """Return the room with parameters of the scene, and of all lamps, changed.

        Raises
        ------
        ParameterError
            A name is unknown, or a value is out of range.
        """
        parameters = {
            name: value for name, value in changes.items() if name in GROUPS["transmitter"]
        }
        lamps = tuple(
            dataclasses.replace(lamp, transmitter=lamp.transmitter.replace(**parameters))
            for lamp in self.lamps
        )
        return self.replace(lamps=lamps, **changes)

    def to_toml(self) -> str:
        """Return the room as the text of a room file."""
        tables = self.scene.tables()
        tables.pop("pose")
        shared = tables["transmitter"]
        lamps = []
        for lamp in self.lamps:
            row = {n: getattr(lamp, n) for n in _LAMP_KEYS}
            parameters = {n: getattr(lamp.transmitter, n) for n in GROUPS["transmitter"]}
            lamps.append({**row, **{n: v for n, v in parameters.items() if v != shared[n]}})
        return toml_format.to_toml(
            {**tables, "place": dataclasses.asdict(self.camera), "lamps": lamps}  # type: ignore[dict-item]
        )

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Read the text of a room file.

        Its tables are those of a scene file, with ``[transmitter]`` for what all lamps share.
        ``based_on`` names a preset for everything that is not stated. ``[place]`` is the camera's
        place, and ``lamps`` a list of tables, each with a lamp's name, shape, place, angles and
        start time, and with the parameters of its transmitter that differ from the shared ones.

        Raises
        ------
        SceneFileError
            The text is not a room file.
        ParameterError
            A value has the wrong type or is out of range; the message names the lamp.
        """
        tables = toml_format.from_toml(text)
        tables.pop("title", None)
        rows, place = tables.pop("lamps", None), tables.pop("place", {})
        base = load_preset(tables.pop("based_on", DEFAULT_PRESET))
        if "pose" in tables:
            raise SceneFileError("A room file has no table [pose]; the camera's place is [place].")
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise SceneFileError("A room file has a list of lamps: 'lamps = [{name = ...}, ...]'.")
        scene = base.with_tables(tables)
        lamps = tuple(_read_lamp(row, scene.transmitter, n) for n, row in enumerate(rows, 1))
        place = toml_format.table_of(place, "place")
        _check_keys(place, tuple(Place.__dataclass_fields__), "Table [place]")
        return cls(lamps=lamps, scene=scene, camera=Place(**place))


_LAMP_KEYS = tuple(n for n in RoomLamp.__dataclass_fields__ if n != "transmitter")


def _read_lamp(row: Mapping[str, Any], shared: Transmitter, number: int) -> RoomLamp:
    label = f"Lamp {number}"
    _check_keys(row, (*_LAMP_KEYS, *GROUPS["transmitter"]), label)
    fields = {name: row[name] for name in _LAMP_KEYS if name in row}
    if "name" not in fields:
        raise SceneFileError(f"{label} has no name; each lamp needs one of its own.")
    parameters = {name: value for name, value in row.items() if name not in _LAMP_KEYS}
    try:
        return RoomLamp(**fields, transmitter=shared.replace(**parameters))
    except ParameterError as error:
        if str(error).startswith("Lamp "):
            raise
        raise error.within(f"{label} ({one_line(str(fields['name']))})") from None


def _check_keys(table: Mapping[str, Any], known: tuple[str, ...], where: str) -> None:
    for name in table:
        if name not in known:
            raise SceneFileError(
                f"{where} has no value {quote(name)}; known are {', '.join(known)}."
            )
