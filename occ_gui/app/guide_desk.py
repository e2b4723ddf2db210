"""The pane that leads through the explorations, with its controller."""

from PySide6.QtCore import QObject

from occ_gui.explorations.exploration_controller import ExplorationController
from occ_gui.explorations.exploration_view import ExplorationView
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.scene.scene_store import SceneStore


class ExplorationWiring(QObject):
    """The explorations, connected with what they set.

    Parameters
    ----------
    scenes
        Takes the scene of a step.
    photos
        Opens the photo of a step.
    """

    def __init__(self, scenes: SceneStore, photos: PhotoController) -> None:
        super().__init__()
        self.pane = ExplorationView()
        self.explorations = ExplorationController(scenes, photos, self.pane)
        self.pane.chosen.connect(self.explorations.choose)
        self.pane.moved.connect(self.explorations.go)
        self.pane.list_asked.connect(self.explorations.leave)
        self.pane.again_asked.connect(self.explorations.set_again)
