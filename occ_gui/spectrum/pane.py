"""The pane of the spectrum, measured in the columns and rows that show the panel."""

import numpy as np

from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_snapshot
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.spectrum.spectrum_view import SpectrumView
from occ_model.errors import ParameterError
from occ_model.study.spectrum import level_histogram, profile_spectrum


class SpectrumPane(Pane[Snapshot]):
    """Measures spectrum and histogram, which takes two milliseconds and needs no thread."""

    def __init__(self, view: SpectrumView) -> None:
        super().__init__(view)
        self.view = view
        self.made_of = {view: of_snapshot}

    def show_part(self, part: Snapshot) -> None:
        left, top = np.maximum(part.corners.min(axis=0), 0.0).astype(int).tolist()
        right, bottom = np.maximum(part.corners.max(axis=0) + 1.0, 0.0).astype(int).tolist()
        try:
            spectrum = profile_spectrum(part.profile[left:right], part.scene)
        except ParameterError:  # too few columns show the panel
            spectrum = None
        self.view.show_spectrum(spectrum)
        panel = part.frame.camera_image[top:bottom, left:right]
        self.view.show_histogram(level_histogram(panel))
