"""The transmitter, declared."""

from PySide6.QtWidgets import QWidget

from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Service


def transmitter(window: QWidget, scenes: SceneStore, preferences: Preferences) -> Feature[None]:
    """Declare what a board needs to blink the scene: a dialog, which follows the scene."""

    def make() -> Service:
        from occ_gui.transmitter.transmitter_controller import TransmitterController

        return TransmitterController(window, scenes, preferences)

    return Feature(
        name="transmitter", make=make, commands={"transmitter": lambda sender: sender.show()}
    )
