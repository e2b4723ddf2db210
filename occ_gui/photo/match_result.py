"""Result of a match: the cure of its bars, buttons that use it, and the figures under More."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.photo.match_figures import (
    MatchValues,
    PasteLines,
    condition_of,
    describe_stale_value,
    is_match_certain,
)
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.widgets.answer import MoreButton
from occ_gui.widgets.building import fill, paragraph, push_button
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_model.photo.many.other_programs import lines_of_match
from occ_model.photo.reading.load import Photo
from occ_model.results.bands import OF_MEAN_LIGHT, Cure
from occ_model.results.match import Match
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND

SIGNS = {SURE: "●", DOUBTFUL: "◐", REFUSED: "○", UNREADABLE: "✕"}
"""Sign of each verdict, so that it does not depend on colour alone."""


class MatchResult(QWidget):
    apply_asked = Signal()
    save_asked = Signal()  # the user saves the matched scene as a preset
    cure_asked = Signal()  # the user wants to see the picture at a shutter speed without bars

    def __init__(self) -> None:
        super().__init__()
        self._shown = ShownPhoto(Scene())
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

    def show_photo(self, shown: ShownPhoto) -> None:
        """Show the match of a photo, or hide this part if there is none."""
        last, self._shown = self._shown, shown
        self.setVisible(shown.match is not None)
        if shown.match is None or shown.photo is None:
            return
        is_new = shown.match is not last.match or shown.photo is not last.photo
        if is_new:
            self.reasons.setText("\n".join(f"• {reason}" for reason in shown.match.all_reasons))
            self.reasons.setVisible(bool(shown.match.all_reasons))
        if is_new or shown.choice.certain != last.choice.certain:
            self._show_figures(shown.match, shown.photo)
        self._show_outdated(*shown.validity)
        self._warn_if_stale(shown.match)

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

    def _show_figures(self, match: Match, photo: Photo) -> None:
        certain = self._shown.choice.certain
        for part in (self.cure, self.without_bars):
            part.setVisible(self._shown.cure is not None)
        if self._shown.cure is not None:
            self._show_cure(self._shown.cure, match)
        condition = condition_of(match, certain)
        self.condition.setText(f"These values hold only {condition.removesuffix(': ')}.")
        self.condition.setVisible(bool(condition))
        self.figures.show_match(match, certain, photo.exposure_time)
        self.paste.show_lines(lines_of_match(match, turned=photo.turned), condition)

    def _show_outdated(self, why: str, is_usable: bool) -> None:
        self.reasons.setEnabled(not why)
        self.mark.show_age(DELAY if why else 0.0, why)  # at once
        self.paste.setEnabled(is_usable and not why)
        for button in (self.apply, self.save, self.without_bars):
            button.setEnabled(is_usable)

    def _warn_if_stale(self, match: Match) -> None:
        shown, warning = self._shown, ""
        if shown.outcome is not None and not is_match_certain(match, shown.choice.certain):
            used = match.known, float(getattr(match, match.known))
            warning = describe_stale_value(shown.scene, match.estimate, used, shown.outcome.given)
        self.warning.setText(f"{warning}match again.")
        self.warning.setVisible(bool(warning))
