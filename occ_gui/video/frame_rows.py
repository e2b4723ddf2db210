"""Rows of the story for one frame of a film, and whose frame it is."""

from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.simulation.preview import PictureView
from occ_gui.simulation.snapshot import ColumnView
from occ_gui.story.story_rows import RANGES, StoryRows
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.first_periods import PACKETS_IN_VIEW
from occ_gui.widgets.layouts import filled


@dataclass(frozen=True, eq=False, slots=True)
class FrameStory:
    """What the rows show of one frame."""

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
        self.title = ElidedLabel("", Qt.TextElideMode.ElideRight)
        self.title.setAccessibleName("What the rows show")
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        line = filled(QHBoxLayout(), (self.title, 1), margins=(4, 0, 4, 0))
        texts = (f"{PACKETS_IN_VIEW} packets", "Panel")
        tips = ("Show the first packets.", "Show all columns of the panel.")
        self.ranges: dict[str, QPushButton] = {}
        for name, text, tip in zip(RANGES, texts, tips, strict=True):
            button = QPushButton(text)
            button.setCheckable(True)
            button.setToolTip(tip)
            button.clicked.connect(lambda _=False, name=name: self.choose_range(name))
            line.addWidget(button)
            self.ranges[name] = button
        filled(QVBoxLayout(self), line, (self.rows, 1), margins=(0, 4, 0, 0), spacing=2)
        self.rows.range_left.connect(lambda: self._mark_range(""))
        self.rows.range_kept.connect(lambda: self._mark_range(self.rows.range))
        self._mark_range(RANGES[0])
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

    def choose_range(self, name: str) -> None:
        """Show the first packets or the whole panel, one of RANGES."""
        self.rows.choose_range(name)
        self._mark_range(name)

    def _mark_range(self, name: str) -> None:
        for key, button in self.ranges.items():
            button.setChecked(key == name)
