"""Figure of the bench."""

from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.shell.figures import Draw, Figure, NothingToDraw
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.bench.pane import BenchPane
    from occ_model.figures.drawing import Drawing


def bench_figure(store: Store) -> Figure:
    """Declare the figure, which there is once all points are measured."""

    def ask(pane: "BenchPane | None", _shown: Snapshot) -> Draw:
        there = None if pane is None else pane.controller.full
        if there is None:
            raise NothingToDraw(
                "The bench is not complete: open its pane, measure and wait a moment."
            )
        (measured, points), rate = there, store.workspace.frame_rate

        def draw() -> "Drawing":
            from occ_model.figures.bench import bench_drawing

            return bench_drawing(measured, points, rate)

        return draw

    return Figure(name="bench", title="Bench", draw=ask)
