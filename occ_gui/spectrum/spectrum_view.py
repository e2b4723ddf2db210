"""Pane of the spectrum: the frequencies of the profile, and the grey levels of the panel."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QPen
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from occ_gui.widgets.colours import BAND, SIMULATION, lighten_for, pen_on, thin_pen
from occ_gui.widgets.plot import LineLegend, new_plot
from occ_model.results.spectrum import LevelHistogram, Spectrum
from occ_model.scene.units import HERTZ

_KILOHERTZ = 1e-3  # kilohertz per hertz
_HEADROOM = 1.15  # height of an axis, relative to the largest value
_LEAST_AMPLITUDE = 1.0  # smallest height of the axis, in grey levels
_MOST_MARKS, _HARMONICS_IN_VIEW = 12, 24
_HARMONIC = thin_pen(SIMULATION, Qt.PenStyle.DotLine)


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
            "Spectrum of the column profile",
            "frequency of the light, F (kHz)",
            "amplitude (levels)",
        )
        self.amplitudes = self.spectrum.add_curve(thin_pen(SIMULATION))
        self.response = self.spectrum.add_curve(thin_pen(BAND, Qt.PenStyle.DashLine))
        self.zeros: list[pg.InfiniteLine] = []
        self.harmonics: list[pg.InfiniteLine] = []
        self.legend = LineLegend()
        self.legend.add_line("profile", thin_pen(SIMULATION), "profile")
        self.legend.add_line(
            "response",
            thin_pen(BAND, Qt.PenStyle.DashLine),
            "response of the exposure, |sinc(F t)|; zero at F = k / t",
        )
        self.legend.add_line("harmonics", _HARMONIC, "light's harmonics")

    def _make_histogram(self) -> None:
        labels = ("Histogram of the panel's pixels", "grey level", "fraction (%)")
        self.histogram = new_plot(*labels)
        self.bars = pg.BarGraphItem(x=np.arange(256), height=np.zeros(256), width=1.0)
        self.histogram.addItem(self.bars, ignoreBounds=True)
        self.histogram.follow_palette(
            lambda palette: self.bars.setOpts(
                brush=lighten_for(palette, SIMULATION), pen=pen_on(palette, thin_pen(SIMULATION))
            )
        )
        self.histogram.setXRange(-2, 257, padding=0)

    def show_spectrum(self, spectrum: Spectrum | None) -> None:
        zeros = () if spectrum is None else spectrum.zeros
        self.zeros = self._replace_lines(self.zeros, zeros, thin_pen(BAND))
        harmonics = () if spectrum is None else spectrum.harmonics
        self.harmonics = self._replace_lines(self.harmonics, harmonics, _HARMONIC)
        self.legend.show_line("harmonics", bool(harmonics))
        if spectrum is not None:
            self._draw_spectrum(spectrum)
            return
        for curve in (self.amplitudes, self.response):
            curve.setData([], [])
        self.spectrum.setAccessibleDescription("")

    def _replace_lines(
        self, old_lines: list[pg.InfiniteLine], frequencies: tuple[float, ...], pen: QPen
    ) -> list[pg.InfiniteLine]:
        """Mark the first frequencies by lines in place of the old ones."""
        for line in old_lines:
            self.spectrum.removeItem(line)
        lines = [
            pg.InfiniteLine(frequency * _KILOHERTZ, pen=pen)
            for frequency in frequencies[:_MOST_MARKS]
        ]
        for line in lines:
            self.spectrum.addItem(line, ignoreBounds=True)
        return lines

    def _draw_spectrum(self, spectrum: Spectrum) -> None:
        frequencies = spectrum.frequencies * _KILOHERTZ
        highest = max(_HEADROOM * float(spectrum.amplitudes.max()), _LEAST_AMPLITUDE)
        self.amplitudes.setData(frequencies, spectrum.amplitudes)
        self.response.setData(frequencies, spectrum.response * highest / _HEADROOM)
        last = float(frequencies[-1])
        if spectrum.harmonics:  # otherwise those of a slow lamp would all be at the left edge
            last = min(last, _HARMONICS_IN_VIEW * spectrum.harmonics[0] * _KILOHERTZ)
        self.spectrum.setXRange(0.0, last, padding=0)
        self.spectrum.setYRange(0.0, highest, padding=0)
        peak = int(spectrum.amplitudes.argmax())
        zero = HERTZ.format(spectrum.zeros[0], 4) if spectrum.zeros else "none in view"
        self.spectrum.setAccessibleDescription(
            f"Strongest at {HERTZ.format(float(spectrum.frequencies[peak]), 4)}; first zero "
            f"of the exposure's response: {zero}"
        )

    def show_histogram(self, histogram: LevelHistogram) -> None:
        self.bars.setOpts(height=100.0 * histogram.fractions)
        self.histogram.setYRange(
            0.0, max(_HEADROOM * 100.0 * float(histogram.fractions.max()), 1.0)
        )
        if histogram.is_saturated:
            text = (
                f"⚠ {100.0 * histogram.white:.0f} % of the panel's pixels are saturated: "
                "brighter light does not change them."
            )
        else:
            text = f"The panel's pixels: {100.0 * histogram.white:.1f} % are saturated."
        self.sentence.setText(text)
