"""The pane of accuracy and time, declared."""

from typing import TYPE_CHECKING

from occ_gui.core.workspace import Workspace
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane
from occ_gui.shell.results import Results
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.accuracy.pane import AccuracyPane, AccuracyPart
    from occ_model.figures.drawing import Drawing


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


def accuracy_figure() -> Figure:
    def ask(pane: "AccuracyPane | None", _shown: Snapshot) -> Draw:
        points = () if pane is None else pane.view.plot.measured
        if not points:
            raise NothingToDraw(
                "What accuracy costs is not measured yet: open its pane and wait a moment."
            )

        def draw() -> "Drawing":
            from occ_model.figures.accuracy import accuracy_drawing

            return accuracy_drawing(points)

        return draw

    return Figure(name="accuracy", title="Accuracy and time", draw=ask)
