"""Lines of a measured readout time for other programs, each with a button that copies it."""

from collections.abc import Mapping

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLineEdit, QToolButton, QWidget


class PasteLines(QWidget):
    """A line for each program."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.lines: dict[str, QLineEdit] = {}
        self._form = QFormLayout(self)
        self._form.setContentsMargins(0, 0, 0, 0)
        self._form.setVerticalSpacing(2)

    def show_lines(self, lines: Mapping[str, str]) -> None:
        """Show these lines, by their programs, in place of the previous ones."""
        while self._form.rowCount():
            self._form.removeRow(0)
        self.lines = {}
        for program, line in lines.items():
            field = QLineEdit(line)
            field.setReadOnly(True)
            field.setCursorPosition(0)
            field.setAccessibleName(self.tr("Line for {program}").format(program=program))
            field.setToolTip(line)
            copy = QToolButton()
            copy.setText(self.tr("Copy"))
            copy.setToolTip(self.tr("Copy the line for {program}.").format(program=program))
            copy.clicked.connect(
                lambda _checked=False, text=line: QGuiApplication.clipboard().setText(text)
            )
            both = QHBoxLayout()
            both.addWidget(field)
            both.addWidget(copy)
            self._form.addRow(program, both)
            self.lines[program] = field
        self.setVisible(bool(lines))
