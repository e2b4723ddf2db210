"""The pane of the bench, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.bench.figures import bench_figure
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane

if TYPE_CHECKING:
    from occ_gui.background.signals import JobChannel


def bench(
    scenes: SceneStore, channel: "Callable[[], JobChannel]", say: Callable[[str], None]
) -> Feature[None]:
    """Declare the pane: a channel does its work, and what it refuses is said."""

    def make() -> Pane[None]:
        from occ_gui.bench.pane import BenchPane

        pane = BenchPane(scenes, channel())
        pane.view.refused.connect(say)
        return pane

    return Feature(
        name="bench",
        title="Bench",
        help="sweeps.md#the-bench",
        make=make,
        figures=(bench_figure(scenes.store),),
    )
