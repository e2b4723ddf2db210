"""Connections of the story: what feeds it, and what its choices change in other panes."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QMenu

from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.core.store import Store
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.outdated_marks import OutdatedMarks
from occ_gui.shell.results import Board, of_picture, of_reading
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.story.column_axis import Crosshair
from occ_gui.story.story_view import StoryView
from occ_gui.widgets.copying import copy_text
from occ_gui.window.main_window import MainWindow

if TYPE_CHECKING:
    from occ_gui.explanation.exposure_controller import ExposureController
    from occ_gui.photo.photo_view import PhotoView


class Parts(Protocol):
    """The parts of the application that the story is connected with."""

    window: MainWindow
    simulation: SimulationController
    outdated: OutdatedMarks
    story: StoryView
    store: SceneStore
    board: Board
    lessons: LessonsInWindow
    shell: Shell
    photos: PhotoController

    def choose_decoder(self, name: str) -> None:
        """Show what this decoder reads, everywhere."""


def connect_story(parts: Parts) -> None:
    """Connect the story with the simulation and with the panes that show the same in detail.

    Readings come to it as to all other panes, by ``SimulationController.show_in``.
    """
    story, simulation, store = parts.story, parts.simulation, parts.store.store
    simulation.picture_ready.connect(story.show_picture)
    simulation.draft_for(lambda: _rows_per_pixel(story, parts.shell))
    simulation.failed.connect(story.verdict.show_failure)
    simulation.submitted.connect(story.verdict.end_failure)
    parts.outdated.mark_verdict(story.verdict)
    parts.outdated.mark(story.rows, of_reading)
    parts.outdated.mark(story.rows.stripes, of_picture)  # it comes later than the reading
    store.select(lambda workspace: workspace.decoder).changed.connect(story.choose_decoder)
    story.decoder_chosen.connect(parts.choose_decoder)
    store.select(lambda workspace: workspace.whose).changed.connect(story.choose_picture)
    _ProfileLink(story, store, parts.board)
    parts.lessons.columns_held.connect(story.hold_columns)
    _SimulationNaming(parts)
    crosshair = story.rows.crosshair

    def share(name: str, pane: Any) -> None:
        if name == "equations":
            _share_column(crosshair, pane.exposure)

    parts.shell.made.connect(share)
    # What is asked of the picture is seen in the whole one.
    parts.window.menus.overlays.triggered.connect(lambda: story.show_whole_picture(True))
    asked = _WholePictureWhileAsked(story)
    parts.window.actions_by_name["before"].toggled.connect(asked.show)
    parts.window.actions_by_name["fit"].triggered.connect(story.fit)
    rows = story.rows
    rows.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
    rows.customContextMenuRequested.connect(
        lambda place: story_menu(parts).popup(rows.mapToGlobal(place))
    )
    parts.window.actions_by_name["measure"].toggled.connect(story.switch_measuring)


def story_menu(parts: Parts) -> QMenu:
    """Make the context menu of the rows: what can be copied, exported and measured there."""
    actions, menu = parts.window.actions_by_name, QMenu(parts.story.rows)
    text = parts.story.readout.toolTip()
    menu.addAction(
        "Copy the &values at the crosshair",
        lambda: parts.window.say(copy_text(text)),
    )
    for name in ("copy_figure", "export_profile", "export_picture", "measure", "fit"):
        if name in actions:
            menu.addAction(actions[name])
    menu.aboutToHide.connect(menu.deleteLater)
    return menu


class _ProfileLink(QObject):
    """Shows the same levels in both profiles, and a photo's in the story where they agree."""

    def __init__(self, story: StoryView, store: Store, board: Board) -> None:
        super().__init__(story)
        self._story, self._store, self._board = story, store, board
        story.picture_chosen.connect(self._choose)
        profile = board.select(lambda results: results.photo_profile)
        profile.changed.connect(self._show_photo)

    def _choose(self, whose: str) -> None:
        is_enhanced = whose == "receiver"
        self._store.put(replace(self._store.workspace, whose=whose, is_enhanced=is_enhanced))

    def _show_photo(self) -> None:
        is_receivers = self._story.whose.key() == "receiver"
        agree = self._store.workspace.is_enhanced == is_receivers
        self._story.show_photo_profile(self._board.results.photo_profile if agree else None)


class _SimulationNaming(QObject):
    """Shows first what the mode is about, and names the simulation where a photo is shown, too.

    A slot, not a function: the signal of the photos would hold that beyond the window's end.
    """

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._story, self._modes = parts.story, parts.window.modes
        self._photo: PhotoView | None = None
        self._is_step_about_photo = False
        parts.window.modes.changed.connect(self.show)
        parts.photos.opened.connect(self.show)
        parts.lessons.photo_explained.connect(self.note_step)
        parts.story.verdict.changed.connect(self._tell_photo)
        parts.shell.made.connect(self.take)

    def take(self, name: str, pane: Any) -> None:
        """Show the verdict on the photo, too, once its pane is made."""
        if name != "photo":
            return
        self._photo = pane.view
        self._story.take_photo_verdict(pane.view.verdict)
        self._tell_photo()
        self.show()

    def _tell_photo(self) -> None:
        verdict = self._story.verdict
        if self._photo is not None:
            self._photo.verdict.show_simulation(verdict.state, verdict.heading)

    def note_step(self, about_photo: bool) -> None:
        """Note whether the step of a lesson is about the photo."""
        self._is_step_about_photo = about_photo
        self.show()

    def show(self) -> None:
        """Name it as the mode and the photo of the moment ask for."""
        in_step = self._modes.mode == "lessons" and self._is_step_about_photo
        is_about_photo = self._modes.mode == "photo" or in_step
        self._story.show_photo_verdict(is_about_photo)
        has_photo = self._photo is not None and self._photo.has_photo
        self._story.verdict.name_simulation(is_about_photo or has_photo)


def _share_column(crosshair: Crosshair, exposure: "ExposureController") -> None:
    """Explain the exposure of the column that is chosen in the story, and the other way round."""

    def follow() -> None:
        if crosshair.column is not None:
            exposure.follow(crosshair.column)

    crosshair.chosen.connect(follow)
    exposure.held.connect(crosshair.choose)
    follow()


class _WholePictureWhileAsked(QObject):
    """Shows the whole picture while something is asked of it, and then what was there before."""

    def __init__(self, story: StoryView) -> None:
        super().__init__(story)
        self._story = story
        self._showed_rows = False

    def show(self, asked: bool) -> None:
        """Show the whole picture, or again the rows that it was shown in place of."""
        if asked:
            self._showed_rows = not self._story.shows_whole_picture
            self._story.show_whole_picture(True)
        elif self._showed_rows:
            self._story.show_whole_picture(False)


def _rows_per_pixel(story: StoryView, shell: Shell) -> float:
    """Return how many rows of the picture share a pixel where it is seen."""
    pane = shell.made_pane("picture") if story.shows_whole_picture else None
    return story.rows_per_pixel() if pane is None else float(pane.view.rows_per_pixel())
