"""Result of a match: the verdict first, then the figures, and buttons that use them."""

import math
from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.photo.assumption import is_stale
from occ_gui.photo.match_values import MatchValues, condition_of
from occ_gui.photo.paste_lines import PasteLines
from occ_gui.photo.verdict_view import VerdictView
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_model.photo.many.other_programs import lines_of_match
from occ_model.photo.match_facts import known_of
from occ_model.results.bands import Cure
from occ_model.results.match import Match
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND


class MatchResult(QWidget):
    """How sure a match is, its figures, and buttons to use them."""

    apply_asked = Signal()
    """The user applies the matched scene."""

    save_asked = Signal()
    """The user saves the matched scene as a preset."""

    cure_asked = Signal()
    """The user wants to see the picture at a shutter speed that shows no bars."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._match: Match | None = None
        self._cure: Cure | None = None
        self._noted: float | None = None
        self._scene: Scene | None = None
        self._given = math.nan
        self._certain: Mapping[str, float] = {}
        self.verdict, self.figures = VerdictView(), MatchValues()
        self.paste = PasteLines()
        self._turned = False
        self.mark = OutdatedMark(self.figures)
        self.condition, self.stale, self.cure = (
            QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText) for _ in range(3)
        )
        self.condition.setAccessibleName("What the figures rest on")
        self.stale.setAccessibleName("Whether the match still belongs to the known value")
        self.stale.hide()
        self._make_buttons()
        buttons = QHBoxLayout()
        buttons.addWidget(self.apply)
        buttons.addWidget(self.save)
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        # The cure is what most photographers came for: it needs no scrolling.
        for label in (self.verdict, self.stale, self.condition, self.cure):
            layout.addWidget(label)
        layout.addWidget(self.without_bars, alignment=Qt.AlignmentFlag.AlignLeft)
        for part in (self.figures, self.paste):
            layout.addWidget(part)
        layout.addLayout(buttons)
        layout.addStretch()

    def _make_buttons(self) -> None:
        self.apply = QPushButton("&Apply to the scene")
        self.apply.setToolTip(
            "Put the result into the scene, as one step that can be undone: its picture then "
            "lies on the photo."
        )
        self.apply.clicked.connect(self.apply_asked)
        self.save = QPushButton("&Save as preset…")
        self.save.setToolTip(
            "Save the result as a preset of your own, with the photo and the uncertainties as "
            "its sources."
        )
        self.save.clicked.connect(self.save_asked)
        self.without_bars = QPushButton("&Without bars")
        self.without_bars.setToolTip(
            "Simulate the picture at a shutter speed that shows no bars, beside the photo: one "
            "step that can be undone."
        )
        self.without_bars.clicked.connect(self.cure_asked)

    @property
    def values(self) -> dict[str, QLabel]:
        """The labels of the figures, by name."""
        return self.figures.labels

    def show_match(
        self, match: Match, noted: float | None, given: float = math.nan, *, turned: bool = False
    ) -> None:
        """Show a match.

        Parameters
        ----------
        noted
            The exposure time in seconds that the camera noted, if it did.
        given
            The known value of the scene when the match was asked for, in SI units.
        """
        self._match, self._noted, self._turned = match, noted, turned
        self._cure, self._given = None, given
        self._show_stale()
        self.verdict.show_verdict(match.verdict, match.all_reasons)
        self._show_figures(match)
        self.show_outdated("", usable=True)

    def show_cure(self, cure: Cure) -> None:
        """Show what takes the bars out of the match's picture."""
        self._cure = cure
        if self._match is not None:
            self._show_figures(self._match)

    def _show_cure(self, found: Cure, match: Match) -> None:
        text = (
            f"This lamp repeats at {HERTZ.format(found.repeats, 4)} and is lit for "
            f"{100.0 * found.duty:.2g} % of the time: {self._depth(found, match)}no bars at "
            f"whole multiples of {SECOND.format(1.0 / found.repeats, 4)}."
        )
        first, kept = (
            " or ".join(each.name for each in speeds) for speeds in (found.speeds, found.kept)
        )
        if first == kept != "":
            text += f" Set {first}."
        elif first:
            text += f" Set {first} if the camera keeps what is written"
            text += f", else {kept}." if kept else "."
        self.cure.setText(text)

    def _depth(self, found: Cure, match: Match) -> str:
        if match.exposure_verdict != "sure":
            return ""  # the bars are as deep as the exposure lets them
        ends = dict.fromkeys(f"{100.0 * depth:.3g}" for depth in found.depth)
        exposure = SECOND.format(match.exposure_time, 3)
        return f"bars of {' to '.join(ends)} % of its light at {exposure}, "

    def show_certain(self, certain: Mapping[str, float]) -> None:
        """Show which known values, in SI units by name, are confirmed and not only assumed."""
        self._certain = certain
        self._show_stale()
        if self._match is not None:
            self._show_figures(self._match)

    def _show_figures(self, match: Match) -> None:
        for part in (self.cure, self.without_bars):
            part.setVisible(self._cure is not None)
        if self._cure is not None:
            self._show_cure(self._cure, match)
        condition = condition_of(match, self._certain)
        self.condition.setText(f"What follows holds {condition.removesuffix(': ')}.")
        self.condition.setVisible(bool(condition))
        self.figures.show_match(match, self._certain, self._noted)
        self.paste.show_lines_if(condition, lines_of_match(match, turned=self._turned))

    def show_outdated(self, why: str, usable: bool) -> None:
        """Show why the match is not the present one, empty if it is, and whether it can be used."""
        if self._match is None:
            return
        self.verdict.show_outdated(bool(why))
        self.mark.show_age(DELAY if why else 0.0, why)  # at once
        self.paste.setEnabled(usable and not why)
        for button in (self.apply, self.save, self.without_bars):
            button.setEnabled(usable)

    def show_scene(self, scene: Scene) -> None:
        """Show whether the match was made with the known value of this scene."""
        self._scene = scene
        self._show_stale()

    def _show_stale(self) -> None:
        match, scene = self._match, self._scene
        if match is None or scene is None:
            return
        name = known_of(match)
        declared = quantity(name)
        now, then = float(scene.value(name)), float(getattr(match, name))
        self.stale.setText(
            f"Found with {declared.format(then)}; the scene has {declared.format(now)} "
            "now: match again."
        )
        self.stale.setVisible(is_stale(name, then, self._given, now, self._certain))
