"""Controller of the spectrum: measures the results while the pane is visible."""

from typing import Protocol

import numpy as np
from PySide6.QtCore import QObject

from occ_gui.simulation.snapshot import Snapshot
from occ_model.errors import ParameterError
from occ_model.results.spectrum import LevelHistogram, Spectrum
from occ_model.study.level_histogram import level_histogram
from occ_model.study.spectrum import profile_spectrum


class SpectrumPane(Protocol):
    """A pane that shows a spectrum and a histogram."""

    def show_spectrum(self, spectrum: Spectrum | None) -> None:
        """Show the spectrum of a profile, None where it has none."""

    def show_histogram(self, histogram: LevelHistogram) -> None:
        """Show the grey levels of the panel's pixels."""


class SpectrumController(QObject):
    """Measures the part of the picture that shows the panel.

    Parameters
    ----------
    pane
        Shows what is measured.
    """

    def __init__(self, pane: SpectrumPane) -> None:
        super().__init__()
        self._pane = pane
        self._snapshot: Snapshot | None = None
        self._seen = False

    def set_seen(self, seen: bool) -> None:
        """Follow the simulation while the pane is visible."""
        self._seen = seen
        if seen:
            self._measure()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Measure these results."""
        self._snapshot = snapshot
        if self._seen:
            self._measure()

    def _measure(self) -> None:
        snapshot = self._snapshot
        if snapshot is None:
            return
        left, top = np.maximum(snapshot.corners.min(axis=0), 0.0).astype(int).tolist()
        right, bottom = np.maximum(snapshot.corners.max(axis=0) + 1.0, 0.0).astype(int).tolist()
        try:
            spectrum = profile_spectrum(snapshot.profile[left:right], snapshot.scene)
        except ParameterError:  # too few columns show the panel
            spectrum = None
        self._pane.show_spectrum(spectrum)
        self._pane.show_histogram(
            level_histogram(snapshot.frame.camera_image[top:bottom, left:right])
        )
