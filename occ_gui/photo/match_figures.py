"""Values of a match, the value that they assume, and lines to paste into other programs."""

import math
from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from occ_gui.widgets.building import ElidedLabel, fill, name_widget, paragraph
from occ_gui.widgets.plain_text import copy_text
from occ_model.photo.many.other_programs import note_on
from occ_model.photo.match_facts import ESTIMATES, LABELS, match_facts
from occ_model.results.match import Match, known_value
from occ_model.results.photo_table import assumption
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

WHAT_ERRORS_MEAN = (
    "± is one standard deviation of the fit alone; it does not include the error of the value "
    "that is known.\nA limit, as in “below 36 µs”, lies two standard deviations above the value.\n"
    "“Sure” means that no check found a reason to doubt the match; the reasons to doubt a "
    "doubtful match are listed."
)


def is_certain(name: str, value: float, certain: Mapping[str, float]) -> bool:
    """Whether the user has confirmed this known value, in SI units."""
    return math.isclose(value, certain.get(name, math.nan), rel_tol=1e-9)


def describe_stale_value(
    scene: Scene, estimate: str, used: tuple[str, float], in_scene: tuple[str, float]
) -> str:
    """Say which known value the match used, if the scene has another one now; else empty.

    ``used``: the name and value that the match used; ``in_scene``: those that the scene had then.
    They differ if the user stated a lamp, which has its own frequency.
    """
    now = known_value(estimate, scene)
    if any(now[0] == name and math.isclose(now[1], value) for name, value in (used, in_scene)):
        return ""
    texts = [quantity(name).format(value) for name, value in (used, now)]
    if used[0] != now[0]:
        names = (quantity(name).in_sentence for name, _ in (used, now))
        texts = [f"the {name} {text}" for name, text in zip(names, texts, strict=True)]
    return f"Found with {texts[0]}; the scene has {texts[1]} now: "


def is_match_certain(match: Match, certain: Mapping[str, float]) -> bool:
    """Whether the user has confirmed the known value of a match, by any of its names."""
    values = {match.known: float(getattr(match, match.known))}
    if match.lamp is not None and match.known != "readout_time":
        # Knowing the rate of the chips or flashes means knowing the lamp's frequency.
        values["pulse_frequency"] = match.lamp.frequency
        values["switching_frequency"] = match.switching_frequency
    return any(is_certain(name, value, certain) for name, value in values.items())


def condition_of(match: Match, certain: Mapping[str, float]) -> str:
    """Name the known value that a match's times assume, unless the user is certain of it."""
    if is_match_certain(match, certain):
        return ""
    return assumption(match.known, float(getattr(match, match.known)))


def _make_grid(parent: QWidget | None = None) -> QGridLayout:
    # A QFormLayout would not reserve the height of wrapped lines.
    grid = QGridLayout(parent)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setVerticalSpacing(2)
    grid.setColumnStretch(1, 1)
    return grid


class MatchValues(QWidget):
    """The values of a match as a table; rows without a value are hidden."""

    def __init__(self) -> None:
        super().__init__()
        grid = _make_grid(self)
        self.labels: dict[str, QLabel] = {}
        self._titles: dict[str, QLabel] = {}
        for row, (name, title) in enumerate(LABELS.items()):
            # A pattern can be arbitrarily long.
            label = ElidedLabel() if name == "pattern" else paragraph()
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            name_widget(label, title, WHAT_ERRORS_MEAN if name in (*ESTIMATES, "frame") else "")
            self.labels[name], self._titles[name] = label, QLabel(title)
            grid.addWidget(self._titles[name], row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(label, row, 1)
        fixed = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        self.labels["pattern"].setFont(fixed)
        self.labels["region"].setToolTip(
            "From the first edge of a stripe to the last; outside, the applied scene is dark."
        )

    def show_match(
        self, match: Match, certain: Mapping[str, float], recorded_exposure: float | None
    ) -> None:
        """Show a match, with the exposure time in seconds if the camera recorded one."""
        condition = condition_of(match, certain)
        facts = match_facts(match, condition, recorded_exposure)
        # The condition is shown once, above the values.
        texts_by_key = [(fact.key, str(fact).replace(condition, "")) for fact in facts]
        alternatives = [f"• {text}" for key, text in texts_by_key if key == "alternative"]
        texts = dict(texts_by_key) | {"alternative": "\n".join(alternatives)}
        if "gamma" not in match.uncertainties:  # the scene's gamma was not estimated from the photo
            texts["gamma"] = ""
        for name, label in self.labels.items():
            text = texts.get(name, "")
            if isinstance(label, ElidedLabel):
                label.set_full_text(text)
            else:
                label.setText(text)
            for part in (label, self._titles[name]):
                part.setVisible(bool(text))


class PasteLines(QWidget):
    """A line for each program with a button that copies it, or the reason why there is none."""

    copied = Signal(str)  # a text was copied: a sentence that says so

    def __init__(self) -> None:
        super().__init__()
        self.lines: dict[str, QLabel] = {}
        self.reason = paragraph(name="Why there is no line for other programs")
        self.note = paragraph(name="What the lines for other programs assume")
        self._grid = _make_grid()
        self._parts: list[QWidget] = []
        fill(QVBoxLayout(self), self.reason, self._grid, self.note, margins=0)
        self.show_lines({})

    def show_lines(self, lines: Mapping[str, str], condition: str = "") -> None:
        """Show a line for each program; if the values depend on a condition, explain that instead.

        A line that is pasted into another program would lose its condition.
        """
        reason = ""
        if condition and lines:
            reason = (
                f"Lines for {' and '.join(lines)} hold only {condition.removesuffix(': ')}. They "
                "appear once you confirm this: enter the value, or tick “certain”."
            )
            lines = {}
        self.reason.setText(reason)
        self.reason.setVisible(bool(reason))
        for part in self._parts:
            part.setParent(None)
            part.deleteLater()
        self._parts, self.lines = [], {}
        for row, (program, line) in enumerate(lines.items()):
            # Wrapped rather than shortened, because the number is at the end.
            field = self.lines[program] = paragraph(
                line, name=f"Line for {program}", is_selectable=True
            )
            copy = QToolButton()
            copy.setText("Copy")
            copy.setToolTip(f"Copy the line for {program}.")
            copy.clicked.connect(lambda _=False, text=line: self.copied.emit(copy_text(text)))
            for column, part in enumerate((QLabel(program), field, copy)):
                self._grid.addWidget(part, row, column)
                self._parts.append(part)
        self.note.setText(note_on(lines))
        self.note.setVisible(bool(self.note.text()))
        self.setVisible(bool(lines or reason))
