"""Verdict of a match: a word with a sign on a coloured plate, and its reasons in sentences."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.widgets.plot import BAND, PHOTO, REGION
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE

SIGNS = {SURE: "●", DOUBTFUL: "◐", REFUSED: "○", UNREADABLE: "✕"}
"""A sign for each verdict, so that none is told by a colour alone."""

_PLATES = {SURE: PHOTO, DOUBTFUL: REGION, REFUSED: BAND}
"""Green, amber and orange: black on each of them has a contrast above 4.5 in any theme."""

_MARGIN = 4


class VerdictView(QWidget):
    """Whether a match is sure, doubtful or refused, and why."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.word = QLabel()
        font = self.word.font()
        font.setBold(True)
        self.word.setFont(font)
        self.word.setContentsMargins(_MARGIN, 0, _MARGIN, 0)
        self.word.setAccessibleName(self.tr("Verdict on the match"))
        self.reasons = QLabel()
        self.reasons.setAccessibleName(self.tr("Reasons of the verdict"))
        for label in (self.word, self.reasons):
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.reasons.setWordWrap(True)
        fixed, least = QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Minimum
        self.word.setSizePolicy(fixed, fixed)
        self.reasons.setSizePolicy(QSizePolicy.Policy.Preferred, least)
        self._verdict = ""
        row = QHBoxLayout()
        row.addWidget(self.word)
        row.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(_MARGIN)
        layout.addLayout(row)
        layout.addWidget(self.reasons)

    def show_verdict(self, verdict: str, reasons: Sequence[str]) -> None:
        """Show a verdict, SURE, DOUBTFUL or REFUSED, and its reasons, each a sentence."""
        self._verdict = verdict
        self.reasons.setText("\n".join(f"• {reason}" for reason in reasons))
        self.reasons.setVisible(bool(reasons))
        self.show_outdated(False)

    def show_outdated(self, outdated: bool) -> None:
        """Show whether the verdict is on something else than is asked about now."""
        name = self._names()[self._verdict]
        self.word.setText(
            self.tr("Before: {verdict}").format(verdict=name)
            if outdated
            else f"{SIGNS[self._verdict]} {name}"
        )
        self.word.setAutoFillBackground(not outdated)
        palette = QPalette()
        if not outdated:
            palette.setColor(QPalette.ColorRole.Window, _PLATES[self._verdict])
            palette.setColor(QPalette.ColorRole.WindowText, QColor(Qt.GlobalColor.black))
        self.word.setPalette(palette)
        self.reasons.setEnabled(not outdated)

    def _names(self) -> dict[str, str]:
        return {
            SURE: self.tr("sure"),
            DOUBTFUL: self.tr("doubtful"),
            REFUSED: self.tr("refused"),
        }
