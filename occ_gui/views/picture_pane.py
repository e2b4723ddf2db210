"""One picture with its caption."""

import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QGraphicsRectItem, QHBoxLayout, QVBoxLayout, QWidget

from occ_gui.views.averaged_image import AveragedImage
from occ_gui.views.plots import REGION
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.arrays import ByteArray
from occ_model.results import Region

_REGION_PEN = pg.mkPen(REGION, width=2)


class PicturePane(QWidget):
    """One picture with its caption, and the region that was read.

    Parameters
    ----------
    caption
        What the picture is.
    parent
        The parent widget.
    """

    def __init__(self, caption: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.caption = ElidedLabel(caption)
        self._graphics = pg.GraphicsView()
        self._graphics.setBackground(self.palette().dark().color())
        self._graphics.setAccessibleName(caption)
        self.box = pg.ViewBox(lockAspect=True, invertY=True, enableMenu=False)
        self._graphics.setCentralItem(self.box)
        self._picture = AveragedImage()
        self._region = QGraphicsRectItem()
        self._region.setPen(_REGION_PEN)
        self.box.addItem(self._picture)
        self.box.addItem(self._region, ignoreBounds=True)
        self._shape: tuple[int, ...] = ()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(2)
        self.caption_row = QHBoxLayout()
        self.caption_row.addWidget(self.caption, 1)
        layout.addLayout(self.caption_row)
        layout.addWidget(self._graphics, 1)

    def show_picture(self, image: ByteArray) -> None:
        """Show a picture; the view moves only when its size changes."""
        self._picture.set_image(image)
        if image.shape != self._shape:
            self._shape = image.shape
            self.fit()

    def show_region(self, region: Region | None) -> None:
        """Draw the rectangle that the decoder read, or none."""
        self._region.setVisible(region is not None)
        if region is not None:
            self._region.setRect(
                QRectF(
                    region.first_column - 0.5,
                    region.first_row - 0.5,
                    region.columns,
                    region.rows,
                )
            )

    def fit(self) -> None:
        """Show the whole picture."""
        self.box.setRange(self._picture.boundingRect(), padding=0.01)
