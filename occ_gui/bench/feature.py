"""The pane of the bench, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.background.signals import JobChannel
    from occ_gui.bench.pane import BenchPane
    from occ_model.figures.drawing import Drawing


def bench(
    scenes: SceneStore, channel: "Callable[[], JobChannel]", say: Callable[[str], None]
) -> Feature[None]:
    """Declare the pane: a channel does its work, and what it refuses is said."""

    def make() -> Pane[None]:
        from occ_gui.bench.pane import BenchPane

        pane = BenchPane(scenes, channel())
        pane.view.frame_rate.refused.connect(say)
        return pane

    return Feature(
        name="bench",
        title="Bench",
        help="sweeps.md#the-bench",
        make=make,
        figures=(bench_figure(scenes.store),),
    )


def bench_figure(store: Store) -> Figure:
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
