"""Views of a frame: its pictures side by side, and the rows of its story."""

from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QSplitter,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.picture.picture_pane import PicturePane
from occ_gui.simulation.snapshot import ColumnView, PictureView
from occ_gui.story.story_rows import StoryRows
from occ_gui.widgets.building import fill, paragraph
from occ_model.arrays import ByteArray
from occ_model.results.decoding import Region

_LEAST = QSize(140, 90)


@dataclass(frozen=True, eq=False, slots=True)
class ShownPicture:
    image: ByteArray  # shape (rows, columns)
    region: Region | None  # the part that was read; None if there is none
    caption: str
    rows_step: int = 1  # height of a row in pixels; more than 1 in a draft


class _Side(QStackedWidget):
    """A picture with its caption, or a sentence in its place."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.pane = PicturePane(name)
        self.placeholder = paragraph(name=name)
        self.placeholder.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.placeholder.setMargin(12)
        self.addWidget(self.placeholder)
        self.addWidget(self.pane)
        self.setMinimumSize(_LEAST)

    def show_picture(self, picture: ShownPicture | None, placeholder: str) -> None:
        if picture is None:
            self.placeholder.setText(placeholder)
            self.setCurrentWidget(self.placeholder)
            return
        self.pane.caption.set_full_text(picture.caption)
        self.pane.show_picture(picture.image, picture.rows_step)
        self.pane.show_region(picture.region)
        self.setCurrentWidget(self.pane)

    @property
    def has_picture(self) -> bool:
        return self.currentWidget() is self.pane


class FilmPictures(QWidget):
    """The picture of the film on the left, and the simulated picture on the right."""

    def __init__(self) -> None:
        super().__init__()
        self._film = _Side("Film")
        self._simulated = _Side("Simulated film")
        self.film, self.simulated = self._film.pane, self._simulated.pane
        self.split = QSplitter(Qt.Orientation.Horizontal, childrenCollapsible=False)
        for side in (self._film, self._simulated):
            self.split.addWidget(side)
        fill(QVBoxLayout(self), self.split, margins=0)

    def show_film(self, picture: ShownPicture | None, placeholder: str = "") -> None:
        self._film.show_picture(picture, placeholder)

    def show_simulated(self, picture: ShownPicture | None, placeholder: str = "") -> None:
        self._simulated.show_picture(picture, placeholder)

    @property
    def are_visible(self) -> tuple[bool, bool]:
        return self._film.has_picture, self._simulated.has_picture

    def fit(self) -> None:
        self.film.fit()
        self.simulated.fit()


@dataclass(frozen=True, eq=False, slots=True)
class FrameStory:
    picture: PictureView
    reading: ColumnView
    # Whether the light that its columns gathered is known, as in a simulated frame
    knows_light: bool
    title: str


class FrameRows(QWidget):
    """The rows of the story, a title that names the frame, and the ranges of columns to view."""

    picture_asked = Signal()  # the user wants to see the whole picture enlarged

    def __init__(self) -> None:
        super().__init__()
        self.rows = StoryRows()
        self.rows.stripes.thumbnail.clicked.connect(self.picture_asked)
        self.title = paragraph(name="What the rows show")
        ranges = self.rows.ranges.values()
        line = fill(QHBoxLayout(), (self.title, 1), *ranges, margins=(4, 0, 4, 0))
        fill(QVBoxLayout(self), line, (self.rows, 1), margins=(0, 4, 0, 0), spacing=2)
        self.show_story(None)

    def show_story(self, story: FrameStory | None, placeholder: str = "") -> None:
        self.rows.setVisible(story is not None)
        if story is None:
            self.title.setText(placeholder)
            return
        self.title.setText(story.title)
        # For a frame that was filmed, only what its columns gathered is known, not the light.
        self.rows.light.setVisible(story.knows_light)
        self.rows.time.setVisible(story.knows_light)
        name = "simulation" if story.knows_light else "film"
        self.rows.legend.rename("simulation", name)
        self.rows.show_picture(story.picture)
        self.rows.show_reading(story.reading)
