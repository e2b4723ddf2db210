"""The stripes of a match, drawn over the upper part of those in the photo."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPen
from PySide6.QtWidgets import QGraphicsRectItem

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.widgets.colours import REGION
from occ_model.arrays import ByteArray
from occ_model.results.match import Match

_FRACTION = 1 / 3  # fraction of the region's rows that are covered; below are the photo's own
_LAYER = 10  # z value, below the outlines of lamps
_WIDTH = 2


class FittedStripes:
    """The fitted profile as a picture; where the fit is right, its stripes go on in the photo.

    The centre of the photo's first pixel is at (0, 0).
    """

    def __init__(self, box: pg.ViewBox) -> None:
        self.picture, self.frame = AveragedImage(), QGraphicsRectItem()
        self.word = pg.TextItem("fitted", color=REGION, anchor=(0, 1), fill=(0, 0, 0, 160))
        pen = QPen(REGION, _WIDTH)
        pen.setCosmetic(True)
        self.frame.setPen(pen)
        self.items = (self.picture, self.frame, self.word)
        for item in self.items:
            item.setZValue(_LAYER)
            item.hide()
            box.addItem(item, ignoreBounds=True)

    def show_match(self, match: Match | None) -> None:
        """Show the stripes of a match; None hides those of the last one."""
        if match is not None:
            region = match.region
            rows = max(1, round(_FRACTION * region.rows))
            left, top = region.first_column - 0.5, region.first_row - 0.5
            rect = QRectF(left, top, region.columns, rows)
            self.picture.set_image(stripes_of(match), rect)
            self.frame.setRect(rect)
            self.word.setPos(left, top + rows)
        for item in self.items:
            item.setVisible(match is not None)


def stripes_of(match: Match) -> ByteArray:
    """Return the fitted profile in whole grey levels, shape (1, columns)."""
    return np.asarray(np.rint(np.clip(match.profile, 0, 255)), np.uint8)[None, :]
