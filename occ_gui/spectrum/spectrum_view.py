"""Pane of the spectrum: the frequencies of the profile, and the grey levels of the panel."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QPen
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from occ_gui.widgets.colours import BAND, SIMULATION, lighten_for, pen_on, thin
from occ_gui.widgets.plot import LineLegend, new_plot
from occ_model.results.spectrum import LevelHistogram, Spectrum
from occ_model.scene.units import HERTZ

_KILO = 1e-3
_HEADROOM = 1.15
_LEAST_TOP = 1.0
_MOST_MARKS, _HARMONICS_IN_VIEW = 12, 24
_HARMONIC = thin(SIMULATION, Qt.PenStyle.DotLine)


class SpectrumView(QWidget):
    """The spectrum of the profile with the response of the exposure, and a histogram beside it."""

    def __init__(self) -> None:
        super().__init__()
        self._make_spectrum()
        self._make_histogram()
        self.sentence = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
        self.sentence.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        layout = QGridLayout(self)
        layout.setContentsMargins(8, 4, 8, 8)
        layout.setSpacing(8)
        layout.addWidget(self.legend, 0, 0)
        layout.addWidget(self.sentence, 0, 1)
        layout.addWidget(self.spectrum, 1, 0)
        layout.addWidget(self.histogram, 1, 1)
        layout.setColumnStretch(0, 3)
        layout.setColumnStretch(1, 2)
        layout.setRowStretch(1, 1)

    def _make_spectrum(self) -> None:
        self.spectrum = new_plot(
            "Spectrum of the column profile", "frequency of the light, F (kHz)",
            "amplitude (levels)", self.palette(),
        )  # fmt: skip
        self.amplitudes = self.spectrum.add_curve(thin(SIMULATION))
        self.response = self.spectrum.add_curve(thin(BAND, Qt.PenStyle.DashLine))
        self.zeros: list[pg.InfiniteLine] = []
        self.harmonics: list[pg.InfiniteLine] = []
        self.legend = LineLegend()
        self.legend.add_line("profile", thin(SIMULATION), "profile")
        self.legend.add_line(
            "response",
            thin(BAND, Qt.PenStyle.DashLine),
            "response of the exposure, |sinc(F t)|; zero at F = k / t",
        )
        self.legend.add_line("harmonics", _HARMONIC, "light's harmonics")

    def _make_histogram(self) -> None:
        self.histogram = new_plot(
            "Histogram of the panel's pixels", "grey level",
            "fraction (%)", self.palette(),
        )  # fmt: skip
        self.bars = pg.BarGraphItem(x=np.arange(256), height=np.zeros(256), width=1.0)
        self.histogram.addItem(self.bars, ignoreBounds=True)
        self.histogram.dress_with(
            lambda palette: self.bars.setOpts(
                brush=lighten_for(palette, SIMULATION), pen=pen_on(palette, thin(SIMULATION))
            )
        )
        self.histogram.setXRange(-2, 257, padding=0)

    def show_spectrum(self, spectrum: Spectrum | None) -> None:
        zeros = () if spectrum is None else spectrum.zeros
        self.zeros = self._mark(self.zeros, zeros, thin(BAND))
        harmonics = () if spectrum is None else spectrum.harmonics
        self.harmonics = self._mark(self.harmonics, harmonics, _HARMONIC)
        self.legend.show_line("harmonics", bool(harmonics))
        if spectrum is not None:
            self._draw_spectrum(spectrum)
            return
        for curve in (self.amplitudes, self.response):
            curve.setData([], [])
        self.spectrum.setAccessibleDescription("")

    def _mark(
        self, before: list[pg.InfiniteLine], frequencies: tuple[float, ...], pen: QPen
    ) -> list[pg.InfiniteLine]:
        """Mark the first frequencies by lines in place of those before."""
        for line in before:
            self.spectrum.removeItem(line)
        lines = [pg.InfiniteLine(each * _KILO, pen=pen) for each in frequencies[:_MOST_MARKS]]
        for line in lines:
            self.spectrum.addItem(line, ignoreBounds=True)
        return lines

    def _draw_spectrum(self, found: Spectrum) -> None:
        frequencies = found.frequencies * _KILO
        highest = max(_HEADROOM * float(found.amplitudes.max()), _LEAST_TOP)
        self.amplitudes.setData(frequencies, found.amplitudes)
        self.response.setData(frequencies, found.response * highest / _HEADROOM)
        last = float(frequencies[-1])
        if found.harmonics:  # a slow lamp's would all be at the left edge
            last = min(last, _HARMONICS_IN_VIEW * found.harmonics[0] * _KILO)
        self.spectrum.setXRange(0.0, last, padding=0)
        self.spectrum.setYRange(0.0, highest, padding=0)
        peak = int(found.amplitudes.argmax())
        zero = HERTZ.format(found.zeros[0], 4) if found.zeros else "none in view"
        self.spectrum.setAccessibleDescription(
            f"Strongest at {HERTZ.format(float(found.frequencies[peak]), 4)}; first zero "
            f"of the exposure's response: {zero}"
        )

    def show_histogram(self, found: LevelHistogram) -> None:
        self.bars.setOpts(height=100.0 * found.fractions)
        self.histogram.setYRange(0.0, max(_HEADROOM * 100.0 * float(found.fractions.max()), 1.0))
        if found.is_saturated:
            text = (
                f"⚠ {100.0 * found.white:.0f} % of the panel's pixels are white: brighter light "
                "does not change them."
            )
        else:
            text = f"The panel's pixels: {100.0 * found.white:.1f} % are white."
        self.sentence.setText(text)
