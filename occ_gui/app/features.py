"""The list of the panes that are declared, in the order of the view menu."""

from typing import Any, Protocol

from occ_gui.accuracy.feature import accuracy
from occ_gui.bands.feature import bands
from occ_gui.bench.feature import bench
from occ_gui.decoding.feature import decoding
from occ_gui.detection_map.feature import detection_map
from occ_gui.detection_map.wiring import Measuring
from occ_gui.explanation.feature import equations
from occ_gui.files.preferences import Preferences
from occ_gui.lessons.feature import lessons
from occ_gui.photo.feature import photo
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.pins.feature import compare
from occ_gui.pins.pin_controller import PinController
from occ_gui.profile.feature import profile
from occ_gui.room.feature import room
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature
from occ_gui.shell.results import Board
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.spectrum.feature import spectrum
from occ_gui.video.feature import video
from occ_gui.window.main_window import MainWindow


class Parts(Protocol):
    """The parts of the application that panes are connected with."""

    window: MainWindow
    store: SceneStore
    frame_rate: FrameRate
    pins: PinController
    controls: ControlPanel
    photos: PhotoController
    board: Board
    simulation: SimulationController
    preferences: Preferences
    measuring: Measuring
    shell: Shell

    def choose_decoder(self, name: str) -> None:
        """Show what this decoder reads, everywhere."""

    def about_photo(self) -> str:
        """Return what stands under a figure with the photo; empty if none is open."""


def features(parts: Parts) -> tuple[Feature[Any], ...]:
    """Declare the panes, once there is an application to translate their titles."""
    store, photos, shell = parts.store, parts.photos, parts.shell
    return (
        decoding(store.store),
        photo(store, photos, lambda: shell.pane("picture").view, parts.board),
        profile(store.store, parts.board, parts.about_photo),
        accuracy(store, parts.simulation),
        detection_map(store, parts.frame_rate, parts.measuring, parts.choose_decoder),
        bands(store),
        equations(store, lambda: shell.pane("profile").view.plot),
        spectrum(),
        compare(parts.pins),
        lessons(store, parts.board, parts.controls, parts.preferences),
        video(store, parts.board),
        room(),
        bench(store, parts.frame_rate, parts.measuring.for_bench, parts.window.say),
    )
