"""A photo on a picture: seen through, up to a line, or as a difference, and moved by the mouse."""

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QObject, QPointF, QRectF, Signal

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.difference_image import DifferenceImage
from occ_gui.picture.placement import Placement
from occ_gui.widgets.plot import PHOTO, REGION
from occ_model.arrays import ByteArray

MODES = ("beside", "blend", "split", "difference")
"""How a photo is shown with the simulated picture."""

_NO_IMAGE: ByteArray = np.zeros((0, 0), dtype=np.uint8)

_LINE_PEN = pg.mkPen(REGION, width=2)
_FRAME_PEN = pg.mkPen(PHOTO, width=2)


def rect_of(image: ByteArray, placement: Placement) -> QRectF:
    """Say where a placed image lies, the centre of its first pixel at the placement."""
    rows, columns = image.shape
    half = placement.scale / 2
    return QRectF(
        placement.column - half,
        placement.row - half,
        columns * placement.scale,
        rows * placement.scale,
    )


class PhotoOverlay(QObject):
    """What lies on the simulated picture while a photo is shown over it.

    Parameters
    ----------
    box
        The view of the simulated picture.
    """

    placed = Signal(object)
    """Where the user has put the photo: a Placement."""

    def __init__(self, box: pg.ViewBox) -> None:
        super().__init__()
        self._simulated = _NO_IMAGE
        self._photo: ByteArray | None = None
        self._placement = Placement()
        self._mode = MODES[0]
        self._movable = False
        self._showing = False
        self._over, self.difference = AveragedImage(), DifferenceImage()
        self._over.setOpacity(0.5)
        self.line = pg.InfiniteLine(angle=0, movable=True, pen=_LINE_PEN)
        self.line.sigPositionChanged.connect(self._split)
        self.line.sigDragged.connect(self._leave_line)
        self._line_is_free = True
        self.frame = pg.ROI((0, 0), (1, 1), pen=_FRAME_PEN, rotatable=False)
        self.frame.addScaleHandle((1, 1), (0, 0), lockAspect=True)
        self.frame.addScaleHandle((0, 0), (1, 1), lockAspect=True)
        self.frame.sigRegionChanged.connect(self._follow_frame)
        for depth, item in enumerate((self._over, self.difference, self.line, self.frame)):
            item.setZValue(10 + depth)
            box.addItem(item, ignoreBounds=True)
        self._opacity = 0.5
        self._arrange()

    def set_simulated(self, image: ByteArray) -> None:
        """Say which picture the photo lies on, its first pixel's centre at (0, 0)."""
        self._simulated = image
        if self._mode == "difference":
            self._compare()

    def set_photo(self, photo: ByteArray | None) -> None:
        """Lay this photo on the picture in place of the last one, or none."""
        self._photo = photo
        self._line_is_free = True
        self._arrange()

    def set_placement(self, placement: Placement) -> None:
        """Say where the photo lies."""
        self._placement = placement
        self._arrange()

    def set_mode(self, mode: str) -> None:
        """Say how the photo is shown, one of MODES; beside the picture nothing lies on it."""
        self._mode = mode
        self._arrange()

    def set_opacity(self, opacity: float) -> None:
        """Say how much a blended photo hides, from 0 to 1."""
        self._opacity = opacity
        self._arrange()

    def set_movable(self, movable: bool) -> None:
        """Say whether the mouse can move and scale the photo."""
        self._movable = movable
        self._arrange()

    def _arrange(self) -> None:
        photo = self._photo
        over = photo is not None and self._mode != "beside"
        self._over.setVisible(over and self._mode != "difference")
        self._over.setOpacity(self._opacity if self._mode == "blend" else 1.0)
        self.line.setVisible(over and self._mode == "split")
        self.difference.setVisible(over and self._mode == "difference")
        self.frame.setVisible(over and self._movable)
        if photo is None or not over:
            return
        rect = rect_of(photo, self._placement)
        self._over.set_image(photo, rect)
        if self._line_is_free:
            self.line.setValue(rect.center().y())
        self._split()
        if self._mode == "difference":
            self.difference.set_image(1, photo, rect)
            self._compare()
        self._showing = True
        self.frame.setPos(rect.topLeft(), update=False)
        self.frame.setSize((rect.width(), rect.height()))
        self._showing = False

    def _compare(self) -> None:
        self.difference.set_image(0, self._simulated, rect_of(self._simulated, Placement()))

    def _split(self) -> None:
        self._over.show_from(self.line.value() if self._mode == "split" else -math.inf)

    def _leave_line(self) -> None:
        """Let the line stay where the user has put it."""
        self._line_is_free = False

    def _follow_frame(self) -> None:
        if self._showing or self._photo is None:
            return
        corner: QPointF = self.frame.pos()
        scale = float(self.frame.size().x()) / self._photo.shape[1]
        self.placed.emit(Placement(corner.x() + scale / 2, corner.y() + scale / 2, scale))
