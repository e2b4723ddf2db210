"""A workspace in which all is set, for tests of what is stored of one."""

from pathlib import Path

from small_rooms import small_room

from occ_gui.core.workspace import Workspace
from occ_gui.values.choices import (
    FilmChoice,
    LoadOptions,
    MatchChoice,
    PhotoChoice,
    PhotoFrame,
    RoomChoice,
)
from occ_gui.values.simulated import PinnedScene, SimulationRequest
from occ_model.results.decoding import Region
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene, SimulationSettings

A_FILE = Path(__file__)  # any file that exists


def full_workspace() -> Workspace:
    """Return a workspace in which no field has its first value."""
    scene = Scene().replace(iso=321.0)
    photo = PhotoChoice(
        A_FILE, LoadOptions("lines", "green"), parts={PhotoFrame(A_FILE): Region(1, 20, 3, 40)},
        form=MatchChoice("lamp", 750.0, "switching_frequency", fit_gamma=True),
        certain={"readout_time": 8e-6},
    )  # fmt: skip
    recording = Recording(
        frame_rate=24.0, frame_jitter=1e-5, camera_drift=1e-5, transmitter_drift=-1e-5
    )
    film = FilmChoice(A_FILE, "lines", recording=recording, frames=7)
    settings = SimulationSettings(2.0, "signal", {"jpeg": True}, seed=7)
    pin = PinnedScene(SimulationRequest(scene, settings, more_decoders=("sequence",)), "phone-68us")
    return Workspace(
        scene, settings, 24.0, "bits", "matched", "receiver", "split", is_enhanced=True,
        photo=photo, film=film, room=RoomChoice("my.toml", small_room(), A_FILE, 0.031),
        pins=(None, pin), preset="tablet-61us", scene_file=A_FILE,
    )  # fmt: skip
