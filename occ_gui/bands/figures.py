"""Figures of the bars: the map of the least depth, and the flicker for the eye."""

from typing import TYPE_CHECKING

from occ_gui.shell.figures import Draw, Figure
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


def bands_figures() -> tuple[Figure, ...]:
    """Declare the figures: both need the scene alone."""

    def bars(_pane: object, shown: Snapshot) -> Draw:
        def draw() -> "Drawing":
            from occ_model.figures.bands import bands_drawing

            return bands_drawing(shown.frame.scene)

        return draw

    def flicker(_pane: object, shown: Snapshot) -> Draw:
        def draw() -> "Drawing":
            from occ_model.figures.bands import flicker_drawing

            return flicker_drawing(shown.frame.scene)

        return draw

    return (
        Figure(name="bands", title="Bars", draw=bars),
        Figure(name="flicker", title="Flicker for the eye", draw=flicker),
    )
