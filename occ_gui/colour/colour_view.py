"""View of three colours: a line with three verdicts, the stripes in colour, three profiles."""

import cv2
import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.widgets.building import fill
from occ_gui.widgets.colours import BAND, PHOTO, SIMULATION, thin_pen
from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.plot import LineLegend, new_plot
from occ_model.arrays import ByteArray
from occ_model.results.colour import ColourFrame, ColourReading
from occ_model.scene.parameters.colour import COLOURS

_PERIODS = 2.5  # periods of the light that are shown, as far as the panel has them
_STRIP_HEIGHT = 56  # pixels
_INKS = (BAND, PHOTO, SIMULATION)  # of the red, green and blue channel
_LEFT = 60  # pixels left of the strip, as wide as the plot's axis


class ColourStrip(QWidget):
    """Some columns of a picture; each pixel of the screen has the mean of those under it."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(_STRIP_HEIGHT)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Stripes in colour")
        self._pixels: ByteArray | None = None

    def show_pixels(self, pixels: ByteArray | None) -> None:
        self._pixels = pixels
        self.update()

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        if self._pixels is None or not self._pixels.size:
            return
        size = self.size() * self.devicePixelRatio()
        rows, columns = self._pixels.shape[:2]
        # The painter repeats pixels, but averages none.
        smaller = max(1, min(size.width(), columns)), max(1, min(size.height(), rows))
        drawn = cv2.resize(self._pixels, smaller, interpolation=cv2.INTER_AREA)
        image = QImage(drawn.data, *smaller, drawn.strides[0], QImage.Format.Format_RGB888)
        QPainter(self).drawImage(self.rect(), image)


class ColourView(QWidget):
    """The picture and the profiles of a colour camera, and its three verdicts in one line."""

    def __init__(self) -> None:
        super().__init__()
        self.verdict = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
        self.sentence = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
        self.strip = ColourStrip()
        self.plot = new_plot("Profiles of the three channels", "column", "level")
        self.plot.setYRange(0.0, 260.0, padding=0)
        self.plot.getAxis("left").setWidth(_LEFT)
        self.curves = [self.plot.add_curve(thin_pen(ink)) for ink in _INKS]
        self.legend = LineLegend()
        for colour, ink in zip(COLOURS, _INKS, strict=True):
            self.legend.add_line(colour, thin_pen(ink), colour)
        beside = fill(QVBoxLayout(), self.strip, margins=0)
        beside.setContentsMargins(_LEFT, 0, 0, 0)
        fill(
            QVBoxLayout(self), self.verdict, self.sentence, beside, self.legend, (self.plot, 1),
            margins=(8, 4, 8, 8),
        )  # fmt: skip

    def show_sentence(self, sentence: str) -> None:
        """Show why there are no colours, in place of them."""
        self.verdict.clear()
        self.strip.show_pixels(None)
        for curve in self.curves:
            curve.setData([], [])
        self._say(sentence)

    def _say(self, sentence: str) -> None:
        self.sentence.setText(sentence)
        self.sentence.setVisible(bool(sentence))

    def show_outdated(self) -> None:
        self._say("of an earlier scene; simulating…" if self.verdict.text() else "")

    def show_colours(
        self, frame: ColourFrame, reading: ColourReading, period_columns: float
    ) -> None:
        self.verdict.setText(verdict_of(reading))
        self._say(reasons_of(reading))
        region = frame.region
        first = region.first_column
        last = min(region.last_column, first + max(int(_PERIODS * period_columns), 16))
        rows = slice(region.first_row, region.last_row)
        self.strip.show_pixels(_in_colour(frame.image[rows, first:last], frame))
        places = np.arange(first, last)
        for curve, means in zip(self.curves, frame.profiles[:, first:last], strict=True):
            seen = ~np.isnan(means)
            curve.setData(places[seen], means[seen])
        self.plot.setXRange(first - 0.5, last - 0.5, padding=0)
        highest = float(np.nanmax(frame.profiles[:, first:last], initial=1.0))
        self.plot.setYRange(0.0, 1.1 * highest, padding=0)


def verdict_of(reading: ColourReading) -> str:
    """Return the verdicts of all colours in one line, with a mark for each."""
    descriptions = reading.descriptions
    return "   ".join(
        f"{'✓' if result.failure is None else '✗'} {descriptions[name]}"
        for name, result in reading.by_colour.items()
    )


def reasons_of(reading: ColourReading) -> str:
    """Return why colours were not read, each reason once."""
    reasons: dict[str, list[str]] = {}
    for name, result in reading.by_colour.items():
        if result.failure is not None:
            reasons.setdefault(result.failure, []).append(name)
    return " ".join(
        f"{', '.join(names).capitalize()}: {failure}" for failure, names in reasons.items()
    )


def _in_colour(pixels: ByteArray, frame: ColourFrame) -> ByteArray:
    """Return pixels with three channels: of a raw mosaic, each has its filter's colour alone."""
    if pixels.ndim == 3:
        return np.ascontiguousarray(pixels)
    shown = np.zeros((*pixels.shape, 3), dtype=np.uint8)
    top, left = frame.region.first_row, frame.region.first_column
    for channel, (rows, columns) in frame.scene.colours.filters:
        own = slice((rows.start - top) % 2, None, 2), slice((columns.start - left) % 2, None, 2)
        shown[(*own, channel)] = pixels[own]
    return shown
