"""Mark controller: marks on the main sliders where the picture changes in kind."""

from PySide6.QtCore import QObject

from occ_gui.scene.control_panel import MAIN, ControlPanel
from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.scene import Scene
from occ_model.teaching.marked_values import marked_values


class MarkController(QObject):
    def __init__(self, scenes: SceneStore, controls: ControlPanel) -> None:
        super().__init__(controls)
        self._controls = controls
        scenes.changed.connect(self._show)
        self._show(scenes.scene)

    def _show(self, scene: Scene) -> None:
        for name in MAIN:
            self._controls.show_marks(name, marked_values(scene, name))
