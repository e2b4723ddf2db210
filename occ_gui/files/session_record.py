"""Record of a session: a workspace with its steps, as values of JSON.

An invalid part gets its initial value, so that a window starts whatever its file contains.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from occ_gui.core.store import History, StepChange
from occ_gui.core.workspace import FIRST_SETTINGS, UndoState, Workspace
from occ_gui.files.preferences import text_of
from occ_gui.values.choices import (
    FRAMES,
    KNOWN_PARAMETERS,
    OVERLAYS,
    SENT_SOURCES,
    FilmChoice,
    LoadOptions,
    MatchChoice,
    PhotoChoice,
    PhotoFrame,
    RoomChoice,
)
from occ_gui.values.simulated import PinnedScene, Pins, SimulationRequest
from occ_model.camera.projection import MAX_PIXELS
from occ_model.effects.registry import NAMES
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.receiver.decode import DECODERS
from occ_model.results.decoding import Region
from occ_model.results.frame import PICTURES
from occ_model.results.match import ESTIMATES
from occ_model.results.sweep_request import SHOWN_QUANTITIES
from occ_model.scene.parameters import quantity
from occ_model.scene.recording import DECLARED, FRAME_RATE
from occ_model.scene.scene import Scene, SimulationSettings

T = TypeVar("T")

_MOST_HISTORY_CHARACTERS = 1_000_000  # in the stored steps; the oldest steps are left out

_VIEW: Mapping[str, tuple[object, ...]] = {
    "decoder": tuple(DECODERS),
    "picture_kind": PICTURES,
    "overlay": OVERLAYS,
    "is_enhanced": (False, True),
    "shown": SHOWN_QUANTITIES,
}
"""Settings of how results are shown, with their possible values."""


@dataclass(frozen=True, slots=True)
class SavedSession:
    """A workspace, and the steps that led to it, which are None after a regular end."""

    workspace: Workspace
    history: History | None = None


def make_record(session: SavedSession) -> dict[str, Any]:
    workspace, history = session.workspace, session.history
    return {
        "scene": workspace.scene.to_toml(),
        "settings": asdict(workspace.settings),
        "scene_file": _write_path(workspace.scene_file),
        "photo": _make_photo_record(workspace.photo),
        "film": _make_film_record(workspace.film),
        "room": _make_room_record(workspace.room, RoomChoice()),
        "preset": workspace.preset,
        "pins": [None if pin is None else _make_pin_record(pin) for pin in workspace.pins],
        "view": {
            "frame_rate": workspace.frame_rate,
            **{name: getattr(workspace, name) for name in _VIEW},
        },
        "history": None if history is None else _make_history_record(history),
    }


def _make_photo_record(photo: PhotoChoice) -> dict[str, Any]:
    region = photo.rectangle
    return {
        "path": _write_path(photo.path),
        "region": None if region is None else asdict(region),
        "load_options": asdict(photo.load_options),
        "form": asdict(photo.form),
        "certain": dict(photo.certain),
    }


def _make_film_record(film: FilmChoice) -> dict[str, Any]:
    recording = {p.name: getattr(film.recording, p.name) for p in DECLARED}
    return {
        "path": _write_path(film.path), "axis": film.axis, "frames": film.frames,
        "recording": recording,
    }  # fmt: skip


def _make_room_record(choice: RoomChoice, former: RoomChoice) -> dict[str, Any]:
    """Return the record of a room; lamps and scene are left out if the former room has them too."""
    room, other = choice.room, former.room
    is_known = room is None or (
        other is not None and (room.lamps, room.scene) == (other.lamps, other.scene)
    )
    return {
        "name": choice.name,
        "camera": None if room is None else asdict(room.camera),
        "room": None if room is None or is_known else room.to_toml(),
        "photo": _write_path(choice.photo),
        "focal_length": choice.focal_length,
    }


def _make_pin_record(pin: PinnedScene) -> dict[str, Any]:
    return {
        "scene": pin.request.scene.to_toml(),
        "settings": asdict(pin.request.settings),
        "decoders": list(pin.request.more_decoders),
        "preset": pin.preset,
    }


def _make_history_record(history: History) -> dict[str, Any] | None:
    rooms = [history.first.room, *(step.room for step in history.steps)]
    steps = [
        [
            step.title,
            step.values,
            step.force,
            step.preset,
            None if step.room == before else _make_room_record(step.room, before),
        ]
        for step, before in zip(history.steps, rooms, strict=False)
    ]
    sizes, first = [len(json.dumps(step)) for step in steps], 0
    while sum(sizes[first:]) > _MOST_HISTORY_CHARACTERS:
        first += 1
    if first > history.done:  # The present state is before the steps that remain.
        return None
    state = [*history.states()][first] if first else history.first
    return {
        "scene": state.scene.to_toml(),
        "force": state.force,
        "preset": state.preset,
        "room": _make_room_record(state.room, RoomChoice()),
        "steps": steps[first:],
        "done": history.done - first,
    }


def _read_or_keep(initial: T, read: Callable[[], T]) -> T:
    """Return what ``read`` returns, or ``initial`` if it fails."""
    try:
        return read()
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return initial


def _require(is_valid: bool) -> None:
    if not is_valid:
        raise ValueError("not a valid session")


def read_session(record: Mapping[str, Any] | None) -> SavedSession | None:
    """Read a record; None if it has no valid scene."""
    values: Mapping[str, Any] = record or {}
    if (scene := _read_or_keep(None, lambda: _read_scene(values["scene"]))) is None:
        return None
    workspace = Workspace(
        scene,
        _read_or_keep(FIRST_SETTINGS, lambda: _read_settings(values["settings"])),
        photo=_read_or_keep(PhotoChoice(), lambda: _read_photo(values["photo"])),
        film=_read_or_keep(FilmChoice(), lambda: _read_film(values["film"])),
        room=_read_room(values.get("room"), RoomChoice()),
        pins=_read_pins(values.get("pins")),
        preset=_read_preset(values.get("preset")),
        scene_file=_read_path(values.get("scene_file")),
    )
    view: Any = values.get("view")
    with_view = _read_or_keep(workspace, lambda: _read_view(workspace, view))
    complete = _read_or_keep(
        with_view, lambda: replace(with_view, frame_rate=FRAME_RATE.check(view["frame_rate"]))
    )
    return SavedSession(complete, _read_or_keep(None, lambda: _read_history(values["history"])))


def _read_view(workspace: Workspace, values: Any) -> Workspace:
    settings: dict[str, Any] = {}
    for name, allowed in _VIEW.items():
        value = values.get(name)
        if value in allowed:
            settings[name] = allowed[allowed.index(value)]  # turns a 1 into True
    return replace(workspace, **settings)


def _read_photo(values: Any) -> PhotoChoice:
    path = _read_path(values.get("path"))
    region = _read_or_keep(None, lambda: _read_region(values["region"]))
    parts = {} if path is None or region is None else {PhotoFrame(path): region}
    photo = PhotoChoice(path, parts=parts)

    def read() -> PhotoChoice:
        options, form = LoadOptions(**values["load_options"]), MatchChoice(**values["form"])
        known = dict(values["certain"])
        certain = {name: quantity(name).check(value) for name, value in known.items()}
        quantity("lamp_frequency").check(form.lamp_frequency)
        _require(
            options.scan_axis in SCAN_AXES and options.channel in CHANNELS
            and form.sent in SENT_SOURCES and form.estimate in ESTIMATES
            and certain.keys() <= {*KNOWN_PARAMETERS}
            and isinstance(form.fit_gamma, bool)
        )  # fmt: skip
        return replace(photo, load_options=options, form=form, certain=certain)

    return _read_or_keep(photo, read)


def _read_film(values: Any) -> FilmChoice:
    film = FilmChoice(_read_path(values.get("path")))

    def read() -> FilmChoice:
        axis, frames = values["axis"], values["frames"]
        _require(axis in SCAN_AXES and type(frames) is int and frames in FRAMES)
        recording = film.recording.replace(**values["recording"])
        return replace(film, axis=axis, frames=frames, recording=recording)

    return _read_or_keep(film, read)


def _read_room(values: Any, former: RoomChoice) -> RoomChoice:
    """Read the settings of rooms; a record without a room stands for the former room."""

    def read() -> RoomChoice:
        length, photo = values["focal_length"], _read_path(values["photo"])
        if length is not None:
            length = quantity("equivalent_focal_length").check(length)
        if values["camera"] is None:
            return RoomChoice(photo=photo, focal_length=length)
        # Imported here, so that a window that has shown no room starts sooner.
        from occ_model.room.room import Place, Room

        base = former.room if values["room"] is None else Room.from_toml(values["room"])
        room = base.replace(camera=Place(**values["camera"]))  # type: ignore[union-attr]  # None fails
        return RoomChoice(str(values["name"]), room, photo, length)

    return _read_or_keep(RoomChoice(), read)


def _read_preset(name: Any) -> str:
    return name if isinstance(name, str) else ""


def _read_pins(values: Any) -> Pins:
    a, b = _read_or_keep((None, None), lambda: (values[0], values[1]))
    return _read_or_keep(None, lambda: _read_pin(a)), _read_or_keep(None, lambda: _read_pin(b))


def _read_pin(values: Any) -> PinnedScene:
    scene, settings = _read_scene(values["scene"]), _read_settings(values["settings"])
    _require(isinstance(values["decoders"], list))
    request = SimulationRequest(scene, settings, more_decoders=tuple(map(str, values["decoders"])))
    return PinnedScene(request, _read_preset(values.get("preset")))


def _read_history(values: Any) -> History:
    """Read the steps if each of them leads to a valid scene."""
    first = UndoState(
        Scene.from_toml(values["scene"]),
        _read_force(values["force"]),
        _read_room(values["room"], RoomChoice()),
        _read_preset(values["preset"]),
    )
    steps, room = list[StepChange](), first.room
    for title, changed, force, preset, room_record in values["steps"]:
        room = room if room_record is None else _read_room(room_record, room)
        steps.append(
            StepChange(str(title), dict(changed), _read_force(force), room, _read_preset(preset))
        )
    history = History(first, tuple(steps), int(values["done"]))
    _require(0 <= history.done < len([*history.states()]))
    return history


def _read_force(values: Any) -> dict[str, bool]:
    _require(all(isinstance(on, bool) for on in dict(values).values()))
    return {str(name): on for name, on in dict(values).items()}


def _read_scene(text: Any) -> Scene:
    _require(bool(text))
    return Scene.from_toml(text)


def _read_settings(values: Any) -> SimulationSettings:
    force = {name: on for name, on in dict(values["force"]).items() if name in NAMES}
    return SimulationSettings(**{**values, "force": force}).check(NAMES)


def _read_region(values: Any) -> Region:
    """Read a region in whole pixels; whether it fits the photo is checked with the photo."""
    region = Region(**values)
    _require(all(type(side) is int and 0 <= side <= MAX_PIXELS for side in asdict(region).values()))
    return region


def _read_path(text: Any) -> Path | None:
    path = _read_or_keep(Path(), lambda: Path(text))
    return path if _read_or_keep(False, lambda: path.is_absolute() and path.is_file()) else None


def _write_path(path: Path | None) -> str:
    return "" if path is None else text_of(path.absolute())
