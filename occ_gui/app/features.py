"""The list of the panes that are declared, in the order of the view menu."""

from typing import Any, Protocol

from occ_gui.bands.feature import bands
from occ_gui.bench.feature import bench
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.detection_map.feature import detection_map
from occ_gui.detection_map.wiring import Measuring
from occ_gui.explanation.feature import equations
from occ_gui.files.preferences import Preferences
from occ_gui.lessons.feature import lessons
from occ_gui.photo.wiring import PhotoWiring
from occ_gui.pins.feature import compare
from occ_gui.pins.pin_controller import PinController
from occ_gui.profile.profile_view import ProfileView
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature
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
    profile: ProfileView
    photo_wiring: PhotoWiring
    preferences: Preferences
    measuring: Measuring
    decode: DecodeView


def features(parts: Parts) -> tuple[Feature[Any], ...]:
    """Declare the panes, once there is an application to translate their titles."""
    store, photos = parts.store, parts.photo_wiring.photos
    return (
        detection_map(store, parts.frame_rate, parts.measuring, parts.decode.choose_decoder),
        bands(store),
        equations(store, parts.profile.plot),
        spectrum(),
        compare(parts.pins),
        lessons(store, photos, parts.controls, parts.preferences),
        video(store),
        bench(store, parts.frame_rate, parts.measuring.for_bench, parts.window.say),
    )
