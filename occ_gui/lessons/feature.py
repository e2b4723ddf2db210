"""The pane of the lessons, declared."""

from occ_gui.files.preferences import Preferences
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Board


def lessons(
    scenes: SceneStore, board: Board, controls: ControlPanel, preferences: Preferences
) -> Feature[None]:
    """Declare the pane: it changes the scene, opens photos, and marks one of the controls."""

    def make() -> Pane[None]:
        from occ_gui.lessons.pane import LessonPane

        return LessonPane(scenes, board, controls, preferences)

    return Feature(
        name="lessons",
        title="Lessons",
        help="lessons.md#follow-a-lesson",
        make=make,
    )
