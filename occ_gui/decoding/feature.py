"""The pane of decoding, declared."""

from occ_gui.core.store import Store
from occ_gui.decoding.figures import decoding_figures
from occ_gui.shell.feature import Feature, Pane
from occ_gui.simulation.snapshot import Reading


def decoding(store: Store) -> Feature[tuple[Reading | None, str]]:
    """Declare the pane: it shows what the chosen decoder reads."""

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
