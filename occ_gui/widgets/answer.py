"""Answer: one line in large letters, and more about it that unfolds below."""

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton, QVBoxLayout, QWidget

from occ_gui.widgets.building import fill, heading_font, paragraph


class Answer(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self.line, self.details = (paragraph(is_selectable=True) for _ in range(2))
        self.line.setFont(heading_font(self.font()))
        self.more = QToolButton()
        self.more.setText("More")
        self.more.setToolTip("Why, and what else follows.")
        self.more.setCheckable(True)
        self.more.setAutoRaise(True)
        self.more.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.more.toggled.connect(self._unfold)
        fill(QVBoxLayout(self), self.line, self.more, self.details, margins=0, spacing=4)
        self._unfold(False)
        self.show_answer("")

    def show_answer(self, line: str, details: Iterable[str] = ()) -> None:
        text = "\n".join(details)
        self.line.setText(line)
        self.details.setText(text)
        self.more.setVisible(bool(text))
        self.details.setVisible(bool(text) and self.more.isChecked())

    def _unfold(self, unfolds: bool) -> None:
        self.more.setArrowType(Qt.ArrowType.DownArrow if unfolds else Qt.ArrowType.RightArrow)
        self.details.setVisible(unfolds)
