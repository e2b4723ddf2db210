"""Result of a match: the cure of its bars, buttons that use it, and the figures under More."""

import math
from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
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
from occ_gui.widgets.state_look import State
from occ_model.photo.many.other_programs import lines_of_match
from occ_model.results.bands import OF_MEAN_LIGHT, Cure
from occ_model.results.match import Match
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND

SIGNS = {SURE: "●", DOUBTFUL: "◐", REFUSED: "○", UNREADABLE: "✕"}
"""Sign of each verdict, so that it does not depend on colour alone."""

STATES = {SURE: State.GOOD, DOUBTFUL: State.DOUBTFUL}
"""The state that gives each verdict its colours, here and in the bar at the top."""


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
        self.figures, self.paste = MatchValues(), PasteLines()
        self.mark = OutdatedMark(self.figures)
        self.reasons = paragraph(name="Reasons of the verdict", is_selectable=True)
        self.reasons.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
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
            self.reasons, self.condition, self.figures, self.paste,
            margins=0, spacing=4,
        )  # fmt: skip
        fill(
            QVBoxLayout(self),
            # Most photographers look for the cure, so it is visible without scrolling.
            self.warning, self.cure,
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
        self.reasons.setText("\n".join(f"• {reason}" for reason in match.all_reasons))
        self.reasons.setVisible(bool(match.all_reasons))
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
        return f"bars of {' to '.join(depths)} % {OF_MEAN_LIGHT} at {exposure}, "

    def show_certain(self, certain: Mapping[str, float]) -> None:
        self._certain = certain
        self._warn_if_stale()
        if self._match is not None:
            self._show_figures(self._match)

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
        self.reasons.setEnabled(not why)
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
