"""Pane of the photo: facts about it, its match with the scene, and its placement."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtWidgets import QFrame, QStackedWidget, QVBoxLayout, QWidget

from occ_gui.photo.lamp_views import LampForm
from occ_gui.photo.many.many_view import ManyPhotosView
from occ_gui.photo.match_form import MatchForm
from occ_gui.photo.match_result import MatchResult
from occ_gui.photo.photo_facts import PhotoFacts
from occ_gui.photo.photo_verdict import EARLIER, PhotoSteps, PhotoVerdictBar
from occ_gui.photo.placement_form import PlacementForm
from occ_gui.values.photo_choice import PhotoChoice
from occ_gui.values.photo_results import FoundMatch
from occ_gui.widgets.building import fill, paragraph, push_button
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.photo.reading.load import Photo
from occ_model.results.bands import Cure
from occ_model.results.match import Match
from occ_model.scene.scene import Scene

_SCROLL_BAR = 20
_LEAST_HEIGHT = 200

_MARGIN_ABOVE = 4  # pixels above a part that is scrolled to


class PhotoView(QWidget):
    """The forms of the open photo; without one, an invitation to open one."""

    open_asked = Signal()
    sample_chosen = Signal(Path)  # the user opens one of the sample photos
    refused = Signal(str)  # why a value that was entered in a form is refused
    accepted = Signal()  # an allowed value was entered in a form

    def __init__(self) -> None:
        super().__init__()
        unseen = QWidget(self)
        unseen.hide()
        self.many = ManyPhotosView(unseen)
        """The table of several photos; its own pane takes it over when it is made."""
        self.facts, self.form, self.lamps = PhotoFacts(), MatchForm(), LampForm()
        self.result, self.placement = MatchResult(), PlacementForm()
        self.verdict = PhotoVerdictBar()
        """The verdict on the photo, which the window shows above the picture."""
        self._pages = QStackedWidget()
        self._pages.addWidget(self._make_invitation())
        self._pages.addWidget(self._make_page())
        self.verdict.step_taken.connect(self._match_square)
        self.steps = PhotoSteps()
        self.steps.chosen.connect(self._go_to_step)
        self._photo: Photo | None = None
        self._match: Match | None = None
        self._is_outdated = False
        self._scene: Scene | None = None
        fill(QVBoxLayout(self), self.steps, self._pages, margins=(4, 0, 4, 0))
        self.result.hide()
        self.many.files_shown.connect(self._show_page)
        self.many.rows_changed.connect(self._show_row)
        for form in (self.form, self.placement):
            form.refused.connect(self.refused)
            form.accepted.connect(self.accepted)

    def _make_invitation(self) -> QWidget:
        text = paragraph(
            "No photo is open. Drop one or more photos on the window, or open them, to lay one "
            "over the simulation and find the settings that explain its stripes."
        )
        button = push_button(
            "&Open photos…",
            "Choose one or more photos of a rolling-shutter camera.",
            self.open_asked,
        )
        page, self._samples = QWidget(), QVBoxLayout()
        at_left = Qt.AlignmentFlag.AlignLeft
        fill(QVBoxLayout(page), text, (button, 0, at_left), self._samples, None)
        return page

    def show_samples(self, files: Mapping[str, Path]) -> None:
        """Offer sample photos, by description, for when no photo is open."""
        for text, path in files.items():
            button = push_button(
                f"Sample: {text} (simulated)",
                "Open this photo with its scene, to try a match.",
                lambda _=False, path=path: self.sample_chosen.emit(path),
            )
            self._samples.addWidget(button, 0, Qt.AlignmentFlag.AlignLeft)

    def _make_page(self) -> QWidget:
        page = self._page = QWidget()
        fill(
            QVBoxLayout(page), self.facts, _line(), self.lamps, _line(), self.form, self.result,
            _line(), self.placement, None, margins=(6, 4, 6, 4), spacing=5,
        )  # fmt: skip
        least = QSize(page.minimumSizeHint().width() + _SCROLL_BAR, _LEAST_HEIGHT)
        self._scroll = ScrollPane(page, least)
        return self._scroll

    def show_photo(self, photo: Photo | None) -> None:
        if photo is not None and (self._photo is None or self._photo.path != photo.path):
            self._scroll.verticalScrollBar().setValue(0)  # its name is at the top
        self._photo, self._match, self._is_outdated = photo, None, False
        self.verdict.show_photo(photo)
        self._show_page()
        self._show_steps()
        self.many.rows.show_open(None if photo is None else photo.path)
        self._show_row()
        if photo is not None:
            self.facts.show_photo(photo)

    def show_choice(self, choice: PhotoChoice) -> None:
        self.facts.show_load_options(choice.load_options.channel, choice.load_options.scan_axis)
        self.form.show_choice(choice.form, choice.certain, choice.forgotten)
        for part in (self.result, self.many, self.verdict):
            part.show_certain(choice.certain)

    def _show_row(self) -> None:
        photo = self._photo
        self.verdict.show_row(None if photo is None else self.many.rows.row_of(photo.path))

    @property
    def has_photo(self) -> bool:
        return self._photo is not None

    def _show_page(self) -> None:
        """Show the forms if there is a photo or a table, else the invitation."""
        self._pages.setCurrentIndex(1 if self.has_photo or self.many.rows.paths else 0)
        for part in (self.facts, self.form.start, self.placement):
            part.setVisible(self.has_photo)

    def show_scene(self, scene: Scene) -> None:
        self._scene = scene
        self._show_steps()
        for part in (self.form, self.result, self.many):
            part.show_scene(scene)

    def _show_steps(self) -> None:
        match, scene = self._match, self._scene
        is_applied = match is not None and scene is not None and match.is_applied_to(scene)
        self.verdict.show_applied(is_applied)
        worth = "" if match is None else EARLIER if self._is_outdated else match.verdict
        self.steps.show_state(has_photo=self.has_photo, match=worth, is_applied=is_applied)

    def _go_to_step(self, step: str) -> None:
        if step == "open":
            self.open_asked.emit()
        elif step == "sent":
            self._bring_into_view(self.form)
            self.form.sent.setFocus()
        elif step == "match":
            self.form.start.click()
        else:
            self.result.apply.click()

    def _match_square(self) -> None:
        self._bring_into_view(self.form)
        self.form.match_square()

    def show_match_running(self, is_running: bool, why_not: Sequence[str] = ()) -> None:
        """Show whether a match is running; if not, why the last one was refused, if it was."""
        if is_running != self.form.is_running:
            self.form.show_running(is_running)
        if is_running:
            self.verdict.show_begun()
        else:
            self.verdict.show_ended(why_not)

    def show_match(self, found: FoundMatch | None, cure: Cure | None = None) -> None:
        """Show a match with the remedy for its bars, or that there is none."""
        match = None if found is None else found.match
        self.result.setVisible(match is not None)
        self._match, self._is_outdated = match, False
        self.verdict.show_match(match)
        self._show_steps()
        if found is None or match is None or cure is None or self._photo is None:
            return
        bar = self._scroll.verticalScrollBar()
        place, photo = bar.value(), self._photo
        noted, given = photo.exposure_time, found.given
        self.result.show_match(match, noted, given, cure, turned=photo.turned)
        self._bring_into_view(self.result)
        if found.is_listed:  # the table stays where it was
            bar.setValue(place)

    def show_match_outdated(self, why: str, usable: bool) -> None:
        """Show why the match is outdated, empty if it is not, and whether it can be used."""
        self._is_outdated = bool(why)
        self.result.show_outdated(why, usable)
        self.verdict.show_outdated(why)
        self._show_steps()

    def _bring_into_view(self, part: QWidget) -> None:
        """Scroll to a part that has just appeared, once the page has a new layout."""
        self._page.adjustSize()
        # Its top is what must be visible: it says most.
        bar, room = self._scroll.verticalScrollBar(), self._scroll.viewport().height()
        top = part.mapTo(self._page, QPoint()).y()
        if not bar.value() <= top <= bar.value() + room - part.height():
            bar.setValue(top - _MARGIN_ABOVE)


def _line() -> QFrame:
    line = QFrame()
    line.setFrameShape(QFrame.Shape.HLine)
    line.setFrameShadow(QFrame.Shadow.Sunken)
    return line
