"""Connections of the story: what feeds it, and what its choices change in other panes."""

from typing import TYPE_CHECKING, Any, Protocol

from PySide6.QtCore import QCoreApplication, QObject, Qt
from PySide6.QtWidgets import QMenu

from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.outdated_panes import OutdatedPanes
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_view import PhotoView
from occ_gui.picture.image_view import ImageView
from occ_gui.profile.photo_profile import PhotoProfile
from occ_gui.profile.profile_view import ProfileView
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.story.column_axis import Crosshair
from occ_gui.story.story_view import StoryView
from occ_gui.widgets.copying import copy_text
from occ_gui.window.main_window import MainWindow

if TYPE_CHECKING:
    from occ_gui.explanation.exposure_controller import ExposureController


class Parts(Protocol):
    """The parts of the application that the story is connected with."""

    window: MainWindow
    simulation: SimulationController
    outdated: OutdatedPanes
    story: StoryView
    image: ImageView
    profile: ProfileView
    decode: DecodeView
    lessons: LessonsInWindow
    shell: Shell
    photo: PhotoView
    photos: PhotoController


def tell_story(parts: Parts) -> None:
    """Connect the story with the simulation and with the panes that show the same in detail.

    Readings come to it as to all other panes, by ``SimulationController.show_in``.
    """
    story, simulation, image = parts.story, parts.simulation, parts.image
    simulation.picture_ready.connect(story.show_picture)
    simulation.draft_for(lambda: _rows_per_pixel(story, image))
    simulation.failed.connect(story.verdict.show_failure)
    simulation.submitted.connect(story.verdict.end_failure)
    parts.outdated.mark_verdict(story.verdict)
    parts.outdated.mark_readings(story.rows)
    parts.outdated.mark_picture(story.rows.stripes)  # it comes later than the reading
    parts.decode.decoder_chosen.connect(story.choose_decoder)
    story.decoder_chosen.connect(parts.decode.choose_decoder)
    image.picture_chosen.connect(story.choose_picture)
    story.picture_chosen.connect(image.choose_picture)
    _link_profiles(story, parts.profile)
    parts.lessons.columns_held.connect(story.hold_columns)
    _tell_verdicts_apart(parts)
    crosshair = story.rows.crosshair

    def share(name: str, pane: Any) -> None:
        if name == "equations":
            _share_column(crosshair, pane.exposure)

    parts.shell.made.connect(share)
    # What is asked of the picture is seen in the whole one.
    parts.window.menus.overlays.triggered.connect(lambda: story.show_whole_picture(True))
    asked = _WholePictureWhileAsked(story)
    image.before.chosen.toggled.connect(asked.show)
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
        QCoreApplication.translate("StoryMenu", "Copy the &values at the crosshair"),
        lambda: parts.window.say(copy_text(text)),
    )
    for name in ("copy_figure", "export_profile", "export_picture", "measure", "fit"):
        if name in actions:
            menu.addAction(actions[name])
    menu.aboutToHide.connect(menu.deleteLater)
    return menu


def _link_profiles(story: StoryView, profile: ProfileView) -> None:
    """Show the same levels in both profiles, and a photo's in the story where they agree."""

    def show_photo(photo: PhotoProfile | None) -> None:
        agree = profile.is_enhanced == (story.whose.key() == "receiver")
        story.show_photo_profile(photo if agree else None)

    story.picture_chosen.connect(lambda whose: profile.enhanced.setChecked(whose == "receiver"))
    profile.photo_shown.connect(show_photo)


def _tell_verdicts_apart(parts: Parts) -> None:
    """Show first what the mode is about, and name the simulation where a photo is shown, too."""
    story, photo = parts.story, parts.photo.verdict
    story.take_photo_verdict(photo)
    naming = _SimulationNaming(parts)
    parts.window.modes.changed.connect(naming.show)
    parts.photos.opened.connect(naming.show)
    parts.lessons.photo_explained.connect(naming.note_step)
    story.verdict.changed.connect(
        lambda: photo.show_simulation(story.verdict.state, story.verdict.heading)
    )


class _SimulationNaming(QObject):
    """Names the simulation where a photo is shown, too.

    A slot, not a function: the signal of the photos would hold that beyond the window's end.
    """

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._story, self._photo, self._modes = parts.story, parts.photo, parts.window.modes
        self._is_step_about_photo = False

    def note_step(self, about_photo: bool) -> None:
        """Note whether the step of a lesson is about the photo."""
        self._is_step_about_photo = about_photo
        self.show()

    def show(self) -> None:
        """Name it as the mode and the photo of the moment ask for."""
        in_step = self._modes.mode == "lessons" and self._is_step_about_photo
        is_about_photo = self._modes.mode == "photo" or in_step
        self._story.be_about_photo(is_about_photo)
        self._story.verdict.name_simulation(is_about_photo or self._photo.has_photo)


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


def _rows_per_pixel(story: StoryView, image: ImageView) -> float:
    """Return how many rows of the picture share a pixel where it is seen."""
    return image.rows_per_pixel() if story.shows_whole_picture else story.rows_per_pixel()
