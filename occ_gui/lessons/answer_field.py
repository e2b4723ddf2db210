"""Answer field: what the check says, what a student types, and a button to check it."""

from PySide6.QtCore import Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from occ_gui.lessons.texts import paragraph
from occ_gui.widgets.event_filters import leave_undo_to_window
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.named import push_button
from occ_model.results.lessons import CheckedAnswer

_LONGEST = 300  # characters of an answer

_SIGNS = {"right": "✓", "near": "≈", "wrong": "✗", "unreadable": "?", None: "→"}
"""The outcome as a sign, so that colour alone does not show it."""


class AnswerField(QWidget):
    """A field for a number or for words, with a button and a sentence."""

    checked = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.field = QLineEdit(maxLength=_LONGEST)
        self.field.setAccessibleName("Your answer")
        self.field.setToolTip("Type your answer here before you look at the explanation.")
        leave_undo_to_window(self.field)
        self.unit = QLabel()
        self.check = push_button("Check", "Compare it with the model (Enter).", self._ask)
        self.field.returnPressed.connect(self._ask)
        self.field.textEdited.connect(self._forget)
        self.sentence = paragraph()
        self.sentence.setAccessibleName("What the check says")
        self._said, self._is_outdated = "", False
        row = filled(QHBoxLayout(), (self.field, 1), self.unit, self.check, spacing=8)
        layout = filled(QVBoxLayout(self), margins=0, spacing=4)
        # Above the field, which stands at the lower end of the pane: it stays where it is.
        layout.addWidget(self.sentence)
        layout.addLayout(row)

    def begin(self, unit: str, is_number: bool, before: CheckedAnswer | None) -> None:
        self.unit.setText(unit)
        self.unit.setVisible(bool(unit))
        self.field.setPlaceholderText("a number" if is_number else "in your own words")
        self.check.setText("Check" if is_number else "Keep")
        self.field.setText("" if before is None else before.text)
        if before is None:
            self._forget()
        else:
            self.show_checked(before)

    def show_checked(self, answer: CheckedAnswer) -> None:
        self.check.setEnabled(True)
        self._said = f"{_SIGNS[answer.outcome]}  {answer.sentence}"
        self._write()

    def show_outdated(self, outdated: bool) -> None:
        """Show whether what the check says is of another scene than the one that is shown."""
        if outdated != self._is_outdated:
            self._is_outdated = outdated
            self._write()

    def _write(self) -> None:
        if not self._said:
            return
        after = "The scene has changed since: check again."
        self.sentence.setText(f"{self._said} {after}" if self._is_outdated else self._said)
        self.sentence.show()

    def show_waiting(self) -> None:
        self.check.setEnabled(False)
        self._said = ""
        self.sentence.setForegroundRole(QPalette.ColorRole.WindowText)
        self.sentence.setText("The model computes…")
        self.sentence.show()

    def _ask(self) -> None:
        if self.field.text().strip():
            self.checked.emit(self.field.text())

    def _forget(self) -> None:
        self.check.setEnabled(True)
        self._said = ""
        self.sentence.clear()
        self.sentence.hide()
