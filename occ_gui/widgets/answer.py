"""Answer: a line in large letters, a note below it, and details that a button shows."""

from collections.abc import Iterable

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QVBoxLayout, QWidget

from occ_gui.widgets.building import fill, heading_font, paragraph
from occ_gui.widgets.event_filters import call_at


class MoreButton(QToolButton):
    """A button that shows and hides what stands below it."""

    def __init__(self) -> None:
        super().__init__()
        self.setText("More")
        self.setToolTip("Why, and what else follows.")
        self.setCheckable(True)
        self.setAutoRaise(True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.toggled.connect(self._turn_arrow)
        self._turn_arrow(False)

    def _turn_arrow(self, is_down: bool) -> None:
        self.setArrowType(Qt.ArrowType.DownArrow if is_down else Qt.ArrowType.RightArrow)


class Answer(QWidget):
    """A line, a note and details; *More* shows the details, and ``unfolds``, a widget elsewhere."""

    def __init__(self, unfolds: QWidget | None = None) -> None:
        super().__init__()
        self.line, self.note, self.details = (paragraph(is_selectable=True) for _ in range(3))
        self._enlarge_line()
        call_at(self, self._enlarge_line, QEvent.Type.FontChange)
        self._unfolds = unfolds
        self.more = MoreButton()
        self.more.toggled.connect(lambda: self._unfold(bool(self.details.text())))
        top = Qt.AlignmentFlag.AlignTop
        row = fill(QHBoxLayout(), (self.line, 1), (self.more, 0, top), spacing=8)
        fill(QVBoxLayout(self), row, self.note, self.details, margins=0, spacing=4)
        self.show_answer("")

    def _enlarge_line(self) -> None:
        self.line.setFont(heading_font(self.font()))

    def show_answer(self, line: str, details: Iterable[str] = (), note: str = "") -> None:
        """Show a line, a note below it, and the details that *More* shows."""
        text = "\n".join(details)
        self.line.setText(line)
        self.note.setText(note)
        self.note.setVisible(bool(note))
        self.details.setText(text)
        self._unfold(bool(text))

    def _unfold(self, has_details: bool) -> None:
        self.more.setVisible(has_details or (self._unfolds is not None and self._has_line))
        self.details.setVisible(has_details and self.more.isChecked())
        if self._unfolds is not None:
            self._unfolds.setVisible(self.more.isChecked() and self._has_line)

    @property
    def _has_line(self) -> bool:
        return bool(self.line.text())
