"""The pane of accuracy and time, declared."""

from typing import TYPE_CHECKING

from occ_gui.accuracy.figures import accuracy_figure
from occ_gui.core.workspace import Workspace
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Results
from occ_gui.simulation.controller import SimulationController

if TYPE_CHECKING:
    from occ_gui.accuracy.pane import AccuracyPart


def accuracy(scenes: SceneStore, simulation: SimulationController) -> "Feature[AccuracyPart]":
    """Declare the pane: it measures while it is seen, beside no simulation."""

    def make() -> "Pane[AccuracyPart]":
        from occ_gui.accuracy.pane import AccuracyPane

        return AccuracyPane(scenes, simulation)

    def part(workspace: Workspace, results: Results) -> "AccuracyPart":
        return workspace.settings, results.switched, results.snapshot

    return Feature(
        name="accuracy",
        title="Accuracy and time",
        help="effects.md#accuracy-against-time",
        make=make,
        part=part,
        goes_on_hidden=True,
        figures=(accuracy_figure(),),
    )
