"""The picture: the simulation, and a photo beside it or over it."""

import pyqtgraph as pg
from PySide6.QtCore import QRectF, Qt
from PySide6.QtWidgets import (
    QGraphicsRectItem,
    QHBoxLayout,
    QLabel,
    QSlider,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from occ_gui.state.snapshot import Snapshot
from occ_gui.views.averaged_image import AveragedImage
from occ_gui.views.plots import REGION
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.arrays import ByteArray
from occ_model.photo.load import Photo
from occ_model.results import Region

_REGION_PEN = pg.mkPen(REGION, width=2)


class PicturePane(QWidget):
    """One picture with its caption, and what lies on it.

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
        self._over = AveragedImage()
        self._over.setOpacity(0.5)
        self._region = QGraphicsRectItem()
        self._region.setPen(_REGION_PEN)
        for item in (self._picture, self._over, self._region):
            self.box.addItem(item, ignoreBounds=item is not self._picture)
        self._shape: tuple[int, ...] = ()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(2)
        layout.addWidget(self.caption)
        layout.addWidget(self._graphics, 1)

    def show_picture(self, image: ByteArray) -> None:
        """Show a picture; the view moves only when its size changes."""
        self._picture.set_image(image)
        if image.shape != self._shape:
            self._shape = image.shape
            self.fit()

    def show_over(self, image: ByteArray | None, origin: tuple[float, float]) -> None:
        """Lay a picture over the other, pixel on pixel, or take it away.

        Parameters
        ----------
        image : ndarray of uint8, shape (rows, columns), or None
            The picture.
        origin
            Column and row of the other on which its first pixel lies.
        """
        self._over.setVisible(image is not None)
        if image is not None:
            rows, columns = image.shape
            self._over.set_image(image, QRectF(origin[0] - 0.5, origin[1] - 0.5, columns, rows))

    def set_over_opacity(self, opacity: float) -> None:
        """Let the picture that lies over the other be seen through."""
        self._over.setOpacity(opacity)

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


class ImageView(QWidget):
    """The simulated picture with the decoder's region, and the photo beside or over it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._photo: Photo | None = None
        self._over = False
        self._origin = (0.0, 0.0)
        self.simulation = PicturePane(self.tr("Simulated picture"))
        self.photo = PicturePane(self.tr("Photo"))
        panes = QSplitter(Qt.Orientation.Horizontal)
        panes.addWidget(self.simulation)
        panes.addWidget(self.photo)
        panes.setChildrenCollapsible(False)
        panes.setSizes([500, 500])
        self._opacity_row = self._make_opacity_row()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.addWidget(panes, 1)
        layout.addWidget(self._opacity_row)
        self._arrange()

    def _make_opacity_row(self) -> QWidget:
        row = QWidget()
        layout = QHBoxLayout(row)
        layout.setContentsMargins(0, 0, 0, 0)
        self.opacity = QSlider(Qt.Orientation.Horizontal)
        self.opacity.setRange(0, 100)
        self.opacity.setValue(50)
        self.opacity.setAccessibleName(self.tr("Opacity of the photo"))
        self.opacity.setToolTip(self.tr("Opacity of the photo over the simulation, in percent."))
        self.opacity.valueChanged.connect(
            lambda percent: self.simulation.set_over_opacity(percent / 100)
        )
        for widget in (QLabel(self.tr("Simulation")), self.opacity, QLabel(self.tr("Photo"))):
            layout.addWidget(widget)
        return row

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""
        self.simulation.show_picture(snapshot.frame.image)
        self.simulation.show_region(snapshot.decoded.region)
        self._origin = snapshot.panel_origin
        self._arrange()

    def show_photo(self, photo: Photo | None) -> None:
        """Show this photo in place of the last one, or none."""
        self._photo = photo
        if photo is not None:
            self.photo.show_picture(photo.image)
            turned = self.tr(", its lines shown as columns") if photo.turned else ""
            self.photo.caption.set_full_text(
                self.tr("Photo {name}{turned}").format(name=photo.path.name, turned=turned)
            )
        self._arrange()

    def set_over(self, over: bool) -> None:
        """Show the photo over the simulated panel, pixel on pixel, or beside the picture."""
        self._over = over
        self._arrange()

    def fit(self) -> None:
        """Show both pictures whole."""
        self.simulation.fit()
        self.photo.fit()

    def _arrange(self) -> None:
        over = self._photo is not None and self._over
        self.photo.setVisible(self._photo is not None and not self._over)
        self._opacity_row.setVisible(over)
        self.simulation.show_over(self._photo.image if over and self._photo else None, self._origin)
