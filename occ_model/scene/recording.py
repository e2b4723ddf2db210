"""How a film is recorded: frame rate, jitter, drift of clocks, motion, exposure times."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields, replace
from fractions import Fraction
from itertools import pairwise
from typing import Literal, Self, TypeAlias

from occ_model.errors import ParameterError, quote
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.parameters.pose_receiver_model import Pose
from occ_model.scene.scene import Scene
from occ_model.scene.toml_format import parse_toml
from occ_model.scene.units import HERTZ, PPM, SECOND

FrameTimes: TypeAlias = Literal["measured", "nominal"]  # when each frame started, or equal steps
FRAME_TIMES: tuple[FrameTimes, ...] = ("measured", "nominal")

# fmt: off
FRAME_RATE = Quantity(
    "frame_rate", "Frame rate", "", "Frames a second, by the camera's own clock.",
    unit=HERTZ, low=1e-3, high=1e5, slider=(24.0, 240.0), scale="log", default=30.0,
)
FRAME_JITTER = Quantity(
    "frame_jitter", "Frame jitter", "",
    "Standard deviation of a frame's start from its nominal time.",
    unit=SECOND, low=0.0, high=1.0, slider=(0.0, 1e-4), scale="linear", default=0.0,
)
CAMERA_DRIFT = Quantity(
    "camera_drift", "Camera's clock", "", "How much the camera's clock runs too fast.",
    unit=PPM, low=-1e-2, high=1e-2, slider=(-1e-4, 1e-4), scale="linear", default=0.0,
)
TRANSMITTER_DRIFT = Quantity(
    "transmitter_drift", "LED's clock", "", "How much the LED's clock runs too fast.",
    unit=PPM, low=-1e-2, high=1e-2, slider=(-1e-4, 1e-4), scale="linear", default=0.0,
)
# fmt: on

DECLARED: tuple[Quantity, ...] = (FRAME_RATE, FRAME_JITTER, CAMERA_DRIFT, TRANSMITTER_DRIFT)
"""Declarations of the quantities of a recording: unit, range, slider, default."""

MOTIONS = tuple(Pose.declarations())  # the parameters of a waypoint are those of the pose
_PREFIX = "recording."  # before the name of each setting in a film's description
_JITTERS_IN_GAP = 6  # the gap must hold three standard deviations of jitter on either side


@dataclass(frozen=True, slots=True)
class Waypoint:
    """A point on a path: a time, and how far the panel has moved from its pose in the scene.

    Motion is relative to the camera, so that it stands for a moving panel or a moving camera.

    Parameters
    ----------
    time
        In seconds by the camera's clock, 0 at the film's first frame.
    distance, offset_x, offset_y, yaw, pitch, roll
        Changes of the scene's parameters, in metres and radians.
    """

    time: float
    distance: float = 0.0
    offset_x: float = 0.0
    offset_y: float = 0.0
    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """How a film of a scene is recorded.

    The camera's clock sets the frames' times, the exposure time and the readout time; the LED's
    clock sets the switching frequency. A clock that is too fast by d makes its times shorter by
    1 / (1 + d) and its frequencies higher by 1 + d.

    Parameters
    ----------
    frame_rate
        Frames a second by the camera's clock, in Hz.
    frame_jitter
        Standard deviation of a frame's start from its nominal time, in seconds. A start deviates by
        at most half a gap, so that frames do not overlap.
    camera_drift, transmitter_drift
        How much each clock runs too fast: 1e-6 is one part in a million (ppm).
    path
        The panel's path: straight lines between waypoints, at rest before the first and after the
        last. Within a frame the panel rests where it is when the frame starts. If empty, it stays
        where the scene has it.
    exposure_times
        Exposure times of the frames in seconds, repeated in turn; if empty, the scene's.
    frame_times
        The times stated by the frames: ``"measured"``, when each started, or ``"nominal"``, equal
        steps despite the jitter.

    Raises
    ------
    ParameterError
        A value is of the wrong kind or out of range, or the waypoints are not in the order of time.
    """

    frame_rate: float = FRAME_RATE.default
    frame_jitter: float = FRAME_JITTER.default
    camera_drift: float = CAMERA_DRIFT.default
    transmitter_drift: float = TRANSMITTER_DRIFT.default
    path: tuple[Waypoint, ...] = ()
    exposure_times: tuple[float, ...] = ()
    frame_times: FrameTimes = "measured"

    def __post_init__(self) -> None:
        for declared in DECLARED:
            object.__setattr__(self, declared.name, declared.check(getattr(self, declared.name)))
        check_choice("frame_times", self.frame_times, FRAME_TIMES)
        object.__setattr__(self, "path", _check_path(self.path))
        object.__setattr__(self, "exposure_times", _check_exposure_times(self.exposure_times))

    def replace(self, **changes: object) -> Self:
        """Return the recording with some settings changed.

        Raises
        ------
        ParameterError
            There is no such setting, or a value is out of range.
        """
        known = [each.name for each in fields(self)]
        for name in changes:
            check_choice("setting of a recording", name, known)
        return replace(self, **changes)  # type: ignore[arg-type]

    def lines(self) -> list[str]:
        """Write the recording as lines of TOML whose keys begin with ``recording.``."""
        values: dict[str, object] = {each.name: getattr(self, each.name) for each in fields(self)}
        values["exposure_times"] = list(self.exposure_times)
        values["path"] = [asdict(point) for point in self.path]
        texts = {name: _format_toml(value) for name, value in values.items()}
        return [f"{_PREFIX}{name} = {text}" for name, text in texts.items()]

    @classmethod
    def from_text(cls, text: str) -> Self | None:
        """Read the recording from a text that contains the lines of :meth:`lines`.

        Returns
        -------
        Recording or None
            None if the text has no such lines, or they are damaged.
        """
        own = [line for line in text.splitlines() if line.startswith(_PREFIX)]
        if not own:
            return None
        try:
            values = parse_toml("\n".join(own))["recording"]
            path = tuple(Waypoint(**point) for point in values.pop("path", ()))
            return cls(**values, path=path)
        except (ValueError, TypeError, RecursionError):
            return None

    @property
    def frame_period(self) -> float:
        """Time from one frame's start to the next one's, in seconds by the camera's clock."""
        return 1.0 / self.frame_rate

    def gap(self, scene: Scene) -> float:
        """Return the time between two frames in which no column starts, in seconds.

        It is the frame period minus columns times readout time, by the camera's clock. If it is
        negative, frames would overlap.
        """
        read = scene.camera.columns * Fraction(scene.camera.readout_time)
        return float(1 / Fraction(self.frame_rate) - read)

    def gap_ratio(self, scene: Scene) -> float:
        """Return the gap as a fraction of the frame period."""
        return self.gap(scene) * self.frame_rate

    def check(self, scene: Scene) -> None:
        """Refuse a scene that cannot be recorded with these settings.

        Raises
        ------
        ParameterError
            Reading out a frame, or an exposure, takes longer than the frame period, or the jitter
            would let frames overlap.
        """
        period, gap = self.frame_period, self.gap(scene)
        camera = scene.camera
        if gap < 0.0:
            raise ParameterError(
                f"Reading out {camera.columns} columns at {SECOND.format(camera.readout_time)} "
                f"takes {SECOND.format(camera.columns * camera.readout_time)}; allowed at "
                f"{HERTZ.format(self.frame_rate)}: up to the frame period, "
                f"{SECOND.format(period)}.",
                parameters=("readout_time", "columns"),
            )
        longest = max(self.exposure_times or (camera.exposure_time,))
        if longest > period:
            raise ParameterError.of(
                "exposure_time",
                SECOND.format(longest),
                f"up to the frame period, {SECOND.format(period)}",
                condition=f"in a film of {HERTZ.format(self.frame_rate)}",
                parameters=("exposure_time",),
            )
        if self.frame_jitter > gap / _JITTERS_IN_GAP:
            raise ParameterError.of(
                "frame_jitter",
                SECOND.format(self.frame_jitter),
                f"up to a sixth of it, {SECOND.format(gap / _JITTERS_IN_GAP)}",
                condition=f"with a gap of {SECOND.format(gap)} between frames",
            )

    def exposure_time(self, scene: Scene, index: int) -> float:
        """Return the exposure time of a frame, in seconds by the camera's clock."""
        if not self.exposure_times:
            return scene.camera.exposure_time
        return self.exposure_times[index % len(self.exposure_times)]

    def motion(self, time: float) -> dict[str, float]:
        """Return the changes of the pose's parameters at a time, by name."""
        if not self.path:
            return {}
        after = bisect_right([point.time for point in self.path], time)
        if after in (0, len(self.path)):
            point = self.path[max(after - 1, 0)]
            return {name: getattr(point, name) for name in MOTIONS}
        first, second = self.path[after - 1], self.path[after]
        fraction = (time - first.time) / (second.time - first.time)
        return {
            name: (1.0 - fraction) * getattr(first, name) + fraction * getattr(second, name)
            for name in MOTIONS
        }


def _format_toml(value: object) -> str:
    if isinstance(value, dict):
        return (
            "{" + ", ".join(f"{name} = {_format_toml(part)}" for name, part in value.items()) + "}"
        )
    if isinstance(value, list):
        return f"[{', '.join(map(_format_toml, value))}]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _check_path(path: object) -> tuple[Waypoint, ...]:
    if not isinstance(path, Sequence) or not all(isinstance(point, Waypoint) for point in path):
        raise ParameterError.of("path", quote(path), "Waypoints, in the order of time")
    points = tuple(_check_waypoint(point) for point in path)
    for before, after in pairwise(points):
        if after.time <= before.time:
            raise ParameterError.of(
                "path",
                f"from the time {SECOND.format(before.time)} to {SECOND.format(after.time)}",
                "waypoints in the order of time",
                verb="goes",
            )
    return points


def _check_waypoint(point: Waypoint) -> Waypoint:
    values: Mapping[str, float] = {each.name: getattr(point, each.name) for each in fields(point)}
    for name, value in values.items():
        # This also refuses infinity and NaN.
        if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) <= 1e9:
            raise ParameterError.of(
                f"A waypoint's {name}", quote(value), "numbers from -1e9 to 1e9"
            )
    return Waypoint(**{name: float(value) for name, value in values.items()})


def _check_exposure_times(times: object) -> tuple[float, ...]:
    if isinstance(times, str) or not isinstance(times, Sequence):
        raise ParameterError.of("exposure_times", quote(times), "times in seconds")
    declared = PARAMETERS["exposure_time"]
    return tuple(float(declared.check(time)) for time in times)
