"""Connections of the story with the other panes."""

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QAbstractButton, QMenu

from occ_gui.app.parts import Parts
from occ_gui.shell.shell import Shell
from occ_gui.story.column_axis import Crosshair
from occ_gui.story.story_view import StoryView
from occ_gui.widgets.plain_text import copy_text

if TYPE_CHECKING:
    from occ_gui.explanation.pane import ExposureController
    from occ_gui.photo.photo_verdict import PhotoVerdictBar
    from occ_gui.picture.image_view import PicturesPane


def connect_story(parts: Parts) -> None:
    story, menus = parts.story, parts.window.menus
    parts.simulation.set_draft_resolution(lambda: _rows_per_pixel(story, parts.shell))
    parts.lessons.columns_held.connect(story.rows.hold_columns)
    _VerdictChoice(parts)
    crosshair, before = story.rows.crosshair, menus.actions["before"]

    readout = parts.window.readout

    # It must not refer to the shell, whose signal holds it: neither would ever be freed.
    def connect_pane(name: str, pane: Any) -> None:
        if name == "equations":
            _link_columns(crosshair, pane.exposure)
        elif name == "picture":
            from occ_gui.window.cursor_readout import follow_pictures

            follow_pictures(pane.view, readout.set_full_text)
            _find_before_button(pane).setChecked(before.isChecked())
            _find_before_button(pane).toggled.connect(before.setChecked)
        elif name == "profile":
            from occ_gui.window.cursor_readout import follow_profile

            follow_profile(pane.view, readout.set_full_text)

    parts.shell.made.connect(connect_pane)
    # Overlays and the picture before a change are drawn in the whole picture only.
    menus.overlays.triggered.connect(lambda: story.show_whole_picture(True))
    before.toggled.connect(_PictureDuringComparison(story).show)
    before.toggled.connect(
        lambda on: _find_before_button(parts.shell.pane("picture")).setChecked(on)
    )
    menus.actions["measure"].toggled.connect(story.switch_measuring)
    rows = story.rows
    rows.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
    rows.customContextMenuRequested.connect(
        lambda place: story_menu(parts).popup(rows.mapToGlobal(place))
    )


def story_menu(parts: Parts) -> QMenu:
    actions, menu = parts.window.actions_by_name, QMenu(parts.story.rows)
    text = parts.story.readout.toolTip()
    menu.addAction("Copy the &values at the crosshair", lambda: parts.messages.say(copy_text(text)))
    for name in ("copy_figure", "export_profile", "export_picture", "measure", "fit"):
        if name in actions:
            menu.addAction(actions[name])
    menu.aboutToHide.connect(menu.deleteLater)
    return menu


def _find_before_button(pane: "PicturesPane") -> QAbstractButton:
    return pane.view.before.checkbox


class _VerdictChoice(QObject):
    """Shows the verdict that the mode is about, and labels the simulation's if there is a photo.

    An object, because the photos' signal would keep a function beyond the window's end.
    """

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._story, self._modes, self._photos = parts.story, parts.window.modes, parts.photos
        self._verdict: PhotoVerdictBar | None = None
        self._is_step_about_photo = False
        parts.window.modes.changed.connect(self.show)
        parts.photos.opened.connect(self.show)
        parts.lessons.photo_explained.connect(self.note_step)
        parts.story.verdict.changed.connect(self._show_simulation)
        parts.shell.made.connect(self.add_photo)

    def add_photo(self, name: str, pane: Any) -> None:
        """Show the verdict on the photo, too, once the photo's pane is made."""
        if name != "photo":
            return
        self._verdict = pane.view.verdict
        self._story.add_photo_verdict(pane.view.verdict)
        self._show_simulation()
        self.show()

    def _show_simulation(self) -> None:
        verdict = self._story.verdict
        if self._verdict is not None:
            self._verdict.show_simulation(verdict.state, verdict.heading)

    def note_step(self, is_about_photo: bool) -> None:
        self._is_step_about_photo = is_about_photo
        self.show()

    def show(self) -> None:
        is_photo_step = self._modes.mode == "lessons" and self._is_step_about_photo
        is_about_photo = self._modes.mode == "photo" or is_photo_step
        self._story.show_photo_verdict(is_about_photo)
        has_photo = self._photos.document is not None
        self._story.verdict.name_simulation(is_about_photo or has_photo)


def _link_columns(crosshair: Crosshair, exposure: "ExposureController") -> None:
    """Keep the column chosen in the story equal to the one whose exposure is explained."""

    def follow() -> None:
        if crosshair.column is not None:
            exposure.follow(crosshair.column)

    crosshair.chosen.connect(follow)
    exposure.column_held.connect(crosshair.choose)
    follow()


class _PictureDuringComparison(QObject):
    """Shows the whole picture during the comparison with the one before a change."""

    def __init__(self, story: StoryView) -> None:
        super().__init__(story)
        self._story = story
        self._showed_rows = False

    def show(self, on: bool) -> None:
        if on:
            self._showed_rows = not self._story.shows_whole_picture
            self._story.show_whole_picture(True)
        elif self._showed_rows:
            self._story.show_whole_picture(False)


def _rows_per_pixel(story: StoryView, shell: Shell) -> float:
    """Return how many rows of the picture fall on a pixel of the screen."""
    pane = shell.find_pane("picture") if story.shows_whole_picture else None
    stripes = story.rows.stripes
    return stripes.rows_per_pixel() if pane is None else float(pane.view.rows_per_pixel())
