"""Rows of the story for one frame of a film, and whose frame it is."""

from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.simulation.preview import PictureView
from occ_gui.simulation.snapshot import ColumnView
from occ_gui.story.story_rows import StoryRows
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.layouts import filled


@dataclass(frozen=True, eq=False, slots=True)
class FrameStory:
    picture: PictureView
    reading: ColumnView
    # Whether the light that its columns gathered is known, as of a simulated frame
    knows_light: bool
    title: str


class FrameRows(QWidget):
    """The rows, with whose frame they show, and the range of columns in view."""

    picture_asked = Signal()  # the user wants to see the whole picture large

    def __init__(self) -> None:
        super().__init__()
        self.rows = StoryRows()
        self.rows.stripes.thumbnail.clicked.connect(self.picture_asked)
        self.title = ElidedLabel()
        self.title.setAccessibleName("What the rows show")
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        line = filled(QHBoxLayout(), (self.title, 1), margins=(4, 0, 4, 0))
        for button in self.rows.ranges.values():
            line.addWidget(button)
        filled(QVBoxLayout(self), line, (self.rows, 1), margins=(0, 4, 0, 0), spacing=2)
        self.show_story(None)

    def show_story(self, story: FrameStory | None, instead: str = "") -> None:
        self.rows.setVisible(story is not None)
        if story is None:
            self.title.set_full_text(instead)
            return
        self.title.set_full_text(story.title)
        # The light of a frame that was filmed is not known: only what its columns gathered of it.
        self.rows.light.setVisible(story.knows_light)
        self.rows.time.setVisible(story.knows_light)
        name = "simulation" if story.knows_light else "film"
        self.rows.legend.rename("simulation", name)
        self.rows.show_picture(story.picture)
        self.rows.show_reading(story.reading)
