"""Application: creates stores, features and window, and connects them."""

from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QSettings

from occ_gui.app.error_reports import ErrorReports
from occ_gui.app.features import features, middle
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.photo_in_window import PhotoInWindow
from occ_gui.app.scene_in_window import SceneInWindow
from occ_gui.app.status_messages import StatusMessages
from occ_gui.app.story_wiring import connect_story
from occ_gui.app.video_pane import VideoPane
from occ_gui.app.view_options import ViewOptions
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.wiring import Measuring
from occ_gui.files.document import Document
from occ_gui.files.file_controller import FileController, sample_photos
from occ_gui.files.preferences import Preferences
from occ_gui.files.preset_controller import PresetController
from occ_gui.files.session import Session
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.pins.pin_controller import PinController
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.outdated_marks import OutdatedMarks
from occ_gui.shell.results import Board
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.story.story_view import StoryView
from occ_gui.window.current_pane import CurrentPane
from occ_gui.window.main_window import MainWindow
from occ_model.effects.registry import EFFECTS
from occ_model.plugins import all_at_work
from occ_model.scene.parameters import PARAMETERS


class Application(QObject):
    """Stores, features and window, connected.

    ``preferences``: the stored preferences; by default nothing is stored.
    """

    def __init__(self, workspace: Workspace, preferences: QSettings | None = None) -> None:
        super().__init__()
        store = Store(workspace)
        self.store = SceneStore(store, {e.name: e.label for e in EFFECTS})
        self.settings = self.store.settings
        self.editor = SceneEditor(self.store)
        self.preferences = Preferences(preferences)
        # Simulates the first picture while the panes are created.
        self.simulation = SimulationController(self.store)
        self.present = PresentResults(self.simulation)
        self.controls = _controls()
        self.slider_strips = SliderStrips(self.controls.main_rows())
        self.board = Board()
        self.shell = Shell(store, self.board)
        centre = middle(self)
        self.story: StoryView = self.view("story")
        self.window = MainWindow(
            self.controls, centre, self.story, undo_stack=self.store.undo_stack
        )
        self.messages = StatusMessages(self.window, self.controls)
        self.photos = PhotoController(store, self.board)
        self.presets = PresetController(self.window, self.store)
        self.files = FileController(
            self.window, self.store, self.photos, self.preferences, self.present.ask
        )
        self.document = Document(self.window, self.store, self.files)
        self.measuring = Measuring(self.store, self.slider_strips, self._has_picture)
        self.pins = PinController(self.store, self.present.is_present)
        self.lessons = LessonsInWindow(self.window, self.shell)
        self.video = VideoPane(
            self.window,
            self.shell,
            store,
            self.files.ask_for_film,
            self.files.ask_to_save_film,
        )
        self.options = ViewOptions(self.window, store, self.preferences, self.editor.brightness)
        self.error_reports = ErrorReports()
        self.photo = PhotoInWindow(self)
        for feature in features(self, self.photo):
            self.shell.add(feature, self.window)
        # After the panes: what they show comes before what is said of it.
        self.outdated = OutdatedMarks(self.board, self.simulation, self.window)
        self.outdated.mark_pane(self.shell.pane("story"))
        self.shell.made.connect(self.outdated.take)
        self.current_pane = CurrentPane(self.window, self.window.docks)
        self._offer_exports()
        connect_story(self)
        self.scene = SceneInWindow(self)
        self.session = Session(store, self._users_own)
        self._connect_parts()

    def _offer_exports(self) -> None:
        menus, figures = self.window.menus, self.shell.figures.values()
        titles = {figure.name: figure.title for figure in figures}
        menus.add_figures(titles, lambda name: self.shell.pane("export").ask(name))
        sliders = {name: PARAMETERS[name].label for name in self.controls.main_rows()}
        menus.add_animations(sliders, self._animate)
        self.controls.player.film_asked.connect(self._animate)

    def _connect_parts(self) -> None:
        window, story = self.window, self.story
        for said in (
            self.presets.status_message, self.files.status_message, self.present.status_message,
            self.editor.brightness.status_message, self.shell.said, self.error_reports.reported,
            self.session.status_message,
        ):  # fmt: skip
            said.connect(window.say)
        for noted in (self.lessons.noted, self.pins.status_message):
            noted.connect(self.messages.show_note)
        window.leave_messages_to(story.verdict.sentence, story.verdict.wrapped)
        for end in (self._begin_to_end, self.session.end, self.stop):
            window.closing.connect(end)
        self.session.written.connect(self._keep_view)
        self.photos.opened.connect(self.document.show_photo)
        window.dropped.connect(self.files.open_dropped)
        window.menus.show_samples(sample_photos(), self.files.open_sample)
        self.files.film_asked.connect(self.video.open)
        self.files.film_save_asked.connect(self.video.save)
        self.controls.player.run_changed.connect(self.outdated.follow_run)
        self.pins.both_pinned.connect(self._show_comparison)
        story.verdict.lesson_wanted.connect(self._show_lesson)
        self.measuring.rate_changed.connect(story.verdict.show_rate)
        self._connect_strips()
        entries = window.actions_by_name
        entries["undo"].triggered.connect(self._say_undone)
        entries["redo"].triggered.connect(self._say_redone)

    def _say_undone(self) -> None:
        # What has changed may be in another mode. In a menu, a doubled & is one.
        step = self.store.undo_stack.redoText().replace("&&", "&")
        self.messages.show_note(f"Undone: {step}.")

    def _say_redone(self) -> None:
        step = self.store.undo_stack.undoText().replace("&&", "&")
        self.messages.show_note(f"Redone: {step}.")

    def _connect_strips(self) -> None:
        self.controls.add_foot(self.slider_strips.legend)
        shown = self.window.actions_by_name["slider_strips"]
        shown.toggled.connect(self.slider_strips.set_shown)
        shown.triggered.connect(self.preferences.keep_slider_strips)
        self.slider_strips.set_shown(self.preferences.slider_strips)
        shown.setChecked(self.preferences.slider_strips)

    @property
    def is_idle(self) -> bool:
        parts = (self.simulation.runner, self.outdated, self.pins, self.shell)
        return all(part.is_idle for part in parts)

    def _has_picture(self) -> bool:
        return self.present.latest is not None or self.simulation.runner.is_idle

    @property
    def is_measured(self) -> bool:
        return self.measuring.is_idle and self.shell.is_measured

    def view(self, name: str) -> Any:
        """Return the view of a pane, which is made if it has never been seen."""
        return self.shell.pane(name).view

    def open_photo(self, path: Path, match: bool = False, front: bool = True) -> None:
        """Open a photo.

        ``match``: whether to match it and to apply the result to the scene.
        ``front``: whether to bring its pane to the front.
        """
        self.photo.open(path, match, front)

    def resume(self, workspace: Workspace) -> None:
        """Have what an earlier window has left, which is no step and stays behind."""
        self.photo.stay_behind(workspace.photo.path)
        self.store.store.put(workspace)

    def _users_own(self) -> Workspace:
        """Return what the user has set; what a lesson shows in its place is not kept."""
        return self.lessons.users_own() or self.store.store.workspace

    def _keep_view(self) -> None:
        """Store how the window looks, unless a lesson has its own panes in it."""
        if self.lessons.users_own() is None:
            self.options.keep()

    def _animate(self, name: str) -> None:
        self.shell.pane("animation").ask(name)

    def _show_comparison(self) -> None:
        self.window.bring_to_front("compare")

    def _show_lesson(self, name: str) -> None:
        self.window.bring_to_front("lessons")
        lessons = self.shell.pane("lessons").controller
        lessons.set_seen(True)
        lessons.choose(name)

    def _begin_to_end(self) -> None:
        # What follows waits for work, and somebody may lose patience first.
        self.session.write()
        for who in all_at_work():
            self.window.say(f"{who} is waited for.")
            self.window.repaint()
        self.simulation.stop()  # of the scene that is restored no picture is needed
        self.lessons.end()

    def stop(self) -> None:
        for part in (self.simulation, self.pins.runner, self.shell, self.measuring):
            part.stop()
        self.error_reports.remove()


def _controls() -> ControlPanel:
    """Make the controls, those of the effects in the order that light travels."""
    effects = dict.fromkeys(name for effect in EFFECTS for name in effect.parameters)
    stages = {name: e.stage for e in reversed(EFFECTS) for name in e.parameters}
    return ControlPanel([], [*effects], {name: stages[name] for name in effects})
