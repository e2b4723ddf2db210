"""Answer: one line in large letters, and more about it that unfolds below."""

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton, QVBoxLayout, QWidget

from occ_gui.widgets.building import fill, heading_font, paragraph


class MoreButton(QToolButton):
    """A button that shows and hides what stands below it."""

    def __init__(self) -> None:
        super().__init__()
        self.setText("More")
        self.setToolTip("Why, and what else follows.")
        self.setCheckable(True)
        self.setAutoRaise(True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.toggled.connect(self._point)
        self._point(False)

    def _point(self, unfolds: bool) -> None:
        self.setArrowType(Qt.ArrowType.DownArrow if unfolds else Qt.ArrowType.RightArrow)


class Answer(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self.line, self.details = (paragraph(is_selectable=True) for _ in range(2))
        self.line.setFont(heading_font(self.font()))
        self.more = MoreButton()
        self.more.toggled.connect(self.details.setVisible)
        fill(QVBoxLayout(self), self.line, self.more, self.details, margins=0, spacing=4)
        self.show_answer("")

    def show_answer(self, line: str, details: Iterable[str] = ()) -> None:
        text = "\n".join(details)
        self.line.setText(line)
        self.details.setText(text)
        self.more.setVisible(bool(text))
        self.details.setVisible(bool(text) and self.more.isChecked())
