"""Desktop features of the window: export, session, layout, theme, command palette, shortcuts."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction

from occ_gui.app.error_reports import ErrorReports
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.video_pane import VideoPane
from occ_gui.export.animation import AnimationExport
from occ_gui.export.export_controller import ExportController
from occ_gui.files.autosave import Autosave
from occ_gui.files.document import Document
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.files.preset_controller import PresetController
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Session
from occ_gui.help.help_menu import HelpMenu
from occ_gui.help.pages import PAGE_OF_PANE
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.pins.pin_controller import PinController
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.values.placement import MODES
from occ_gui.window.command_palette import CommandPalette, commands_of, shortcuts_of
from occ_gui.window.current_pane import CurrentPane
from occ_gui.window.dock_layout import DockLayout
from occ_gui.window.main_window import MainWindow
from occ_gui.window.shortcut_sheet import ShortcutSheet
from occ_gui.window.text_size import TextSize
from occ_gui.window.theme import ThemeController
from occ_model.photo.reading.load import Photo
from occ_model.results.frame import PICTURES
from occ_model.scene.from_text import DEFAULT_PRESET
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import load_preset

if TYPE_CHECKING:
    from occ_gui.transmitter.transmitter_controller import TransmitterController

_THEME, _OVERLAY, _PICTURE = "view/theme", "view/overlay", "view/picture"
_TEXT = "view/text_percent"
_HOLD, _YES = "edit/hold_brightness", "yes"


class Parts(Protocol):
    """The parts of the application that the desktop features use."""

    window: MainWindow
    store: SceneStore
    editor: SceneEditor
    settings: SettingsStore
    preferences: Preferences
    presets: PresetController
    files: FileController
    photos: PhotoController
    frame_rate: FrameRate
    lessons: LessonsInWindow
    pins: PinController
    shell: Shell
    video: VideoPane
    simulation: SimulationController
    present: PresentResults
    controls: ControlPanel


class Desktop(QObject):
    """The controllers of the desktop features, connected with the menus.

    Parameters
    ----------
    parts
        The application's parts.
    """

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._parts = parts
        window, preferences = parts.window, parts.preferences
        figures = parts.shell.figures.values()
        window.menus.add_figures({figure.name: figure.title for figure in figures})
        pane = CurrentPane(window, window.docks)
        self.export = ExportController(
            window, parts.shell, parts.present, preferences, pane, self._decoder
        )
        self.export.connect_actions(window.menus.figures)
        self.animation = AnimationExport(
            window, parts.store, parts.settings, preferences, window.filming
        )
        sliders = {name: PARAMETERS[name].label for name in parts.controls.main_rows()}
        window.menus.add_animations(sliders, self.animation.ask)
        pages = {**PAGE_OF_PANE, **parts.shell.help_pages}
        self.help = HelpMenu(window, window.menus.tops["help"], lambda: pane.name, pages)
        self.document = Document(window, parts.store, parts.files)
        self.brightness = parts.editor.brightness
        self.theme = ThemeController()
        self.text_size = TextSize()
        window.dress()
        self.layout = DockLayout(window, window.modes, preferences)
        self.autosave = Autosave(parts.store, self.document, self.session)
        parts.pins.changed.connect(self.autosave.note_change)
        self.error_reports = ErrorReports()
        parts.shell.made.connect(self._on_made)
        self.transmitter: TransmitterController | None = None
        self._connect()

    def _connect(self) -> None:
        parts, window = self._parts, self._parts.window
        whose = parts.store.store.select(lambda workspace: workspace.whose)
        for taker in (parts.simulation, parts.files):
            whose.changed.connect(taker.choose_picture)
        parts.photos.opened.connect(self._on_photo)
        for source in (
            self.export,
            self.animation.writer,
            self.brightness,
            self.autosave,
            self.help,
        ):
            source.status_message.connect(window.say)
        self.error_reports.reported.connect(window.say)
        window.closing.connect(self.end)
        self.theme.chosen.connect(self._on_theme)
        self.theme.coloured.connect(window.dress)
        self.text_size.chosen.connect(self._on_text_size)
        actions = window.actions_by_name
        self.brightness.switched.connect(self._on_hold)
        parts.controls.player.film_asked.connect(self.animation.ask)
        window.menus.themes.triggered.connect(self._choose_theme)
        for name, slot in {
            "report": self._show_report,
            "save_scene": self.document.save,
            "save_scene_as": parts.files.ask_to_save_scene,
            "export_all": self.export.ask_for_folder,
            "transmitter": self.show_transmitter,
            "copy_figure": self.export.copy_current,
            "reset_scene": self._reset_scene,
            "reset_layout": window.modes.reset,
            "shortcuts": self.show_shortcuts,
            "palette": self.show_palette,
            "text_larger": self.text_size.larger,
            "text_smaller": self.text_size.smaller,
            "text_normal": self.text_size.normal,
        }.items():
            actions[name].triggered.connect(slot)
        actions["before"].toggled.connect(self._show_before)
        actions["hold_brightness"].triggered.connect(self.brightness.switch)

    def _on_made(self, name: str, pane: Any) -> None:
        """Connect a pane that has been made with what the whole window has."""
        window = self._parts.window
        if name == "picture":
            from occ_gui.window.cursor_readout import follow_pictures

            follow_pictures(pane.view, window.pointed.set_full_text)
            before = pane.view.before.chosen
            before.setChecked(window.actions_by_name["before"].isChecked())
            before.toggled.connect(window.actions_by_name["before"].setChecked)
        elif name == "profile":
            from occ_gui.window.cursor_readout import follow_profile

            follow_profile(pane.view, window.pointed.set_full_text)

    def _show_before(self, shown: bool) -> None:
        self._parts.shell.pane("picture").view.before.chosen.setChecked(shown)

    def _decoder(self) -> str:
        return self._parts.store.store.workspace.decoder

    def _show_report(self) -> None:
        # Asked for rarely; importing it would take a part of the start.
        from occ_gui.app.report import report_text, show_report

        parts = self._parts
        text = report_text(
            parts.store.scene, parts.settings.settings, self.error_reports.last.lines
        )
        show_report(parts.window, text)

    def show_transmitter(self) -> None:
        """Show what a board needs to blink the scene."""
        # Asked for rarely, as the report is.
        from occ_gui.transmitter.transmitter_controller import TransmitterController

        parts = self._parts
        if self.transmitter is None:
            self.transmitter = TransmitterController(parts.window, parts.store, parts.preferences)
            self.transmitter.status_message.connect(parts.window.say)
        self.transmitter.show()

    @property
    def is_idle(self) -> bool:
        """Whether all requested figures have been written."""
        return (
            self.export.is_idle
            and self.animation.writer.is_idle
            and (self.transmitter is None or self.transmitter.is_idle)
        )

    def session(self) -> Session:
        """Return what the user is working on; what a lesson shows in its place is not kept."""
        parts = self._parts
        own = parts.lessons.users_own() or parts.store.store.workspace
        return Session(
            scene=own.scene,
            settings=own.settings,
            scene_file=self.document.path,
            photo=own.photo,
            film=own.film,
            preset=parts.presets.base_of(own.scene),
            pins=parts.pins.kept,
            history=parts.store.store.history(own.step),
        )

    def resume(self, file: SessionFile, session: Session, scene_wins: bool, fresh: bool) -> None:
        """Restore the last session before the window is shown, and store this one.

        Parameters
        ----------
        file
            The file of this window's session, which also contains that of a crash.
        session
            The last session; its scene and settings are in the stores already.
        scene_wins
            Whether the command line names the scene.
        fresh
            Whether the window is to look as at its first start.
        """
        preferences = self._parts.preferences
        if not fresh:
            self.layout.restore()
            self.theme.choose(preferences.recall(_THEME))
            if (percent := preferences.recall(_TEXT)).isdecimal():
                self.text_size.choose(int(percent))
            store = self._parts.store.store
            if (mode := preferences.recall(_OVERLAY)) in MODES:
                store.put(replace(store.workspace, overlay=mode))
            if (whose := preferences.recall(_PICTURE)) in PICTURES:
                store.put(replace(store.workspace, whose=whose))
            self.brightness.switch(preferences.recall(_HOLD) == _YES)
            left = file.crashed or session
            self._parts.pins.restore(left.pins)
            if left.scene is not None:
                self._parts.presets.resume(left.scene, left.preset)
        self.autosave.resume(file, session, scene_wins)
        self.autosave.written.connect(self._keep_view)

    def _on_photo(self, photo: Photo | None) -> None:
        self.document.show_photo(None if photo is None else photo.path.name)

    def _choose_theme(self, action: QAction) -> None:
        self.theme.choose(action.data())

    def _on_theme(self, theme: str) -> None:
        self._parts.preferences.keep(_THEME, theme)
        menus = self._parts.window.menus
        menus.show_choice(menus.themes, theme)

    def _on_text_size(self, percent: int) -> None:
        self._parts.preferences.keep(_TEXT, str(percent))
        self._parts.window.say(f"Text at {percent} %")

    def _on_hold(self, on: bool) -> None:
        self._parts.preferences.keep(_HOLD, _YES if on else "")
        self._parts.window.actions_by_name["hold_brightness"].setChecked(on)

    def _reset_scene(self) -> None:
        scene = load_preset(DEFAULT_PRESET)
        self._parts.store.put(scene, "reset of the scene", force={})

    def show_shortcuts(self) -> None:
        """Show the table of keyboard shortcuts."""
        sheet = ShortcutSheet(shortcuts_of(self._parts.window.menuBar()), self._parts.window)
        sheet.exec()
        sheet.deleteLater()

    def show_palette(self) -> None:
        """Show the command palette, and carry out the chosen command."""
        window = self._parts.window
        found = commands_of(window.menuBar(), self._parts.controls, window.bring_to_front)
        palette = CommandPalette(found, window)
        chosen = palette.chosen if palette.exec() else None
        palette.deleteLater()
        if chosen is not None:
            chosen.run()

    def _keep_view(self) -> None:
        """Store how the window looks, unless a lesson has its own panes in it."""
        if self._parts.lessons.users_own() is None:
            self.layout.keep()
            workspace = self._parts.store.store.workspace
            self._parts.preferences.keep(_OVERLAY, workspace.overlay)
            self._parts.preferences.keep(_PICTURE, workspace.whose)

    def end(self) -> None:
        """Store layout, options and session for the next start."""
        self.autosave.end()

    def stop(self) -> None:
        """Stop all work in the background."""
        self.export.stop()
        self.animation.writer.stop()
        if self.transmitter is not None:
            self.transmitter.stop()
        self.error_reports.remove()
