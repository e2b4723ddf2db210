"""The pane of map, limits and advice, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.detection_map.wiring import Measuring
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.detection_map.pane import MapPane
    from occ_model.figures.drawing import Drawing


def detection_map(
    scenes: SceneStore, measuring: Measuring, choose_decoder: Callable[[str], None]
) -> Feature[None]:
    """Declare the pane: who goes to a limit of a decoder sees what that one reads."""

    def make() -> Pane[None]:
        from occ_gui.detection_map.pane import MapPane

        pane = MapPane(scenes, measuring)
        pane.went.connect(choose_decoder)
        return pane

    return Feature(
        name="map",
        title="Detection map",
        help="sweeps.md#the-detection-map",
        make=make,
        figures=(map_figure(scenes.store),),
    )


def map_figure(store: Store) -> Figure:
    def ask(pane: "MapPane | None", _shown: Snapshot) -> Draw:
        there = None if pane is None else pane.map.full
        if there is None:
            raise NothingToDraw(
                "The detection map is not complete yet: open its pane and wait a moment."
            )
        from occ_gui.detection_map.map_schedule import table_of

        workspace = store.workspace
        table, what = table_of(*there, workspace.frame_rate), workspace.shown

        def draw() -> "Drawing":
            from occ_model.figures.sweep import sweep_drawing

            return sweep_drawing(table, what)

        return draw

    return Figure(name="map", title="Detection map", draw=ask)
