"""Record of a session: what a window is working on, as a table of plain values and back.

Parts that cannot be read are left out: a window starts whatever its file contains.
"""

import json
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from occ_gui.core.step_history import History, StepChange
from occ_gui.core.workspace import Step
from occ_gui.files.preferences import text_of
from occ_gui.simulation.snapshot import Pins, SimulationRequest
from occ_gui.values.film_choice import FRAMES, FilmChoice
from occ_gui.values.match_choice import KNOWN, SENT, MatchChoice
from occ_gui.values.photo_choice import PhotoChoice, PhotoFrame, PhotoReading
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.results.decoding import Region
from occ_model.scene.argument_checks import check_seed
from occ_model.scene.parameters import quantity
from occ_model.scene.recording import DECLARED
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import (
    NOISE_SOURCES,
    OBSERVABLES,
    TOLERANCE,
    SimulationSettings,
)
from occ_model.scene.square_wave import SQUARE_FREQUENCY

_MOST_OF_HISTORY = 1_000_000
"""Characters of the steps in a record; the oldest ones are left out of longer ones."""


@dataclass(frozen=True, slots=True)
class Session:
    """What a window is working on, as far as it is known.

    Parameters
    ----------
    preset
        The preset that the scene is, or was before some of its values were changed.
    history
        The steps that can be undone, which a window that has come to its end does not leave.
    """

    scene: Scene | None = None
    settings: SimulationSettings | None = None
    scene_file: Path | None = None
    photo: PhotoChoice = field(default_factory=PhotoChoice)
    film: FilmChoice = field(default_factory=FilmChoice)
    preset: str = ""
    pins: Pins = (None, None)
    history: History | None = None


def record_of(session: Session) -> dict[str, Any]:
    """Write a session as plain values."""
    scene, settings = session.scene, session.settings
    return {
        "scene": "" if scene is None else scene.to_toml(),
        "settings": None if settings is None else asdict(settings),
        "scene_file": _text(session.scene_file),
        "photo": _photo_record(session.photo),
        "film": _film_record(session.film),
        "preset": session.preset,
        "pins": [None if pin is None else _pin_record(pin) for pin in session.pins],
        "history": None if session.history is None else _history_record(session.history),
    }


def _photo_record(photo: PhotoChoice) -> dict[str, Any]:
    region = photo.rectangle
    return {
        "path": _text(photo.path),
        "region": None if region is None else asdict(region),
        "reading": asdict(photo.reading),
        "form": asdict(photo.form),
        "certain": dict(photo.certain),
    }


def _film_record(film: FilmChoice) -> dict[str, Any]:
    recording = {each.name: getattr(film.recording, each.name) for each in DECLARED}
    return {
        "path": _text(film.path), "axis": film.axis, "frames": film.frames, "recording": recording,
    }  # fmt: skip


def _pin_record(pin: SimulationRequest) -> dict[str, Any]:
    return {
        "scene": pin.scene.to_toml(),
        "settings": asdict(pin.settings),
        "decoders": list(pin.more),
    }


def _history_record(history: History) -> dict[str, Any] | None:
    steps = [[step.title, step.values, step.force] for step in history.steps]
    sizes, first = [len(json.dumps(step)) for step in steps], 0
    while sum(sizes[first:]) > _MOST_OF_HISTORY:
        first += 1
    if first > history.done:
        return None
    state = [*history.states()][first] if first else history.first
    return {
        "scene": state.scene.to_toml(),
        "force": state.force,
        "steps": steps[first:],
        "done": history.done - first,
    }


def session_in(record: Mapping[str, Any] | None, effects: Collection[str]) -> Session:
    """Read a session; effects of the settings that are not among these are left out."""
    if record is None:
        return Session()
    preset = record.get("preset")
    return Session(
        scene=_scene(record.get("scene")),
        settings=_settings(record.get("settings"), effects),
        scene_file=_file(record.get("scene_file")),
        photo=_photo(record.get("photo"), record.get("region")),
        film=_film(record.get("film")),
        preset=preset if isinstance(preset, str) else "",
        pins=_pins(record.get("pins"), effects),
        history=_history(record.get("history")),
    )


def _photo(values: Any, region: Any) -> PhotoChoice:
    """Return what was set about photos; in the former format there are a path and a region."""
    if not isinstance(values, dict):
        values = {"path": values, "region": region}
    path, part = _file(values.get("path")), _region(values.get("region"))
    parts = {} if path is None or part is None else {PhotoFrame(path): part}
    photo = PhotoChoice(path, parts=parts)
    try:
        reading, form = PhotoReading(**values["reading"]), MatchChoice(**values["form"])
        certain = {name: quantity(name).check(value) for name, value in values["certain"].items()}
        is_known = (
            reading.scan_axis in SCAN_AXES and reading.channel in CHANNELS
            and form.sent in SENT and form.estimate in KNOWN and certain.keys() <= {*KNOWN}
            and isinstance(form.fit_gamma, bool)
        )  # fmt: skip
        SQUARE_FREQUENCY.check(form.square_frequency)
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return photo
    return replace(photo, reading=reading, form=form, certain=certain) if is_known else photo


def _film(values: Any) -> FilmChoice:
    """Return what was set about films; in the former format there is a path."""
    if not isinstance(values, dict):
        return FilmChoice(_file(values))
    film = FilmChoice(_file(values.get("path")))
    try:
        axis, frames = values["axis"], values["frames"]
        recording = film.recording.replace(**values["recording"])
        is_known = axis in SCAN_AXES and type(frames) is int and frames in FRAMES
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return film
    return replace(film, axis=axis, frames=frames, recording=recording) if is_known else film


def _pins(values: Any, effects: Collection[str]) -> Pins:
    if not isinstance(values, list) or len(values) != 2:
        return None, None
    a, b = (_pin(value, effects) for value in values)
    return a, b


def _pin(values: Any, effects: Collection[str]) -> SimulationRequest | None:
    if not isinstance(values, dict):
        return None
    scene = _scene(values.get("scene"))
    settings = _settings(values.get("settings"), effects)
    more = values.get("decoders")
    if scene is None or settings is None or not isinstance(more, list):
        return None
    return SimulationRequest(scene, settings, more=tuple(map(str, more)))


def _history(values: Any) -> History | None:
    """Return the steps if each of them leads to a scene."""
    try:
        steps = tuple(
            StepChange(str(title), dict(changed), _force(force))
            for title, changed, force in values["steps"]
        )
        first = Step(Scene.from_toml(values["scene"]), _force(values["force"]))
        history = History(first, steps, int(values["done"]))
        states = [*history.states()]
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None
    return history if 0 <= history.done < len(states) else None


def _force(values: Any) -> dict[str, bool]:
    forced = dict(values)
    if not all(isinstance(on, bool) for on in forced.values()):
        raise TypeError("an effect is forced by true or false")
    return {str(name): bool(on) for name, on in forced.items()}


def _scene(text: object) -> Scene | None:
    try:
        return Scene.from_toml(text) if isinstance(text, str) and text else None
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None


def _settings(values: Any, effects: Collection[str]) -> SimulationSettings | None:
    try:
        force = _force(values["force"])
        settings = SimulationSettings(
            tolerance=TOLERANCE.check(values["tolerance"]),
            observable=values["observable"],
            force={name: on for name, on in force.items() if name in effects},
            noise=values["noise"],
            seed=values["seed"],
        )
        check_seed(settings.seed)
        is_known = settings.observable in OBSERVABLES and settings.noise in NOISE_SOURCES
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None
    return settings if is_known else None


def _region(values: Any) -> Region | None:
    """Return a rectangle of whole numbers; whether it lies in the photo shows when that is read."""
    try:
        region = Region(**values)
    except TypeError:
        return None
    sides = asdict(region).values()
    return region if all(type(side) is int and side >= 0 for side in sides) else None


def _file(text: object) -> Path | None:
    """Return the path of a file that still exists."""
    try:
        path = Path(text) if isinstance(text, str) and text else None
        return path if path is not None and path.is_absolute() and path.is_file() else None
    except (OSError, ValueError):
        return None


def _text(path: Path | None) -> str:
    return "" if path is None else text_of(path.absolute())
