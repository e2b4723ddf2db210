"""Parts of the window: stores, controllers and panes, in the order of dependence."""

from typing import Any

from PySide6.QtCore import QObject, QSettings
from PySide6.QtWidgets import QWidget

from occ_gui.app import panes
from occ_gui.app.error_reports import ErrorReports
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.status_messages import StatusMessages
from occ_gui.app.video_pane import VideoPane
from occ_gui.app.view_options import ViewOptions
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
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import ResultsStore
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.story.feature import story
from occ_gui.story.story_view import StoryView
from occ_gui.window.docks import CurrentPane
from occ_gui.window.main_window import MainWindow
from occ_model.effects.registry import EFFECTS
from occ_model.receiver.decode import DECODERS


class Parts(QObject):
    """Stores, controllers and panes of the window; without ``preferences`` nothing is stored."""

    current_pane: CurrentPane  # of all docks, once they have been added

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
        self.controls = _make_controls()
        self.slider_strips = SliderStrips(self.controls.main_rows())
        self.results_store = ResultsStore()
        self.shell = Shell(store, self.results_store)
        centre = self._make_centre()
        self.story: StoryView = self.view("story")
        self.window = MainWindow(
            self.controls, centre, self.story, undo_stack=self.store.undo_stack
        )
        self.messages = StatusMessages(self.window, self.controls, store, self.results_store)
        self.photos = PhotoController(store, self.results_store)
        self.presets = PresetController(self.window, self.store)
        self.files = FileController(
            self.window, self.store, self.photos, self.preferences, self.present.ask
        )
        self.document = Document(self.window, self.store, self.files)
        self.background_rates = BackgroundRates(self.store, self.slider_strips, self._has_picture)
        self.pins = PinController(self.store, self.present.is_present)
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
        whole = self.shell.embed(panes.picture(self.store.store, self.about_photo))
        return self.shell.embed(story(self.store, self.simulation, whole, [*DECODERS]))

    def about_photo(self) -> str:
        """Return the photo's name and the verdict on its match; empty if none is open."""
        pane = self.shell.find_pane("photo")
        return "" if pane is None else str(pane.verdict.about())

    def _has_picture(self) -> bool:
        return self.present.latest is not None or self.simulation.runner.is_idle


def _make_controls() -> ControlPanel:
    """Make the controls, those of the effects in the order of the light's path."""
    effects = dict.fromkeys(name for effect in EFFECTS for name in effect.parameters)
    stages = {name: e.stage for e in reversed(EFFECTS) for name in e.parameters}
    return ControlPanel([*effects], {name: stages[name] for name in effects})
