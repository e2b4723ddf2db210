"""Parts: what the application is made of, as those see it who connect some of them."""

from typing import Protocol

from occ_gui.app.error_reports import ErrorReports
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.status_messages import StatusMessages
from occ_gui.app.video_pane import VideoPane
from occ_gui.app.view_options import ViewOptions
from occ_gui.detection_map.wiring import Measuring
from occ_gui.files.document import Document
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.files.preset_controller import PresetController
from occ_gui.files.session import Session
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.pins.pin_controller import PinController
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import Board
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.story.story_view import StoryView
from occ_gui.window.current_pane import CurrentPane
from occ_gui.window.main_window import MainWindow


class Parts(Protocol):
    store: SceneStore
    editor: SceneEditor
    preferences: Preferences
    simulation: SimulationController
    present: PresentResults
    controls: ControlPanel
    board: Board
    shell: Shell
    story: StoryView
    window: MainWindow
    current_pane: CurrentPane
    messages: StatusMessages
    photos: PhotoController
    presets: PresetController
    files: FileController
    document: Document
    session: Session
    measuring: Measuring
    pins: PinController
    lessons: LessonsInWindow
    video: VideoPane
    options: ViewOptions
    error_reports: ErrorReports
