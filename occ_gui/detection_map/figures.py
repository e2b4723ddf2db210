"""Figure of the detection map."""

from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.shell.figures import Draw, Figure, NothingToDraw
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.detection_map.pane import MapPane
    from occ_model.figures.drawing import Drawing


def map_figure(store: Store) -> Figure:
    """Declare the figure, which there is once all points of the map are known."""

    def ask(pane: "MapPane | None", _shown: Snapshot) -> Draw:
        there = None if pane is None else pane.map.full
        if there is None:
            raise NothingToDraw(
                "The detection map is not complete yet: open its pane and wait a moment."
            )
        from occ_gui.detection_map.sweep_table import table_of

        workspace = store.workspace
        table, what = table_of(*there, workspace.frame_rate), workspace.shown

        def draw() -> "Drawing":
            from occ_model.figures.sweep import sweep_drawing

            return sweep_drawing(table, what)

        return draw

    return Figure(name="map", title="Detection map", draw=ask)
