"""Verdict of a match: a word with a sign on a coloured plate, and its reasons in sentences."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.widgets.state_look import State, colours_of
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE

SIGNS = {SURE: "●", DOUBTFUL: "◐", REFUSED: "○", UNREADABLE: "✕"}
"""A sign for each verdict, so that none rests on a colour alone."""

STATES = {SURE: State.GOOD, DOUBTFUL: State.DOUBTFUL}
"""Whose colours the plate has, as the bar at the top has."""

_MARGIN = 4


class VerdictView(QWidget):
    """Whether a match is sure or doubtful, and why."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.word = QLabel()
        font = self.word.font()
        font.setBold(True)
        self.word.setFont(font)
        self.word.setContentsMargins(_MARGIN, 0, _MARGIN, 0)
        self.word.setAccessibleName("Verdict on the match")
        self.reasons = QLabel()
        self.reasons.setAccessibleName("Reasons of the verdict")
        for label in (self.word, self.reasons):
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.reasons.setWordWrap(True)
        fixed, least = QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Minimum
        self.word.setSizePolicy(fixed, fixed)
        self.reasons.setSizePolicy(QSizePolicy.Policy.Preferred, least)
        self._verdict, self._is_outdated = "", False
        row = QHBoxLayout()
        row.addWidget(self.word)
        row.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(_MARGIN)
        layout.addLayout(row)
        layout.addWidget(self.reasons)

    def show_verdict(self, verdict: str, reasons: Sequence[str]) -> None:
        """Show a verdict, SURE or DOUBTFUL, and its reasons, each a sentence."""
        self._verdict = verdict
        self.reasons.setText("\n".join(f"• {reason}" for reason in reasons))
        self.reasons.setVisible(bool(reasons))
        self.show_outdated(False)

    def show_outdated(self, outdated: bool) -> None:
        """Show whether the verdict is on something else than is asked about now."""
        self._is_outdated = outdated
        sign = "Before:" if outdated else SIGNS[self._verdict]
        self.word.setText(f"{sign} {self._verdict}")
        self.word.setAutoFillBackground(not outdated)
        palette = QPalette()
        if not outdated:
            colours = colours_of(STATES[self._verdict], self.palette())
            palette.setColor(QPalette.ColorRole.Window, colours.paper)
            palette.setColor(QPalette.ColorRole.WindowText, colours.ink)
        self.word.setPalette(palette)
        self.reasons.setEnabled(not outdated)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._verdict:
            self.show_outdated(self._is_outdated)
