"""Figure of accuracy and time."""

from typing import TYPE_CHECKING

from occ_gui.shell.figures import Draw, Figure, NothingToDraw
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.accuracy.pane import AccuracyPane
    from occ_model.figures.drawing import Drawing


def accuracy_figure() -> Figure:
    """Declare the figure of the points that are measured by now."""

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
