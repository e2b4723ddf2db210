"""Result of a match: the verdict first, then the figures, and buttons that use them."""

import math
from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.photo.match_figures import (
    MatchValues,
    PasteLines,
    condition_of,
    is_match_certain,
    warn_of_stale,
)
from occ_gui.widgets.building import fill, name_widget, paragraph, push_button
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_gui.widgets.state_look import State, colours_of
from occ_model.photo.many.other_programs import lines_of_match
from occ_model.results.bands import Cure
from occ_model.results.match import Match
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND

SIGNS = {SURE: "●", DOUBTFUL: "◐", REFUSED: "○", UNREADABLE: "✕"}
"""Sign of each verdict, so that none depends on colour alone."""

STATES = {SURE: State.GOOD, DOUBTFUL: State.DOUBTFUL}
"""The state that gives each verdict its colours, here and in the bar at the top."""

_MARGIN = 4


class MatchVerdictView(QWidget):
    """The verdict on a match as a word on a coloured background, with its reasons."""

    def __init__(self) -> None:
        super().__init__()
        self.word = name_widget(QLabel(textFormat=Qt.TextFormat.PlainText), "Verdict on the match")
        self.word.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        font = self.word.font()
        font.setBold(True)
        self.word.setFont(font)
        self.word.setContentsMargins(_MARGIN, 0, _MARGIN, 0)
        self.reasons = paragraph(name="Reasons of the verdict", is_selectable=True)
        fixed, least = QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Minimum
        self.word.setSizePolicy(fixed, fixed)
        self.reasons.setSizePolicy(QSizePolicy.Policy.Preferred, least)
        self._verdict, self._is_outdated = "", False
        row = fill(QHBoxLayout(), self.word, None)
        fill(QVBoxLayout(self), row, self.reasons, margins=0, spacing=_MARGIN)

    def show_verdict(self, verdict: str, reasons: Sequence[str]) -> None:
        """Show a verdict, SURE or DOUBTFUL, with a sentence for each reason."""
        self._verdict = verdict
        self.reasons.setText("\n".join(f"• {reason}" for reason in reasons))
        self.reasons.setVisible(bool(reasons))
        self.show_outdated(False)

    def show_outdated(self, outdated: bool) -> None:
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
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._verdict:
            self.show_outdated(self._is_outdated)


class MatchResult(QWidget):
    apply_asked = Signal()
    save_asked = Signal()  # the user saves the matched scene as a preset
    cure_asked = Signal()  # the user wants to see the picture at a shutter speed without bars

    def __init__(self) -> None:
        super().__init__()
        self._match: Match | None = None
        self._cure: Cure | None = None
        self._noted: float | None = None
        self._scene: Scene | None = None
        self._given = ("", math.nan)
        self._certain: Mapping[str, float] = {}
        self._turned = False
        self.verdict, self.figures, self.paste = MatchVerdictView(), MatchValues(), PasteLines()
        self.mark = OutdatedMark(self.figures)
        self.condition = paragraph(name="What the values depend on")
        self.stale = paragraph(name="Whether the match still belongs to the known value")
        self.stale.hide()
        self.cure = paragraph()
        self._make_buttons()
        fill(
            QVBoxLayout(self),
            # Most photographers want the cure, so it is visible without scrolling.
            self.verdict, self.stale, self.condition, self.cure,
            (self.without_bars, 0, Qt.AlignmentFlag.AlignLeft), self.figures, self.paste,
            fill(QHBoxLayout(), self.apply, self.save, None), None,
            margins=0, spacing=4,
        )  # fmt: skip

    def _make_buttons(self) -> None:
        self.apply = push_button(
            "&Apply to the scene",
            "Put the result into the scene, as one step that can be undone. The simulated picture "
            "then lies on the photo.",
            self.apply_asked,
        )
        self.save = push_button(
            "&Save as preset…",
            "Save the result as a preset of your own, which names the photo and the uncertainties "
            "as the sources of its values.",
            self.save_asked,
        )
        self.without_bars = push_button(
            "&Without bars",
            "Simulate the picture at a shutter speed that shows no bars, beside the photo, as one "
            "step that can be undone.",
            self.cure_asked,
        )

    def show_match(
        self,
        match: Match,
        noted: float | None,
        given: tuple[str, float] = ("", math.nan),
        cure: Cure | None = None,
        *,
        turned: bool = False,
    ) -> None:
        """Show a match.

        ``noted``: the exposure time in seconds recorded by the camera, if any. ``given``: the known
        value of the scene at the match's start, with its name. ``cure``: the remedy for its bars.
        """
        self._match, self._noted, self._turned = match, noted, turned
        self._cure, self._given = cure, given
        self._show_stale()
        self.verdict.show_verdict(match.verdict, match.all_reasons)
        self._show_figures(match)
        self.show_outdated("", usable=True)

    def _show_cure(self, found: Cure, match: Match) -> None:
        text = (
            f"This lamp repeats at {HERTZ.format(found.repeats, 4)} and is lit for "
            f"{PERCENT.format(found.duty, 2)} of the time: {self._depth(found, match)}no bars at "
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
            return ""  # the depth of the bars depends on the exposure time
        ends = dict.fromkeys(f"{100.0 * depth:.3g}" for depth in found.depth)
        exposure = SECOND.format(match.exposure_time, 3)
        return f"bars of {' to '.join(ends)} % of its light at {exposure}, "

    def show_certain(self, certain: Mapping[str, float]) -> None:
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
        self.paste.show_lines(lines_of_match(match, turned=self._turned), condition)

    def show_outdated(self, why: str, usable: bool) -> None:
        """Show why the match is outdated, empty if it is not, and whether it can be used."""
        if self._match is None:
            return
        self.verdict.show_outdated(bool(why))
        self.mark.show_age(DELAY if why else 0.0, why)  # at once
        self.paste.setEnabled(usable and not why)
        for button in (self.apply, self.save, self.without_bars):
            button.setEnabled(usable)

    def show_scene(self, scene: Scene) -> None:
        self._scene = scene
        self._show_stale()

    def _show_stale(self) -> None:
        match, scene = self._match, self._scene
        if match is None or scene is None:
            return
        then = match.known, float(getattr(match, match.known))
        stale = ""
        if not is_match_certain(match, self._certain):
            stale = warn_of_stale(scene, match.estimate, then, self._given)
        self.stale.setText(f"{stale}match again.")
        self.stale.setVisible(bool(stale))
