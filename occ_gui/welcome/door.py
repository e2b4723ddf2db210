"""A door: a large button with a picture, a title and a sentence."""

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.widgets.icons import pixmap
from occ_gui.widgets.text_scale import emboldened

_PICTURE = 96
_LARGER = 1.2
_LEAST_SIDE = 208


class Door(QPushButton):
    def __init__(
        self, picture: str, title: str, sentence: str, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._name = picture
        self._picture, self._sentence = QLabel(), QLabel(sentence)
        self._title = emboldened(QLabel(title), _LARGER)
        self.setAccessibleName(title)
        self.setAccessibleDescription(sentence)
        layout = self._layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.setSpacing(8)
        for label in (self._picture, self._title, self._sentence):
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            label.setAlignment(Qt.AlignmentFlag.AlignHCenter)
            label.setWordWrap(label is not self._picture)
            layout.addWidget(label)
        layout.addStretch()
        self._draw()

    def size_for(self, width: int = _LEAST_SIDE) -> QSize:
        """Return the size that shows all texts, at least as wide as asked for and no narrower."""
        width = max(width, self._layout.minimumSize().width())
        return QSize(width, max(_LEAST_SIDE, self._layout.heightForWidth(width)))

    def _draw(self) -> None:
        colour = self.palette().color(QPalette.ColorRole.ButtonText)
        self._picture.setPixmap(pixmap(self._name, colour, _PICTURE, self.devicePixelRatioF()))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.DevicePixelRatioChange):
            self._draw()
