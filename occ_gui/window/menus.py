"""The menus of the window; :mod:`occ_gui.app` connects their entries."""

import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QActionGroup, QKeySequence, QUndoStack
from PySide6.QtWidgets import QDockWidget, QMainWindow, QMenu

from occ_gui.values.photo_choice import MODES as OVERLAYS
from occ_gui.widgets.plain_text import LONGEST, in_menu, in_tool_tip
from occ_gui.window.full_screen import FullScreen
from occ_gui.window.modes.mode import MODES
from occ_gui.window.search_words import give_words
from occ_gui.window.theme import THEMES
from occ_model.errors import one_line
from occ_model.photo.reading.choices import SCAN_AXES

_WITH_PHOTO = (
    "close_photo", "match", "use_settings", "find_lamps", "region_by_hand", "whole_photo",
    "export_overlay",
)  # fmt: skip
"""Entries that are enabled while a photo is open."""

_WITH_MATCH = ("apply_match", "save_match")
"""Entries that are enabled while there is the result of a match."""


class Menus(QObject):
    def __init__(
        self, window: QMainWindow, undo_stack: QUndoStack, docks: Iterable[QDockWidget]
    ) -> None:
        super().__init__(window)
        self._bar = window.menuBar()
        self.actions: dict[str, QAction] = {}
        self.tops: dict[str, QMenu] = {}
        self.figures: dict[str, QAction] = {}
        self.drop_downs: dict[str, QMenu] = {}  # the menus that the toolbar opens, too
        self._make_file_menu(window)
        self._make_edit_menu(undo_stack)
        self._make_photo_menu()
        self._make_view_menu(window, docks)
        self._make_help_menu()
        self.show_photo_open(False)
        self.show_match_found(False)
        self.actions["close_film"].setEnabled(False)

    def _top(self, name: str, text: str) -> QMenu:
        self.tops[name] = self._bar.addMenu(text)
        return self.tops[name]

    def _add(
        self,
        menu: QMenu,
        name: str,
        text: str,
        shortcut: QKeySequence.StandardKey | str | None = None,
        tip: str = "",
        *,
        is_checkable: bool = False,
    ) -> QAction:
        action = menu.addAction(text)
        if shortcut is not None:
            action.setShortcut(QKeySequence(shortcut))
        if tip:
            action.setToolTip(tip)
        action.setCheckable(is_checkable)
        self.actions[name] = action
        give_words(name, action)
        return action

    def _make_file_menu(self, window: QMainWindow) -> None:
        keys = QKeySequence.StandardKey
        menu = self._top("file", "&File")
        self._add(menu, "open_photo", "Open &photos…", keys.Open)
        self.recent = menu.addMenu("Open &recent")
        self.samples = menu.addMenu("Open sa&mple photo")
        for submenu in (self.recent, self.samples):
            submenu.setToolTipsVisible(True)
            submenu.setEnabled(False)
        self._add(menu, "close_photo", "&Close photo")
        self._add(menu, "open_film", "Open &film…", "Ctrl+Alt+O")
        self._add(menu, "close_film", "C&lose film")
        menu.addSeparator()
        self._add(menu, "open_scene", "Open sc&ene…", "Ctrl+Shift+O")
        self._add(menu, "save_scene", "&Save scene", keys.Save)
        self._add(menu, "save_scene_as", "Save scene &as…", "Ctrl+Shift+S")
        self._add(menu, "save_picture", "Save simulated p&icture as…")
        menu.addSeparator()
        self._make_export_menu(menu)
        self._add(menu, "transmitter", "&Transmitter…")
        menu.addSeparator()
        self._add(menu, "quit", "&Quit", "Ctrl+Q").triggered.connect(window.close)

    def _make_export_menu(self, file: QMenu) -> None:
        self._export = self.drop_downs["export"] = file.addMenu("E&xport")
        self._export.setToolTipsVisible(True)
        self._after_figures = self._export.addSeparator()
        self._add(self._export, "export_all", "A&ll figures…", "Ctrl+Shift+E")

    def add_figures(self, titles: Mapping[str, str], ask: Callable[[str], None]) -> None:
        for name, title in titles.items():
            action = QAction(f"{title}…", self._export)
            action.setToolTip("As PNG, SVG, PDF or CSV, with the scene inside.")
            self._export.insertAction(self._after_figures, action)
            self.figures[name] = self.actions[f"export_{name}"] = action
            action.setEnabled(f"export_{name}" not in _WITH_PHOTO)
            action.triggered.connect(lambda _=False, name=name: ask(name))
            give_words(f"export_{name}", action)

    def add_animations(self, labels: Mapping[str, str], ask: Callable[[str], None]) -> None:
        """Offer an animation of each of these sliders in the export menu."""
        menu = QMenu("A&nimation of a slider", self._export)
        self._export.insertMenu(self._after_figures, menu)
        menu.setToolTipsVisible(True)
        for name, label in labels.items():
            action = menu.addAction(f"{in_menu(label)}…")
            action.setToolTip("The slider's run from end to end, as GIF, MP4 or PNG.")
            action.triggered.connect(lambda _=False, name=name: ask(name))
            give_words("animation", action)

    def _make_edit_menu(self, undo_stack: QUndoStack) -> None:
        menu = self._top("edit", "&Edit")
        undo = undo_stack.createUndoAction(self, "&Undo")
        redo = undo_stack.createRedoAction(self, "&Redo")
        undo.setShortcut(QKeySequence(QKeySequence.StandardKey.Undo))
        redo.setShortcut(QKeySequence(QKeySequence.StandardKey.Redo))
        menu.addActions([undo, redo])
        self.actions |= {"undo": undo, "redo": redo}
        self._make_pin_menu(menu)
        menu.addSeparator()
        self._add(menu, "copy_figure", "Copy fi&gure", "Ctrl+Shift+C")
        menu.addSeparator()
        tip = "While on, the ISO speed moves against the exposure time."
        self._add(menu, "hold_brightness", "&Hold brightness", "Ctrl+B", tip, is_checkable=True)
        self._add(menu, "reset_scene", "Reset &scene")

    def _make_pin_menu(self, edit: QMenu) -> None:
        menu = edit.addMenu("Pi&n and compare")
        self._add(menu, "pin_a", "Pin as &A", "Ctrl+Shift+A")
        self._add(menu, "pin_b", "Pin as &B", "Ctrl+Shift+B")
        self._add(menu, "go_to_a", "Take me &to A")
        self._add(menu, "go_to_b", "Take me t&o B")
        self._add(menu, "clear_pins", "C&lear both")

    def _make_photo_menu(self) -> None:
        menu = self._top("photo", "&Photo")
        self._add(menu, "match", "&Match photo", "Ctrl+M")
        self._add(menu, "match_all", "Ma&tch all photos")
        self._add(menu, "find_lamps", "&Find lamps")
        self._add(menu, "region_by_hand", "&Region by hand")
        self._add(menu, "whole_photo", "&Whole photo")
        self._add(menu, "apply_match", "&Apply to the scene", "Ctrl+Shift+M")
        self._add(menu, "save_match", "Save match as &preset…")
        self._add(menu, "delete_preset", "D&elete preset…")
        self._add(menu, "use_settings", "&Use this photo's settings")
        menu.addSeparator()
        words = {
            "beside": "&Side by side",
            "blend": "&Blended over the simulation",
            "split": "Sp&lit along a line",
            "difference": "&Difference",
        }
        self.overlays = QActionGroup(self)
        for place, mode in enumerate(OVERLAYS, 1):
            action = self._add_choice(menu, self.overlays, f"show_{mode}", words[mode], mode)
            action.setShortcut(QKeySequence(f"Ctrl+Alt+{place}"))
        menu.addSeparator()
        axes = menu.addMenu("Photo was s&canned")
        words = {
            "auto": "&Automatic: across its stripes",
            "columns": "Column by &column",
            "lines": "&Line by line",
        }
        self.scan_axes = QActionGroup(self)
        for axis in SCAN_AXES:
            self._add_choice(axes, self.scan_axes, f"scan_{axis}", words[axis], axis)

    def _make_mode_menu(self, view: QMenu) -> None:
        menu = view.addMenu("&Mode")
        menu.setToolTipsVisible(True)
        texts = {
            "explore": ("&Explore", "From the LED's light to the bits."),
            "photo": ("&Photo", "Explain a photo of your own."),
            "limits": ("&Limits", "How fast the code can be, and still be read."),
            "effects": ("E&ffects", "What accuracy costs in time."),
            "lessons": ("Le&ssons", "Learn step by step."),
            "video": ("&Video", "Read films, and what a camera sees."),
            "room": ("&Room", "Many lamps in one picture: where am I?"),
        }
        self.modes = QActionGroup(self)
        for place, name in enumerate(MODES, 1):
            text, meaning = texts[name]
            action = self._add_choice(menu, self.modes, f"mode_{name}", text, name)
            action.setShortcut(QKeySequence(f"Ctrl+{place}"))
            action.setToolTip(meaning)

    def _make_view_menu(self, window: QMainWindow, docks: Iterable[QDockWidget]) -> None:
        menu = self._view = self._top("view", "&View")
        self._make_mode_menu(menu)
        self._add(menu, "fit", "&Fit pictures", "Ctrl+0")
        tip = "Show the picture before the latest change beside the one now."
        self._add(menu, "before", "&Before the change", "Ctrl+Alt+Z", tip, is_checkable=True)
        tip = "Two cursors, 1 and 2, that you drag over the rows."
        self._add(menu, "measure", "Meas&ure", "Ctrl+Shift+D", tip, is_checkable=True)
        theme = self.drop_downs["theme"] = menu.addMenu("&Theme")
        self.themes = QActionGroup(self)
        for key in THEMES:
            self._add_choice(theme, self.themes, f"theme_{key}", f"&{key.capitalize()}", key)
        keys = QKeySequence.StandardKey
        tip = "As for a projector: all text of the window."
        self._add(menu, "text_larger", "Lar&ger text", keys.ZoomIn, tip)
        self._add(menu, "text_smaller", "Smaller te&xt", keys.ZoomOut)
        self._add(menu, "text_normal", "&Normal text size", "Ctrl+Alt+0")
        tip = "The window as large as the screen, as for a projector."
        FullScreen(window, self._add(menu, "full_screen", "Fu&ll screen", "F11", tip))
        self._add(menu, "reset_layout", "&Reset layout")
        tip = "The fraction of bits that the decoder reads along each slider."
        self._add(menu, "slider_strips", "&Slider strips", tip=tip, is_checkable=True)
        menu.addSeparator()
        for dock in docks:
            self.add_dock(dock)

    def add_dock(self, dock: QDockWidget) -> None:
        self._view.addAction(dock.toggleViewAction())

    def _make_help_menu(self) -> None:
        menu = self._top("help", "&Help")
        self._add(menu, "guide", "&User's guide")
        self._add(menu, "about_pane", "About this &pane", "Shift+F1")
        self._add(menu, "welcome", "&Welcome…")
        self._add(menu, "lessons", "&Lessons")
        self._add(menu, "report", "&Report…")
        self._add(menu, "about", "&About")
        self._add(menu, "shortcuts", "&Keyboard shortcuts…", "F1")
        self._add(menu, "palette", "Find a &command…", "Ctrl+Shift+P")

    def _add_choice(
        self, menu: QMenu, group: QActionGroup, name: str, text: str, key: str
    ) -> QAction:
        action = self._add(menu, name, text, is_checkable=True)
        action.setChecked(not group.actions())
        action.setData(key)
        group.addAction(action)
        return action

    def show_choice(self, group: QActionGroup, key: str) -> None:
        """Check the entry of a group that stands for a key, without triggering it."""
        for action in group.actions():
            if action.data() == key:
                action.setChecked(True)

    def show_photo_open(self, is_open: bool) -> None:
        for name in _WITH_PHOTO:
            if name not in self.actions:  # a figure, which is added later
                continue
            self.actions[name].setEnabled(is_open)

    def show_match_found(self, is_found: bool) -> None:
        """Enable the entries that need the result of a match while there is one."""
        for name in _WITH_MATCH:
            self.actions[name].setEnabled(is_found)

    def show_recent(
        self, files: Iterable[Path], open_file: Callable[[Path], None], clear: Callable[[], None]
    ) -> None:
        self.recent.clear()
        for path in files:
            _add_file(self.recent, path, path.name, open_file)
        self.recent.setEnabled(not self.recent.isEmpty())
        if not self.recent.isEmpty():
            self.recent.addSeparator()
            self.recent.addAction("&Clear this list").triggered.connect(clear)

    def show_samples(self, files: Iterable[Path], open_file: Callable[[Path], None]) -> None:
        self.samples.clear()
        for path in files:
            text = f"{words_of(path.stem)} (simulated)"
            _add_file(self.samples, path, text, open_file)
        self.samples.setEnabled(not self.samples.isEmpty())


def words_of(name: str) -> str:
    """Write a file's name in words: ``led-1khz`` as LED 1 kHz."""
    words = re.sub(r"(\d)(k?)hz\b", r"\1 \2Hz", name.replace("-", " "))
    words = re.sub(r"\bled\b", "LED", words)
    return words[:1].upper() + words[1:]


def _add_file(menu: QMenu, path: Path, text: str, open_file: Callable[[Path], None]) -> None:
    action = menu.addAction(in_menu(text))
    action.setToolTip(in_tool_tip(one_line(str(path), LONGEST)))
    action.triggered.connect(lambda: open_file(path))
