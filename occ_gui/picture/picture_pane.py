"""View of a single picture with its caption and the region that was decoded."""

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QRectF, Qt
from PySide6.QtWidgets import QGraphicsRectItem, QHBoxLayout, QVBoxLayout, QWidget

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.widgets.building import ElidedLabel, fill
from occ_gui.widgets.colours import REGION
from occ_model.arrays import ByteArray
from occ_model.results.decoding import Region

_REGION_PEN = pg.mkPen(REGION, width=2)

_MAX_DISTANCE = 1e7  # largest distance from the first pixel that can be shown, in pixels
_LARGEST_SPAN = 4e6  # largest range of the view in pixels
_LEAST_SPAN = 0.5  # smallest range of the view in pixels


class PicturePane(QWidget):
    def __init__(self, caption: str) -> None:
        super().__init__()
        self.caption = ElidedLabel(caption, how=Qt.TextElideMode.ElideMiddle)
        self.graphics = pg.GraphicsView()
        self.graphics.setBackground(self.palette().dark().color())
        self.graphics.setAccessibleName(caption)
        self.box = pg.ViewBox(lockAspect=True, invertY=True, enableMenu=False)
        self.box.setLimits(
            xMin=-_MAX_DISTANCE, xMax=_MAX_DISTANCE, yMin=-_MAX_DISTANCE, yMax=_MAX_DISTANCE,
            minXRange=_LEAST_SPAN, minYRange=_LEAST_SPAN,
            maxXRange=_LARGEST_SPAN, maxYRange=_LARGEST_SPAN,
        )  # fmt: skip
        self.graphics.setCentralItem(self.box)
        self._picture = AveragedImage(with_values=True)
        self._region = QGraphicsRectItem()
        self._region.setPen(_REGION_PEN)
        self.box.addItem(self._picture)
        self.box.addItem(self._region, ignoreBounds=True)
        self._image: ByteArray | None = None
        self._rows_step = 1
        layout = fill(QVBoxLayout(self), margins=0, spacing=2)
        self.caption_row = QHBoxLayout()
        self.caption_row.addWidget(self.caption, 1)
        layout.addLayout(self.caption_row)
        layout.addWidget(self.graphics, 1)

    def show_picture(self, image: ByteArray, rows_step: int = 1) -> None:
        """Show a picture; the zoom changes only if the size of the picture does.

        ``rows_step``: the height of a row in pixels; more than 1 in a draft, which covers the same
        area as the whole picture.
        """
        rows, columns = image.shape
        rect = QRectF(-0.5, -0.5, columns, rows * rows_step)
        self._picture.set_image(image, rect)
        last_image, self._image = self._image, image
        last_step, self._rows_step = self._rows_step, rows_step
        if (
            last_image is None
            or last_image.shape[1] != columns
            or _differ_in_height(last_image, last_step, image, rows_step)
        ):
            self.fit()

    def rows_per_pixel(self) -> float:
        """Return how many rows of the picture lie under a pixel of the screen."""
        height = self.graphics.height() * self.graphics.devicePixelRatioF()
        return float(self.box.viewRect().height() / max(height, 1.0))

    def level_at(self, column: int, row: int) -> int | None:
        image = self._image
        row //= self._rows_step
        if image is None or not (0 <= row < image.shape[0] and 0 <= column < image.shape[1]):
            return None
        return int(image[row, column])

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.graphics.setBackground(self.palette().dark().color())

    def show_region(self, region: Region | None) -> None:
        self._region.setVisible(region is not None)
        if region is not None:
            self._region.setRect(
                QRectF(
                    region.first_column - 0.5, region.first_row - 0.5, region.columns, region.rows
                )
            )

    def fit(self) -> None:
        self.box.setRange(self._picture.boundingRect(), padding=0.01)


def _differ_in_height(
    first: ByteArray, first_step: int, second: ByteArray, second_step: int
) -> bool:
    """Return whether two pictures differ in height, beyond the last row of a draft."""
    difference: int = abs(first.shape[0] * first_step - second.shape[0] * second_step)
    return difference >= max(first_step, second_step)
