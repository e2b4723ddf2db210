"""The story in the middle of the window, declared."""

from collections.abc import Sequence

from PySide6.QtWidgets import QWidget

from occ_gui.core.workspace import Workspace
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature
from occ_gui.shell.results import Results
from occ_gui.simulation.controller import SimulationController
from occ_gui.story.pane import StoryPane, StoryPart


def story(
    scenes: SceneStore,
    simulation: SimulationController,
    picture: QWidget,
    decoders: Sequence[str],
) -> Feature[StoryPart]:
    """Declare the pane; it has a place for the whole picture."""

    def part(workspace: Workspace, results: Results) -> StoryPart:
        # A photo's profile is drawn where both are enhanced, or neither is.
        agree = workspace.is_enhanced == (workspace.whose == "receiver")
        photo = results.photo_profile if agree else None
        return results.reading, results.picture, photo, workspace.decoder, workspace.whose

    return Feature(
        name="story",
        title="Story",
        make=lambda: StoryPane(scenes, simulation, picture, decoders),
        part=part,
        goes_on_hidden=True,
    )
