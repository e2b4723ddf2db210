"""Pane of the photo: facts about it and its loading, its match, and its placement."""

from collections.abc import Mapping
from pathlib import Path

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QStackedWidget, QVBoxLayout, QWidget

from occ_gui.photo.lamp_views import PartForm
from occ_gui.photo.many.many_view import ManyPhotosView
from occ_gui.photo.match_form import MatchForm
from occ_gui.photo.match_result import MatchResult
from occ_gui.photo.photo_verdict import EARLIER, PhotoSteps, PhotoVerdictBar
from occ_gui.photo.placement_form import PlacementForm
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.widgets.building import (
    ElidedLabel,
    KeyedComboBox,
    ScrollPane,
    fill,
    paragraph,
    push_button,
)
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import one_line
from occ_model.photo.reading.choices import CHANNELS
from occ_model.photo.reading.load import Photo
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

_PREFIXES = {"exposure_time": "", "iso": "ISO ", "f_number": "f/"}
"""Prefixes of the settings that cameras record, by the names of the scene's parameters."""


class PhotoFacts(QWidget):
    settings_asked = Signal()  # the user applies the camera's recorded settings to the scene

    def __init__(self) -> None:
        super().__init__()
        self.name = ElidedLabel(how=Qt.TextElideMode.ElideMiddle)
        font = self.name.font()
        font.setBold(True)
        self.name.setFont(font)
        self.size_line, self.notes = ElidedLabel(), ElidedLabel()
        self.use_settings = push_button(
            "&Use this photo's settings",
            "Put the exposure time, ISO speed and f-number that the camera recorded into the "
            "scene, as one step that can be undone.",
            self.settings_asked,
        )
        self.channel = KeyedComboBox(
            "Channel",
            "The colour channel searched for stripes; a grey photo has only one.",
            dict(zip(CHANNELS, CHANNELS, strict=True)),
        )
        self.scan_axis = KeyedComboBox(
            "Scanned",
            "The direction in which the shutter scanned: by columns or by lines of the file. "
            "Automatic: across the stripes.",
            {"auto": "automatic", "columns": "by columns", "lines": "by lines"},
        )
        notes = fill(QHBoxLayout(), (self.notes, 1), self.use_settings)
        choices = fill(
            QHBoxLayout(), QLabel("Channel"), (self.channel, 1), QLabel("Scanned"),
            (self.scan_axis, 1),
        )  # fmt: skip
        fill(QVBoxLayout(self), self.name, self.size_line, notes, choices, margins=0, spacing=3)

    def show_photo(self, photo: Photo) -> None:
        self.name.set_full_text(photo.path.name)
        self.name.setToolTip(in_tool_tip(one_line(str(photo.path), LONGEST_TEXT)))
        rows, columns = photo.image.shape
        width, height = (rows, columns) if photo.turned else (columns, rows)
        is_mean = photo.channel in {"grey", "luma"}
        channel = photo.channel if is_mean else f"{photo.channel} channel"
        facts = [photo.camera] if photo.camera else []
        facts += [f"{width} x {height} px", channel]
        facts += ["turned"] if photo.turned else []
        facts += ["linear: gamma 1"] if photo.is_linear else []
        self.size_line.set_full_text(", ".join(facts))
        recorded = [
            prefix + quantity(name).format(value)
            for name, prefix in _PREFIXES.items()
            if (value := getattr(photo, name)) is not None
        ]
        self.notes.set_full_text(", ".join(recorded) or "No settings recorded.")
        self.use_settings.setEnabled(bool(recorded))

    def show_load_options(self, channel: str, scan_axis: str) -> None:
        self.channel.show_key(channel)
        self.scan_axis.show_key(scan_axis)


_SCROLL_BAR = 20
_LEAST_HEIGHT = 200

_MARGIN_ABOVE = 4  # pixels above a part that is scrolled to


class PhotoView(QWidget):
    """The forms of the open photo; without one, an invitation to open one."""

    open_asked = Signal()
    sample_chosen = Signal(Path)  # the user opens one of the sample photos

    def __init__(self) -> None:
        super().__init__()
        hidden_parent = QWidget(self)
        hidden_parent.hide()
        self.many = ManyPhotosView(hidden_parent)
        """The table of several photos; its own pane takes it over when it is made."""
        self.facts, self.form, self.lamps = PhotoFacts(), MatchForm(), PartForm()
        self.result, self.placement = MatchResult(), PlacementForm()
        self.verdict = PhotoVerdictBar()
        self.verdict.setParent(hidden_parent)
        """The verdict on the photo, which the window shows above the picture."""
        self._pages = QStackedWidget()
        self._pages.addWidget(self._make_invitation())
        self._pages.addWidget(self._make_page())
        self.verdict.step_taken.connect(self._match_lamp)
        self.steps = PhotoSteps()
        self.steps.chosen.connect(self._go_to_step)
        self._shown = ShownPhoto(Scene())
        fill(QVBoxLayout(self), self.steps, self._pages, margins=(4, 0, 4, 0))
        self.result.hide()

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
            QVBoxLayout(page), self.facts, _make_line(), self.lamps, _make_line(), self.form,
            self.result, _make_line(), self.placement, None, margins=(6, 4, 6, 4), spacing=5,
        )  # fmt: skip
        minimum_size = QSize(page.minimumSizeHint().width() + _SCROLL_BAR, _LEAST_HEIGHT)
        self._scroll = ScrollPane(page, minimum_size)
        return self._scroll

    def show_photo(self, shown: ShownPhoto) -> None:
        last, self._shown = self._shown, shown
        photo, options = shown.photo, shown.choice.load_options
        if photo is not last.photo:
            if photo is not None and (last.photo is None or photo.path != last.photo.path):
                self._scroll.verticalScrollBar().setValue(0)  # its name is at the top
            if photo is not None:
                self.facts.show_photo(photo)
        self._show_page(shown)
        self.facts.show_load_options(options.channel, options.scan_axis)
        for part in (self.lamps, self.form, self.verdict, self.many):
            part.show_photo(shown)
        placement = (shown.placement, shown.is_placed_by_hand)
        if placement != (last.placement, last.is_placed_by_hand):
            self.placement.show_placement(*placement)
        self._show_result(shown, last)
        match, present = shown.match, shown.present_match
        verdict = "" if match is None else EARLIER if present is None else match.verdict
        self.steps.show_state(
            has_photo=photo is not None, match=verdict, is_applied=shown.is_applied
        )

    def _show_result(self, shown: ShownPhoto, last: ShownPhoto) -> None:
        bar = self._scroll.verticalScrollBar()
        scroll_position = bar.value()
        self.result.show_photo(shown)
        if shown.outcome is not None and shown.match is not None and shown.match is not last.match:
            self._bring_into_view(self.result)
            if shown.outcome.is_listed:  # the table stays where it was
                bar.setValue(scroll_position)

    def _show_page(self, shown: ShownPhoto) -> None:
        """Show the forms if there is a photo or a table, else the invitation."""
        has_photo = shown.photo is not None
        self._pages.setCurrentIndex(1 if has_photo or shown.choice.listed else 0)
        for part in (self.facts, self.form.start, self.placement):
            part.setVisible(has_photo)

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

    def _match_lamp(self) -> None:
        self._bring_into_view(self.form)
        self.form.match_lamp()

    def _bring_into_view(self, part: QWidget) -> None:
        """Scroll to a part that has just appeared, once the page has a new layout."""
        self._page.adjustSize()
        # The top must be visible, because it matters most.
        bar, height = self._scroll.verticalScrollBar(), self._scroll.viewport().height()
        top = part.mapTo(self._page, QPoint()).y()
        if not bar.value() <= top <= bar.value() + height - part.height():
            bar.setValue(top - _MARGIN_ABOVE)


def _make_line() -> QFrame:
    line = QFrame()
    line.setFrameShape(QFrame.Shape.HLine)
    line.setFrameShadow(QFrame.Shadow.Sunken)
    return line
