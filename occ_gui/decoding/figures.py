"""Figures of decoding: the steps of each decoder."""

from functools import partial
from typing import TYPE_CHECKING

from occ_gui.shell.figures import Draw, Figure, NothingToDraw
from occ_gui.simulation.snapshot import Snapshot
from occ_model.receiver.decoders import QUICK_DECODERS

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


def decoding_figures() -> tuple[Figure, ...]:
    """Declare one figure for each decoder that reads every picture."""
    return tuple(
        Figure(name=f"decoding-{name}", title=f"Decoding, {name}", draw=partial(_steps, name))
        for name in QUICK_DECODERS
    )


def _steps(decoder: str, _pane: object, shown: Snapshot) -> Draw:
    result = shown.result_of(decoder)
    if result is None:
        raise NothingToDraw(f"The {decoder} decoder has not read the picture.")

    def draw() -> "Drawing":
        from occ_model.figures.decoding import decode_drawing

        return decode_drawing(shown.frame.scene, result)

    return draw
