"""Parts of the window: stores, controllers, panes, messages, films and options."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, QSettings
from PySide6.QtWidgets import QWidget

from occ_gui.app import panes
from occ_gui.app.error_reports import ErrorReports
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.wiring import BackgroundRates
from occ_gui.files.document import Document
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.files.preset_controller import PresetController
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.pins.pin_controller import PinController
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_editor import BrightnessHold, SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import (
    ResultsStore,
    StateSelector,
    make_remark,
    next_change,
    next_photo,
    next_picture,
    next_sentence,
    status_message,
)
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.story.feature import declare_story
from occ_gui.story.story_view import StoryView
from occ_gui.values.remarks import Failure, Remark
from occ_gui.window.docks import CurrentPane, DockLayout
from occ_gui.window.main_window import MainWindow
from occ_gui.window.theme import TextSize, ThemeController
from occ_model.effects.registry import EFFECTS
from occ_model.receiver.decode import DECODERS
from occ_model.scene.parameters import PARAMETERS

if TYPE_CHECKING:
    from occ_gui.video.wiring import VideoWiring


class StatusMessages(QObject):
    """Shows the sentence that applies to workspace and results."""

    def __init__(
        self, window: MainWindow, controls: ControlPanel, store: Store, results_store: ResultsStore
    ) -> None:
        super().__init__(window)
        self._window, self._controls = window, controls
        self._store, self._results_store = store, results_store
        self._shown_message: tuple[Remark | None, str] = (None, "")
        self._failed_fields: tuple[str, ...] = ()  # the fields that show a failure's sentence
        store.select(lambda workspace: workspace).changed.connect(self._show)
        results_store.changed.connect(self._show)
        results_store.select(lambda results: results.failure).changed.connect(self._mark)

    def _show(self) -> None:
        results = self._results_store.results
        message = (results.remark, status_message(self._store.workspace, results))
        if message != self._shown_message:
            self._shown_message = message
            self._window.show_message(message[1])

    def _mark(self, failure: Failure | None) -> None:
        self._controls.end_refusals(self._failed_fields)
        self._failed_fields = () if failure is None else failure.parameters
        if failure is not None:
            self._controls.show_problem(failure.sentence, failure.parameters, stays=True)

    def say(self, sentence: str, until: StateSelector = next_sentence) -> None:
        results = self._results_store.results
        remark = make_remark(sentence, until, self._store.workspace, results)
        self._results_store.put(replace(results, remark=remark))

    def note(self, sentence: str) -> None:
        """Show a remark on the present scene, until the next change of scene or settings."""
        self.say(sentence, next_change)

    def say_failure(self, sentence: str, parameters: Sequence[str] = ()) -> None:
        """Show, until the next picture, why a scene has none, also at the fields concerned."""
        self.say(sentence, next_picture)
        failure = Failure(sentence, tuple(parameters))
        self._results_store.put(replace(self._results_store.results, failure=failure))

    def say_file_failure(self, sentence: str, until: StateSelector = next_change) -> None:
        """Show in the window's middle why a file was not opened or saved."""
        self.say(sentence, until)
        self._window.show_failure(sentence)

    def say_photo_failure(self, sentence: str) -> None:
        """Show why a photo cannot be read, until another one is read."""
        self.say_file_failure(sentence, next_photo)

    def accept(self) -> None:
        """Remove refusals, because an allowed value was entered."""
        remark = self._results_store.results.remark
        if remark is not None and remark.select_state is next_change:
            self._results_store.put(replace(self._results_store.results, remark=None))
        self._controls.end_refusals(name for name in PARAMETERS if name not in self._failed_fields)


class VideoPane(QObject):
    """Opens, saves and closes films; a film is read when its pane is first shown."""

    def __init__(
        self, window: MainWindow, shell: Shell, store: Store, files: FileController
    ) -> None:
        super().__init__()
        self._window, self._shell, self._store, self._files = window, shell, store, files
        shell.made.connect(self._connect)
        files.film_requested.connect(self.open)
        files.film_save_requested.connect(self.save)

    def _connect(self, name: str, pane: Any) -> None:
        if name == "video":
            pane.open_asked.connect(self._files.ask_for_film)
            pane.save_asked.connect(self._files.ask_to_save_film)

    @property
    def wiring(self) -> "VideoWiring":
        pane: VideoWiring = self._shell.pane("video")
        return pane

    def open(self, path: Path) -> None:
        if self._shell.find_pane("video") is None:
            self._choose(path)
        else:
            self.wiring.open(path)
        self._window.bring_to_front("video")

    def save(self, path: Path) -> None:
        self.wiring.save(path)
        self._window.bring_to_front("video")  # where the progress is shown

    def close(self) -> None:
        if self._shell.find_pane("video") is None:
            self._choose(None)
        else:
            self.wiring.close()

    def _choose(self, path: Path | None) -> None:
        workspace = self._store.workspace
        self._store.put(replace(workspace, film=workspace.film.open(path)))


_THEME, _TEXT = "view/theme", "view/text_percent"
_HOLD, _YES = "edit/hold_brightness", "yes"


class ViewOptions(QObject):
    def __init__(
        self,
        window: MainWindow,
        store: Store,
        preferences: Preferences,
        hold: BrightnessHold,
        say: Callable[[str], None],
    ) -> None:
        super().__init__(window)
        self._window, self._store, self._preferences, self._say = window, store, preferences, say
        self.theme, self.text_size, self.brightness = ThemeController(), TextSize(), hold
        window.apply_style()
        self.layout = DockLayout(window, window.modes, preferences)
        self.theme.chosen.connect(self._on_theme)
        self.theme.colours_changed.connect(window.apply_style)
        self.text_size.chosen.connect(self._on_text_size)
        hold.switched.connect(self._on_hold)
        window.actions_by_name["hold_brightness"].triggered.connect(hold.switch)
        menus = window.menus
        menus.themes.triggered.connect(lambda action: self.theme.choose(action.data()))
        menus.overlays.triggered.connect(lambda action: self.choose_overlay(action.data()))
        store.select(lambda workspace: workspace.overlay).changed.connect(self._show_overlay)

    def restore(self) -> None:
        """Restore the options of the last window, before this one is shown."""
        recall = self._preferences.recall
        self.layout.restore()
        self.theme.choose(recall(_THEME))
        if (percent := recall(_TEXT)).isdecimal():
            self.text_size.choose(int(percent))
        self.brightness.switch(recall(_HOLD) == _YES)

    def choose_overlay(self, mode: str) -> None:
        self._store.put(replace(self._store.workspace, overlay=mode))

    def _show_overlay(self, mode: str) -> None:
        menus = self._window.menus
        menus.show_choice(menus.overlays, mode)

    def _on_theme(self, theme: str) -> None:
        self._preferences.keep(_THEME, theme)
        menus = self._window.menus
        menus.show_choice(menus.themes, theme)

    def _on_text_size(self, percent: int) -> None:
        self._preferences.keep(_TEXT, str(percent))
        self._window.modes.limit_sides()
        self._say(f"Text at {percent} %")

    def _on_hold(self, on: bool) -> None:
        self._preferences.keep(_HOLD, _YES if on else "")
        self._window.actions_by_name["hold_brightness"].setChecked(on)


class Parts(QObject):
    """Stores, controllers and panes of the window; without ``preferences`` nothing is stored."""

    current_pane: CurrentPane  # set once all docks have been added

    def __init__(self, workspace: Workspace, preferences: QSettings | None = None) -> None:
        super().__init__()
        store = Store(workspace)
        self.scene_store = scenes = SceneStore(store, {e.name: e.label for e in EFFECTS})
        self.settings = scenes.settings
        self.editor = SceneEditor(scenes)
        self.preferences = Preferences(preferences)
        # Simulates the first picture while the panes are created.
        self.simulation = SimulationController(scenes)
        self.present_results = PresentResults(self.simulation)
        self.controls = _make_controls()
        self.slider_strips = SliderStrips(self.controls.main_rows())
        self.results_store = ResultsStore()
        self.shell = Shell(store, self.results_store)
        centre = self._make_centre()
        self.story: StoryView = self.view("story")
        self.window = MainWindow(self.controls, centre, self.story, undo_stack=scenes.undo_stack)
        self.messages = StatusMessages(self.window, self.controls, store, self.results_store)
        self.photos = PhotoController(store, self.results_store)
        self.presets = PresetController(self.window, scenes)
        self.files = FileController(
            self.window, scenes, self.photos, self.preferences, self.present_results.ask
        )
        self.document = Document(self.window, scenes, self.files)
        self.background_rates = BackgroundRates(scenes, self.slider_strips, self._may_measure_rates)
        self.pins = PinController(scenes, self.present_results.is_present)
        self.lessons = LessonsInWindow(self.window, self.shell)
        self.video = VideoPane(self.window, self.shell, store, self.files)
        self.options = ViewOptions(
            self.window, store, self.preferences, self.editor.brightness, self.messages.say
        )
        self.error_reports = ErrorReports()

    def view(self, name: str) -> Any:
        """Return the view of a pane, which is made if needed."""
        return self.shell.pane(name).view

    def _make_centre(self) -> QWidget:
        """Make the story, with a place for the whole picture in it."""
        scenes, shell = self.scene_store, self.shell
        picture = shell.embed(panes.picture(scenes.store, self.describe_photo))
        return shell.embed(declare_story(scenes, self.simulation, picture, [*DECODERS]))

    def describe_photo(self) -> str:
        """Return the photo's name and the verdict on its match; empty if no photo is open."""
        results = self.results_store.results
        if results.document is None:
            return ""
        from occ_gui.photo.photo_verdict import photo_caption
        from occ_gui.photo.shown_photo import ShownPhoto

        return photo_caption(ShownPhoto.of(self.scene_store.store.workspace, results))

    def _may_measure_rates(self) -> bool:
        """Return whether the first picture is shown, or none is being simulated."""
        return self.present_results.latest is not None or self.simulation.task.is_idle


def _make_controls() -> ControlPanel:
    """Make the controls, those of the effects in the order of the light's path."""
    effects = dict.fromkeys(name for effect in EFFECTS for name in effect.parameters)
    # Reversed: a parameter of several effects belongs to the first of them.
    stages = {name: e.stage for e in reversed(EFFECTS) for name in e.parameters}
    return ControlPanel([*effects], {name: stages[name] for name in effects})
