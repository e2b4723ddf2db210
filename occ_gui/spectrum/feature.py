"""The pane of the spectrum, declared."""

from occ_gui.shell.feature import Feature, Pane
from occ_gui.simulation.snapshot import Snapshot


def spectrum() -> Feature[Snapshot]:
    return Feature(
        name="spectrum",
        title="Spectrum and levels",
        help="guide.md#measure",
        make=_make,
        part=lambda _, results: results.snapshot,
    )


def _make() -> Pane[Snapshot]:
    from occ_gui.spectrum.pane import SpectrumPane
    from occ_gui.spectrum.spectrum_view import SpectrumView

    return SpectrumPane(SpectrumView())
