"""Pane of the story: the verdict above the picture."""

from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.simulation.snapshot import Reading
from occ_gui.story.verdict_bar import VerdictBar


class StoryView(QWidget):
    """The verdict on the code, above the simulated picture.

    Parameters
    ----------
    picture
        The pane of the whole picture.
    parent
        The parent widget.
    """

    def __init__(self, picture: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.verdict = VerdictBar()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.setSpacing(4)
        layout.addWidget(self.verdict)
        layout.addWidget(picture, 1)

    def show_reading(self, reading: Reading) -> None:
        """Show this reading in place of the previous one."""
        self.verdict.show_reading(reading)

    show_snapshot = show_reading
