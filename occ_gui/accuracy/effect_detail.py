"""Selected effect: its pictures enlarged, and the plan's reason in words."""

import math

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QVBoxLayout, QWidget

from occ_gui.accuracy.effect_cells import make_image
from occ_gui.accuracy.effect_rows import EVERYTHING_ELSE, EffectRow
from occ_gui.widgets.building import embolden, fill, paragraph
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_model.results.accuracy import EffectCrop

_GAP = 8
_LARGEST_SCALE = 3


class CropPictures(PaintedWidget):
    """The part of the panel with an effect, without it, and the difference, side by side."""

    def __init__(self) -> None:
        super().__init__()
        self._images: tuple[QImage, ...] = ()
        self._captions: tuple[str, ...] = ()
        self._are_pixels = False
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_crop(self, crop: EffectCrop | None) -> None:
        self._images = ()
        if crop is not None:
            self._are_pixels = not crop.is_averaged
            self._images = tuple(
                make_image(pixels)
                for pixels in (crop.with_effect, crop.without_effect, crop.difference)
            )
            difference = f"difference × {crop.amplification}"  # noqa: RUF001
            self._captions = ("with it", "without it", difference)
        self.setAccessibleName(", ".join(self._captions) if self._images else "")
        self.update()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(3 * 96 + 2 * _GAP, 40 + self.fontMetrics().height())

    def height_for(self, width: int) -> int:
        if not self._images:
            return 0
        size = self._images[0].size()
        scale = min((width - 2 * _GAP) / (3 * size.width()), _LARGEST_SCALE)
        return math.ceil(scale * size.height()) + self.fontMetrics().height() + 4

    def paint_with(self, painter: QPainter) -> None:
        if not self._images:
            return
        line = self.fontMetrics().height()
        width, height = (self.width() - 2 * _GAP) // 3, self.height() - line - 2
        size = self._images[0].size()
        scale = min(width / size.width(), height / size.height(), _LARGEST_SCALE)
        if scale >= 1.0 and self._are_pixels:
            scale = int(scale)  # each pixel is drawn as a square of screen pixels
        size = QSize(round(scale * size.width()), round(scale * size.height()))
        is_smooth = scale < 1.0 or not self._are_pixels
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, is_smooth)
        for place, (image, caption) in enumerate(zip(self._images, self._captions, strict=True)):
            left = place * (size.width() + _GAP)
            painter.drawImage(QRect(left, 0, size.width(), size.height()), image)
            caption_area = QRect(left, size.height() + 2, max(size.width(), width), line)
            painter.drawText(caption_area, Qt.AlignmentFlag.AlignLeft, caption)


class EffectDetail(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self.title = embolden(paragraph())
        self.crop_note, self.error = paragraph(), paragraph()
        self.pictures = CropPictures()
        fill(
            QVBoxLayout(self), self.title, (self.pictures, 1), self.crop_note, self.error,
            None, margins=(8, 0, 0, 0), spacing=4,
        )  # fmt: skip
        self.show_row(None, None)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._limit_pictures()
        if event.oldSize().width() != event.size().width():
            self.updateGeometry()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a height with room for all lines of the texts, not for one of each."""
        least, layout = super().minimumSizeHint(), self.layout()
        height = layout.minimumHeightForWidth(self.width()) if layout is not None else 0
        return QSize(least.width(), max(least.height(), height))

    def _limit_pictures(self) -> None:
        self.pictures.setMaximumHeight(self.pictures.height_for(self.width() - _GAP))

    def show_row(self, row: EffectRow | None, crop: EffectCrop | None) -> None:
        self.pictures.show_crop(crop)
        if row is None:
            self.title.setText("Select an effect to see what it does.")
            texts = ("", "")
        else:
            self.title.setText(row.label)
            texts = (self._describe_crop(row, crop), row.error_meaning)
        for label, text in zip((self.crop_note, self.error), texts, strict=True):
            label.setText(text)
            label.setVisible(bool(text))
        self._limit_pictures()

    def _describe_crop(self, row: EffectRow, crop: EffectCrop | None) -> str:
        if crop is None:
            return (
                "" if row.is_absent or row.effect == EVERYTHING_ELSE else "Computing its pictures…"
            )
        where = "Whole panel, averaged" if crop.is_averaged else "Real pixels where it changes most"
        return f"This effect alone. {where}; contrast stretched."
