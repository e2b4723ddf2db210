"""Lines of a measured readout time for other programs, each with a button that copies it."""

from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from occ_gui.widgets.copying import copy_text
from occ_model.photo.many.other_programs import note_on


class PasteLines(QWidget):
    """A line for each program."""

    copied = Signal(str)
    """A text was copied: a sentence that says so."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.lines: dict[str, QLabel] = {}
        self.why_none, self.note = (
            QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText) for _ in range(2)
        )
        self.why_none.setAccessibleName("Why there is no line for other programs")
        # A grid: a form would not give lines that wrap their height.
        self._grid = QGridLayout()
        self._grid.setVerticalSpacing(2)
        self._grid.setColumnStretch(1, 1)
        self._parts: list[QWidget] = []
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.why_none)
        layout.addLayout(self._grid)
        self.note.setAccessibleName("What the lines for other programs assume")
        layout.addWidget(self.note)
        self.show_lines({})

    def show_lines(self, lines: Mapping[str, str], why_none: str = "") -> None:
        """Show these lines, by their programs, in place of the previous ones.

        Parameters
        ----------
        why_none
            In place of lines: a sentence that says why there are none. A line that is pasted
            elsewhere leaves behind what it rests on.
        """
        for part in self._parts:
            part.setParent(None)
            part.deleteLater()
        self._parts, self.lines = [], {}
        self.why_none.setText(why_none)
        self.why_none.setVisible(bool(why_none))
        for program, line in lines.items():
            # Wrapped: the number stands at the end.
            field = QLabel(line, wordWrap=True, textFormat=Qt.TextFormat.PlainText)
            field.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            field.setAccessibleName(f"Line for {program}")
            copy = QToolButton()
            copy.setText("Copy")
            copy.setToolTip(f"Copy the line for {program}.")
            copy.clicked.connect(
                lambda _checked=False, text=line: self.copied.emit(copy_text(text))
            )
            row, parts = len(self.lines), (QLabel(program), field, copy)
            for place, part in enumerate(parts):
                self._grid.addWidget(part, row, place)
            self._parts += parts
            self.lines[program] = field
        self.note.setText(note_on(lines))
        self.note.setVisible(bool(self.note.text()))
        self.setVisible(bool(lines or why_none))

    def show_lines_if(self, condition: str, lines: Mapping[str, str]) -> None:
        """Show these lines where they rest on no assumption, else what has to be confirmed."""
        if not condition or not lines:
            self.show_lines(lines)
            return
        text = (
            "Lines for {programs} hold only {condition}. They are given once this is confirmed: "
            "enter the value, or tick “certain”."
        )
        programs = " and ".join(lines)
        self.show_lines({}, text.format(programs=programs, condition=condition.removesuffix(": ")))
