"""What a window is at work on, kept from its end to the next start."""

import json
from collections.abc import Collection
from dataclasses import asdict, dataclass
from pathlib import Path

from occ_gui.files.preferences import Memory, text_of
from occ_model.scene.argument_checks import check_seed
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import (
    NOISE_SOURCES,
    OBSERVABLES,
    TOLERANCE,
    SimulationSettings,
)

_SCENE, _SETTINGS = "session/scene", "session/settings"
_SCENE_FILE, _PHOTO = "session/scene_file", "session/photo"


@dataclass(frozen=True, slots=True)
class Session:
    """What a window was at work on, as far as it could be read.

    Parameters
    ----------
    scene
        The scene.
    settings
        How it was simulated.
    scene_file
        The file that the scene is saved to.
    photo
        The photo that was open.
    """

    scene: Scene | None = None
    settings: SimulationSettings | None = None
    scene_file: Path | None = None
    photo: Path | None = None


def recall_session(memory: Memory, effects: Collection[str]) -> Session:
    """Read the last session; rubbish in it is left out.

    Parameters
    ----------
    memory
        Where it was kept.
    effects
        Names of the effects that there are.
    """
    return Session(
        scene=_scene(memory.recall(_SCENE)),
        settings=_settings(memory.recall(_SETTINGS), effects),
        scene_file=_file(memory.recall(_SCENE_FILE)),
        photo=_file(memory.recall(_PHOTO)),
    )


def keep_session(memory: Memory, session: Session) -> None:
    """Keep a session for the next start."""
    scene, settings = session.scene, session.settings
    memory.keep(_SCENE, "" if scene is None else scene.to_toml())
    memory.keep(_SETTINGS, "" if settings is None else json.dumps(asdict(settings)))
    for key, path in ((_SCENE_FILE, session.scene_file), (_PHOTO, session.photo)):
        memory.keep(key, "" if path is None else text_of(path.absolute()))


def _scene(text: str) -> Scene | None:
    try:
        return Scene.from_toml(text) if text else None
    except Exception:  # noqa: BLE001 - whatever was kept, the window starts
        return None


def _settings(text: str, effects: Collection[str]) -> SimulationSettings | None:
    try:
        values = json.loads(text)
        force = values["force"]
        settings = SimulationSettings(
            tolerance=TOLERANCE.check(values["tolerance"]),
            observable=values["observable"],
            force={name: bool(force[name]) for name in force if name in effects},
            noise=values["noise"],
            seed=values["seed"],
        )
        check_seed(settings.seed)
        is_known = settings.observable in OBSERVABLES and settings.noise in NOISE_SOURCES
    except Exception:  # noqa: BLE001 - whatever was kept, the window starts
        return None
    return settings if is_known else None


def _file(text: str) -> Path | None:
    """Give a file that is still there."""
    try:
        path = Path(text)
        return path if text and path.is_absolute() and path.is_file() else None
    except (OSError, ValueError):
        return None
