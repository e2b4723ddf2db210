"""Figures of a match: estimates with their uncertainties, quality of the fit, alternatives."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from occ_gui.photo.assumption import condition
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.photo.match_facts import ESTIMATES, LABELS, known_of, match_facts
from occ_model.results.match import Match


def condition_of(match: Match, certain: Mapping[str, float]) -> str:
    """Name the value that a match's estimates of time rest on, unless the user is certain of it."""
    name = known_of(match)
    return condition(name, float(getattr(match, name)), certain, len(match.pattern))


def what_errors_mean() -> str:
    """Say what ± and the verdict mean."""
    return (
        "± is one standard deviation, of the fit alone: the error of the value that is known comes "
        "on top.\nA limit, as in “below 36 µs”, lies two standard deviations above the value.\n"
        "“Sure” means that no check found a reason to doubt the match; the reasons of a "
        "doubtful one are listed."
    )


class MatchValues(QWidget):
    """The figures as a table: a row that says nothing is hidden."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        # A grid: a form would not give lines that wrap their height.
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(2)
        grid.setColumnStretch(1, 1)
        self.labels: dict[str, QLabel] = {}
        self._titled: dict[str, QLabel] = {}
        for row, (name, title) in enumerate(LABELS.items()):
            # A pattern can be of any length.
            label = ElidedLabel() if name == "pattern" else QLabel()
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setWordWrap(name != "pattern")
            label.setAccessibleName(title)
            if name in (*ESTIMATES, "frame"):
                label.setToolTip(what_errors_mean())
            self.labels[name] = label
            self._titled[name] = QLabel(title)
            grid.addWidget(self._titled[name], row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(label, row, 1)
        fixed = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        self.labels["pattern"].setFont(fixed)
        self.labels["region"].setToolTip(
            "Between the first edge of a stripe and the last: the applied scene is dark outside."
        )

    def show_match(self, match: Match, certain: Mapping[str, float], noted: float | None) -> None:
        """Show a match.

        Parameters
        ----------
        certain
            The known values, in SI units by name, that are confirmed and not only assumed.
        noted
            The exposure time in seconds that the camera noted in the photo, None if it did not.
        """
        condition = condition_of(match, certain)
        facts = match_facts(match, condition, noted)
        # What they rest on is said once, above them.
        shown = [(fact.key, str(fact).replace(condition, "")) for fact in facts]
        others = [f"• {text}" for key, text in shown if key == "alternative"]
        texts = dict(shown) | {"alternative": "\n".join(others)}
        if "gamma" not in match.uncertainties:  # the scene's says nothing of the photo
            texts["gamma"] = ""
        for name, label in self.labels.items():
            text = texts.get(name, "")
            if isinstance(label, ElidedLabel):
                label.set_full_text(text)
            else:
                label.setText(text)
            for part in (label, self._titled[name]):
                part.setVisible(bool(text))
