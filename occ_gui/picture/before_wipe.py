"""Comparison of the pictures before and after the latest change, at a line that can be dragged."""

import pyqtgraph as pg
from PySide6.QtCore import QObject, QSignalBlocker, Qt
from PySide6.QtWidgets import QHBoxLayout, QSlider, QWidget

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.widgets.building import check_box, fill
from occ_gui.widgets.colours import BEFORE
from occ_model.arrays import ByteArray
from occ_model.results.frame import PICTURES, Frame

_LINE_PEN = pg.mkPen(BEFORE, width=2)
_PAPER = "#f4f4f4"
_INK = "#202020"

_SLIDER_STEPS = 100
_SLIDER_WIDTH = 90


class BeforeWipe(QObject):
    """Compares the picture with the one before the latest change; off at first."""

    def __init__(self, box: pg.ViewBox) -> None:
        super().__init__()
        self._frame: Frame | None = None
        self._picture_kind = PICTURES[0]
        self._image: ByteArray | None = None
        self._fraction = 0.5
        self.picture = AveragedImage()
        self.line = pg.InfiniteLine(angle=90, movable=True, pen=_LINE_PEN)
        self.line.sigPositionChanged.connect(self._follow_line)
        self._labels = (
            pg.TextItem("before", color=_INK, fill=_PAPER, anchor=(1.0, 0.0)),
            pg.TextItem("now", color=_INK, fill=_PAPER, anchor=(0.0, 0.0)),
        )
        # Above the current picture, below a photo that lies on it.
        for depth, item in enumerate((self.picture, self.line, *self._labels)):
            item.setZValue(5 + depth)
            item.hide()
            box.addItem(item, ignoreBounds=True)
        self._make_controls()

    def _make_controls(self) -> None:
        self.checkbox = check_box(
            "Before",
            "Show the picture before the latest change to the left of a line, and the present "
            "picture to the right of it. The line can be dragged.",
            self._arrange,
        )
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, _SLIDER_STEPS)
        self.slider.setValue(round(self._fraction * _SLIDER_STEPS))
        self.slider.setFixedWidth(_SLIDER_WIDTH)
        self.slider.setAccessibleName("Position of the line between before and now")
        self.slider.setToolTip("Position of the line, in percent of the picture's width.")
        self.slider.valueChanged.connect(self._follow_slider)
        self.slider.hide()
        self.controls = QWidget()
        fill(QHBoxLayout(self.controls), self.slider, self.checkbox, margins=0)

    def show_before(self, snapshot: Snapshot) -> None:
        self._frame = snapshot.frame
        self._update_picture()

    def choose_picture(self, picture_kind: str) -> None:
        self._picture_kind = picture_kind
        self._update_picture()

    def _update_picture(self) -> None:
        self._image = None if self._frame is None else self._frame.picture(self._picture_kind)
        if self.checkbox.isChecked():
            self._arrange()

    def _arrange(self) -> None:
        image, is_on = self._image, self.checkbox.isChecked()
        self.slider.setVisible(is_on)
        for item in (self.picture, self.line, *self._labels):
            item.setVisible(is_on and image is not None)
        if is_on and image is not None:
            self.picture.set_image(image)
            self.line.setBounds((-0.5, image.shape[1] - 0.5))
            self._place_line()

    def _place_line(self) -> None:
        """Place the line and the labels at the chosen fraction of the width."""
        if self._image is None:
            return
        column = self._fraction * self._image.shape[1] - 0.5
        with QSignalBlocker(self.line), QSignalBlocker(self.slider):
            self.line.setValue(column)
            self.slider.setValue(round(self._fraction * _SLIDER_STEPS))
        self.picture.show_within(last_column=column)
        for label in self._labels:
            label.setPos(column, -0.5)

    def _follow_line(self) -> None:
        if self._image is not None:
            self._fraction = (float(self.line.value()) + 0.5) / self._image.shape[1]
            self._place_line()

    def _follow_slider(self, position: int) -> None:
        self._fraction = position / _SLIDER_STEPS
        self._place_line()
