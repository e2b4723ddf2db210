"""Pictures of the frame that is shown: of the film, and as it is simulated, side by side."""

from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QLabel, QSplitter, QStackedWidget, QVBoxLayout, QWidget

from occ_gui.picture.picture_pane import PicturePane
from occ_gui.widgets.layouts import filled
from occ_model.arrays import ByteArray
from occ_model.results.decoding import Region

_LEAST = QSize(140, 90)


@dataclass(frozen=True, eq=False, slots=True)
class ShownPicture:
    """A picture of a frame, ready to be drawn."""

    image: ByteArray  # shape (rows, columns): the picture
    halves: tuple[ByteArray, ...]
    region: Region | None  # what was read of it, None where nothing was found
    caption: str
    rows_step: int = 1  # height of a row: more than 1 in a draft


class _Side(QStackedWidget):
    """A picture with its caption, or a sentence in its place."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.pane = PicturePane(name)
        self.instead = QLabel()
        self.instead.setWordWrap(True)
        self.instead.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.instead.setTextFormat(Qt.TextFormat.PlainText)
        self.instead.setMargin(12)
        self.instead.setAccessibleName(name)
        self.addWidget(self.instead)
        self.addWidget(self.pane)
        self.setMinimumSize(_LEAST)

    def show_picture(self, picture: ShownPicture | None, instead: str) -> None:
        if picture is None:
            self.instead.setText(instead)
            self.setCurrentWidget(self.instead)
            return
        self.pane.caption.set_full_text(picture.caption)
        self.pane.show_picture(picture.image, picture.halves, picture.rows_step)
        self.pane.show_region(picture.region)
        self.setCurrentWidget(self.pane)

    @property
    def is_shown(self) -> bool:
        return self.currentWidget() is self.pane


class FilmPictures(QWidget):
    """The film's picture at the left, the simulated one at the right."""

    def __init__(self) -> None:
        super().__init__()
        self._film = _Side("Film")
        self._simulated = _Side("Simulated film")
        self.film, self.simulated = self._film.pane, self._simulated.pane
        self.split = QSplitter(Qt.Orientation.Horizontal, childrenCollapsible=False)
        for side in (self._film, self._simulated):
            self.split.addWidget(side)
        filled(QVBoxLayout(self), self.split, margins=0)

    def show_film(self, picture: ShownPicture | None, instead: str = "") -> None:
        self._film.show_picture(picture, instead)

    def show_simulated(self, picture: ShownPicture | None, instead: str = "") -> None:
        self._simulated.show_picture(picture, instead)

    @property
    def shown(self) -> tuple[bool, bool]:
        return self._film.is_shown, self._simulated.is_shown

    def fit(self) -> None:
        self.film.fit()
        self.simulated.fit()
