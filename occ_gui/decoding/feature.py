"""The pane of decoding, declared."""

from functools import partial
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_model.receiver.decoders import QUICK_DECODERS

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


def decoding(store: Store) -> Feature[tuple[Reading | None, str]]:
    def make() -> Pane[tuple[Reading | None, str]]:
        from occ_gui.decoding.pane import DecodePane

        return DecodePane(store)

    return Feature(
        name="decode",
        title="Decoding",
        help="decoders.md",
        make=make,
        part=lambda workspace, results: (results.reading, workspace.decoder),
        goes_on_hidden=True,
        figures=decoding_figures(),
    )


def decoding_figures() -> tuple[Figure, ...]:
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
