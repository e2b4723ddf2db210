"""Result of a match: the verdict first, then the figures, and buttons that use them."""

import math
from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.photo.match_figures import (
    MatchValues,
    PasteLines,
    condition_of,
    describe_stale_value,
    is_match_certain,
)
from occ_gui.widgets.answer import MoreButton
from occ_gui.widgets.building import fill, paragraph, push_button
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_gui.widgets.state_look import State, colours_of
from occ_model.photo.many.other_programs import lines_of_match
from occ_model.results.bands import Cure
from occ_model.results.match import Match
from occ_model.results.match_sentence import state_verdict
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND

SIGNS = {SURE: "●", DOUBTFUL: "◐", REFUSED: "○", UNREADABLE: "✕"}
"""Sign of each verdict, so that it does not depend on colour alone."""

STATES = {SURE: State.GOOD, DOUBTFUL: State.DOUBTFUL}
"""The state that gives each verdict its colours, here and in the bar at the top."""

_MARGIN = 4


class MatchVerdictView(QWidget):
    """The verdict on a match as a word on a coloured background.

    Its reasons are a label of their own, to be put elsewhere.
    """

    def __init__(self) -> None:
        super().__init__()
        self.word = paragraph(name="Verdict on the match", is_selectable=True)
        font = self.word.font()
        font.setBold(True)
        self.word.setFont(font)
        self.word.setContentsMargins(_MARGIN, 0, _MARGIN, 0)
        self.reasons = paragraph(name="Reasons of the verdict", is_selectable=True)
        self.reasons.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self._verdict, self._words, self._is_outdated = "", "", False
        fill(QVBoxLayout(self), self.word, margins=0)

    def show_verdict(self, verdict: str, words: str, reasons: Sequence[str]) -> None:
        """Show a verdict, SURE or DOUBTFUL, in some words, with a sentence for each reason."""
        self._verdict, self._words = verdict, words
        self.reasons.setText("\n".join(f"• {reason}" for reason in reasons))
        self.reasons.setVisible(bool(reasons))
        self.show_outdated(False)

    def show_outdated(self, outdated: bool) -> None:
        self._is_outdated = outdated
        sign = "Earlier:" if outdated else SIGNS[self._verdict]
        self.word.setText(f"{sign} {self._words}")
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
        self._recorded_exposure: float | None = None
        self._scene: Scene | None = None
        self._known_at_match = ("", math.nan)
        self._certain: Mapping[str, float] = {}
        self._turned = False
        self.verdict, self.figures, self.paste = MatchVerdictView(), MatchValues(), PasteLines()
        self.mark = OutdatedMark(self.figures)
        self.condition = paragraph(name="What the values assume")
        self.warning = paragraph(name="Whether the match still belongs to the known value")
        self.warning.hide()
        self.cure = paragraph()
        self._make_buttons()
        self.more, self.details = MoreButton(), QWidget()
        self.details.hide()
        self.more.toggled.connect(self.details.setVisible)
        fill(
            QVBoxLayout(self.details),
            self.verdict.reasons, self.condition, self.figures, self.paste,
            margins=0, spacing=4,
        )  # fmt: skip
        fill(
            QVBoxLayout(self),
            # Most photographers look for the cure, so it is visible without scrolling.
            self.verdict, self.warning, self.cure,
            (self.without_bars, 0, Qt.AlignmentFlag.AlignLeft),
            fill(QHBoxLayout(), self.apply, self.save, None), self.more, self.details, None,
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
        recorded_exposure: float | None,
        known_at_match: tuple[str, float] = ("", math.nan),
        cure: Cure | None = None,
        *,
        turned: bool = False,
    ) -> None:
        """Show a match.

        ``recorded_exposure``: the exposure time in seconds recorded by the camera, if any.
        ``known_at_match``: name and value of the scene's known parameter when the match began.
        ``cure``: the remedy for its bars.
        """
        self._match, self._recorded_exposure, self._turned = match, recorded_exposure, turned
        self._cure, self._known_at_match = cure, known_at_match
        self._warn_if_stale()
        self._show_verdict(match)
        self._show_figures(match)
        self.show_outdated("", usable=True)

    def _show_cure(self, cure: Cure, match: Match) -> None:
        text = (
            f"This lamp repeats at {HERTZ.format(cure.repetition_rate, 4)} and is lit for "
            f"{PERCENT.format(cure.duty, 3)} of the time: {self._describe_depth(cure, match)}"
            f"no bars at whole multiples of {SECOND.format(1.0 / cure.repetition_rate, 4)}."
        )
        marked, real = (
            " or ".join(speed.name for speed in speeds)
            for speeds in (cure.speeds, cure.safe_speeds)
        )
        if marked == real != "":
            text += f" Set {marked}."
        elif marked:
            text += f" Set {marked} if the camera keeps the marked times exactly"
            text += f", else {real}." if real else "."
        self.cure.setText(text)

    def _describe_depth(self, cure: Cure, match: Match) -> str:
        if match.exposure_verdict != "sure":
            return ""  # the depth of the bars depends on the exposure time
        depths = dict.fromkeys(f"{100.0 * depth:.3g}" for depth in cure.depth)
        exposure = SECOND.format(match.exposure_time, 3)
        return f"bars of {' to '.join(depths)} % of its light at {exposure}, "

    def show_certain(self, certain: Mapping[str, float]) -> None:
        self._certain = certain
        self._warn_if_stale()
        if self._match is not None:
            self._show_verdict(self._match)
            self._show_figures(self._match)

    def _show_verdict(self, match: Match) -> None:
        words = state_verdict(match, condition_of(match, self._certain))
        self.verdict.show_verdict(match.verdict, words, match.all_reasons)

    def _show_figures(self, match: Match) -> None:
        for part in (self.cure, self.without_bars):
            part.setVisible(self._cure is not None)
        if self._cure is not None:
            self._show_cure(self._cure, match)
        condition = condition_of(match, self._certain)
        self.condition.setText(f"These values hold only {condition.removesuffix(': ')}.")
        self.condition.setVisible(bool(condition))
        self.figures.show_match(match, self._certain, self._recorded_exposure)
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
        self._warn_if_stale()

    def _warn_if_stale(self) -> None:
        match, scene = self._match, self._scene
        if match is None or scene is None:
            return
        used = match.known, float(getattr(match, match.known))
        warning = ""
        if not is_match_certain(match, self._certain):
            warning = describe_stale_value(scene, match.estimate, used, self._known_at_match)
        self.warning.setText(f"{warning}match again.")
        self.warning.setVisible(bool(warning))
