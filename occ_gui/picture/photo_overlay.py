"""Photo over the simulated picture: blended, split at a line, or as their difference."""

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QObject, QPointF, QRectF, Signal

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.difference_image import DifferenceImage
from occ_gui.values.photo_choice import MODES, Placement
from occ_gui.widgets.pens import PHOTO, REGION
from occ_model.arrays import ByteArray

_NO_IMAGE: ByteArray = np.zeros((0, 0), dtype=np.uint8)

_LINE_PEN = pg.mkPen(REGION, width=2)
_FRAME_PEN = pg.mkPen(PHOTO, width=2)


def rect_of(image: ByteArray, placement: Placement) -> QRectF:
    """Return the rectangle of a placed image; the placement is the centre of its first pixel."""
    rows, columns = image.shape
    half = placement.scale / 2
    return QRectF(
        placement.column - half,
        placement.row - half,
        columns * placement.scale,
        rows * placement.scale,
    )


class PhotoOverlay(QObject):
    """The items drawn over the simulated picture while a photo is shown over it."""

    placed = Signal(object)  # the user moved or scaled the photo: a Placement

    def __init__(self, box: pg.ViewBox) -> None:
        super().__init__()
        self._simulated = _NO_IMAGE
        self._photo: ByteArray | None = None
        self.placement = Placement()
        self.mode = MODES[0]
        self._movable = False
        self._updating_frame = False
        self._over, self.difference = AveragedImage(), DifferenceImage()
        self._over.setOpacity(0.5)
        self.line = pg.InfiniteLine(angle=0, movable=True, pen=_LINE_PEN)
        self.line.sigPositionChanged.connect(self._split)
        self.line.sigDragged.connect(self._keep_line)
        self._line_is_centred = True
        self.frame = pg.ROI((0, 0), (1, 1), pen=_FRAME_PEN, rotatable=False)
        self.frame.addScaleHandle((1, 1), (0, 0), lockAspect=True)
        self.frame.addScaleHandle((0, 0), (1, 1), lockAspect=True)
        self.frame.sigRegionChanged.connect(self._follow_frame)
        for depth, item in enumerate((self._over, self.difference, self.line, self.frame)):
            item.setZValue(10 + depth)
            box.addItem(item, ignoreBounds=True)
        self.opacity = 0.5
        self._arrange()

    def set_simulated(self, image: ByteArray) -> None:
        """Set the picture under the photo, its first pixel's centre at (0, 0)."""
        self._simulated = image
        if self.mode == "difference":
            self._compare()

    def set_photo(self, photo: ByteArray | None) -> None:
        self._photo = photo
        self._line_is_centred = True
        self._arrange()

    def set_placement(self, placement: Placement) -> None:
        self.placement = placement
        self._arrange()

    @property
    def times(self) -> int:
        return self.difference.gain

    def set_mode(self, mode: str) -> None:
        """Set the way of showing the photo, one of MODES; nothing is drawn over for the first."""
        self.mode = mode
        self._arrange()

    def set_opacity(self, opacity: float) -> None:
        """Set the opacity of a blended photo, from 0 to 1."""
        self.opacity = opacity
        self._arrange()

    def set_movable(self, movable: bool) -> None:
        self._movable = movable
        self._arrange()

    @property
    def split_row(self) -> float:
        return float(self.line.value())

    def _arrange(self) -> None:
        photo = self._photo
        over = photo is not None and self.mode != "beside"
        self._over.setVisible(over and self.mode != "difference")
        self._over.setOpacity(self.opacity if self.mode == "blend" else 1.0)
        self.line.setVisible(over and self.mode == "split")
        self.difference.setVisible(over and self.mode == "difference")
        self.frame.setVisible(over and self._movable)
        if photo is None or not over:
            return
        rect = rect_of(photo, self.placement)
        self._over.set_image(photo, rect)
        if self._line_is_centred:
            self.line.setValue(rect.center().y())
        self._split()
        if self.mode == "difference":
            self.difference.set_image(1, photo, rect)
            self._compare()
        self._updating_frame = True
        self.frame.setPos(rect.topLeft(), update=False)
        self.frame.setSize((rect.width(), rect.height()))
        self._updating_frame = False

    def _compare(self) -> None:
        self.difference.set_image(0, self._simulated, rect_of(self._simulated, Placement()))

    def _split(self) -> None:
        self._over.show_from(self.line.value() if self.mode == "split" else -math.inf)

    def _keep_line(self) -> None:
        self._line_is_centred = False

    def _follow_frame(self) -> None:
        if self._updating_frame or self._photo is None:
            return
        corner: QPointF = self.frame.pos()
        scale = float(self.frame.size().x()) / self._photo.shape[1]
        self.placed.emit(Placement(corner.x() + scale / 2, corner.y() + scale / 2, scale))
