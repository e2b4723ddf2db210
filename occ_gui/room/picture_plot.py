"""The camera's picture of a room, with the names of the lamps that were read."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.room.jobs import ShownRoom
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.pens import BAND, SIMULATION, thin
from occ_gui.widgets.plot import new_plot

_NAME = 0.025  # fraction of the picture's height that half a name takes


class PicturePlot(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot("The camera's picture", "column", "row", self.palette())
        self.plot.setAspectLocked(True)
        self.plot.invertY(True)
        self.plot.setMouseEnabled(False, False)
        self.image = pg.ImageItem(axisOrder="row-major")
        self.plot.addItem(self.image)
        self._over: list[pg.GraphicsObject] = []
        filled(QVBoxLayout(self), self.plot, margins=0)

    def show_room(self, shown: ShownRoom) -> None:
        rows, columns = shown.image.shape
        margin = _NAME * rows
        self.image.setImage(shown.picture, levels=(0, 255))
        self.image.setRect(QRectF(-0.5, -0.5, columns, rows))
        self.plot.setXRange(0, columns, padding=0)
        self.plot.setYRange(0, rows, padding=0)
        for item in self._over:
            self.plot.removeItem(item)
        self._over = []
        for read in shown.reading.lamps if shown.reading else ():
            colour = SIMULATION if read.name else BAND
            closed = np.vstack([read.hull, read.hull[:1]])
            outline = pg.PlotCurveItem(closed[:, 0], closed[:, 1], pen=thin(colour))
            name = pg.TextItem(read.name or "?", color="w", fill=colour, anchor=(0.5, 0.5))
            # Of a lamp at the edge too, the whole name is seen.
            middle = np.clip(read.hull.mean(axis=0), margin, (columns - margin, rows - margin))
            name.setPos(*middle.tolist())
            for item in (outline, name):
                self.plot.addItem(item, ignoreBounds=True)
                self._over.append(item)
