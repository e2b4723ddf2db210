"""The menus of the window; :mod:`occ_gui.app` connects their entries."""

import re
from collections.abc import Callable, Container, Iterable, Mapping
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence, QUndoStack
from PySide6.QtWidgets import QDockWidget, QMainWindow, QMenu

from occ_gui.values.choices import OVERLAYS, THEMES
from occ_gui.values.modes import MODES
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_menu, in_tool_tip
from occ_gui.window import menu_entries as entries
from occ_gui.window.menu_entries import Entry
from occ_model.errors import capitalize, one_line
from occ_model.photo.reading.choices import SCAN_AXES

_SEARCH_WORDS = "search_words"  # name of an action's property


class Menus(QObject):
    def __init__(
        self, window: QMainWindow, undo_stack: QUndoStack, docks: Iterable[QDockWidget]
    ) -> None:
        super().__init__(window)
        self._bar = window.menuBar()
        self.actions: dict[str, QAction] = {}
        self.top_menus: dict[str, QMenu] = {}
        self.figures: dict[str, QAction] = {}
        self._animations: dict[str, QAction] = {}
        self.drop_downs: dict[str, QMenu] = {}  # the menus that the toolbar opens, too
        self._make_file_menu(window)
        self._make_edit_menu(undo_stack)
        self._make_photo_menu()
        self._make_view_menu(window, docks)
        self._fill(self._add_menu("help", "&Help"), *entries.HELP)

    def _add_menu(self, name: str, text: str) -> QMenu:
        self.top_menus[name] = self._bar.addMenu(text)
        return self.top_menus[name]

    def _fill(self, menu: QMenu, *entries: Entry | None) -> None:
        for entry in entries:
            if entry is None:
                menu.addSeparator()
                continue
            action = self.actions[entry.name] = menu.addAction(entry.text)
            if entry.keys:
                action.setShortcut(QKeySequence(entry.keys))
            if entry.tip:
                action.setToolTip(entry.tip)
            action.setCheckable(entry.is_checkable)
            action.setProperty(_SEARCH_WORDS, entry.words)

    def _add_choice(
        self,
        menu: QMenu,
        prefix: str,
        names: Iterable[str],
        entries: Mapping[str, tuple[str, str, str]],
        keys: str = "",
    ) -> QActionGroup:
        """Add exclusive entries in the order of ``names``.

        ``entries``: text, tip and search words of each. ``keys``: their shortcuts, with braces for
        the number of an entry, which counts from 1.
        """
        group = QActionGroup(self)
        for place, name in enumerate(names, 1):
            text, tip, words = entries[name]
            entry = f"{prefix}_{name}"
            self._fill(menu, Entry(entry, text, keys.format(place), tip, words, is_checkable=True))
            action = self.actions[entry]
            action.setChecked(place == 1)
            action.setData(name)
            group.addAction(action)
        return group

    def _make_file_menu(self, window: QMainWindow) -> None:
        menu = self._add_menu("file", "&File")
        self._fill(menu, entries.OPEN_PHOTO)
        self.recent = menu.addMenu("Open &recent")
        self.samples = menu.addMenu("Open sa&mple photo")
        for submenu in (self.recent, self.samples):
            submenu.setToolTipsVisible(True)
            submenu.setEnabled(False)
        self._fill(menu, *entries.FILE)
        self._export = self.drop_downs["export"] = menu.addMenu("E&xport")
        self._export.setToolTipsVisible(True)
        self._after_figures = self._export.addSeparator()
        self._fill(self._export, entries.EXPORT_ALL)
        self._fill(menu, *entries.TRANSMITTER_AND_QUIT)
        self.actions["quit"].triggered.connect(window.close)

    def add_figures(self, titles: Mapping[str, str], ask: Callable[[str], None]) -> None:
        for name, title in titles.items():
            action = QAction(f"{title}…", self._export)
            action.setToolTip("As PNG, SVG, PDF or CSV, with the scene inside.")
            self._export.insertAction(self._after_figures, action)
            self.figures[name] = self.actions[f"export_{name}"] = action
            action.triggered.connect(lambda _=False, name=name: ask(name))
            action.setProperty(_SEARCH_WORDS, entries.FIGURE)

    def add_animations(self, labels: Mapping[str, str], ask: Callable[[str], None]) -> None:
        """Offer an animation of each of these sliders in the export menu."""
        menu = QMenu("A&nimation of a slider", self._export)
        self._export.insertMenu(self._after_figures, menu)
        menu.setToolTipsVisible(True)
        words = "gif mp4 film video movie play run slider save export"
        for name, label in labels.items():
            action = menu.addAction(f"{in_menu(label)}…")
            action.setToolTip("The picture while the slider moves, as GIF, MP4 or PNG.")
            action.triggered.connect(lambda _=False, name=name: ask(name))
            action.setProperty(_SEARCH_WORDS, words)
            self._animations[name] = action

    def show_animations(self, names: Container[str]) -> None:
        """Offer only the sliders of the scene's light."""
        for name, action in self._animations.items():
            action.setVisible(name in names)

    def _make_edit_menu(self, undo_stack: QUndoStack) -> None:
        menu = self._add_menu("edit", "&Edit")
        undo = undo_stack.createUndoAction(self, "&Undo")
        redo = undo_stack.createRedoAction(self, "&Redo")
        undo.setShortcut(QKeySequence(QKeySequence.StandardKey.Undo))
        redo_keys = QKeySequence.keyBindings(QKeySequence.StandardKey.Redo)
        keys = (*redo_keys, QKeySequence("Ctrl+Y"))  # on every system
        redo.setShortcuts(list({key.toString(): key for key in keys}.values()))
        menu.addActions([undo, redo])
        self.actions |= {"undo": undo, "redo": redo}
        self._fill(menu.addMenu("Pi&n and compare"), *entries.PINS)
        self._fill(menu, *entries.EDIT)

    def _make_photo_menu(self) -> None:
        menu = self._add_menu("photo", "&Photo")
        menu.addAction(self.actions["open_photo"])  # as in the file menu
        self._fill(menu, *entries.PHOTO)
        overlays = entries.OVERLAY_TEXTS
        self.overlays = self._add_choice(menu, "show", OVERLAYS, overlays, "Ctrl+Alt+{}")
        menu.addSeparator()
        axes = menu.addMenu("S&can direction of the photo")
        self.scan_axes = self._add_choice(axes, "scan", SCAN_AXES, entries.SCAN_AXIS_TEXTS)

    def _make_view_menu(self, window: QMainWindow, docks: Iterable[QDockWidget]) -> None:
        menu = self._view = self._add_menu("view", "&View")
        modes = menu.addMenu("&Mode")
        modes.setToolTipsVisible(True)
        self.modes = self._add_choice(modes, "mode", MODES, entries.MODE_TEXTS, "Ctrl+{}")
        self._fill(menu, *entries.LOOK)
        theme = self.drop_downs["theme"] = menu.addMenu("&Theme")
        self.themes = self._add_choice(theme, "theme", THEMES, entries.THEME_TEXTS)
        self._fill(menu, *entries.SIZES)
        FullScreen(window, self.actions["full_screen"])
        for dock in docks:
            self.add_dock(dock)

    def add_dock(self, dock: QDockWidget) -> None:
        self._view.addAction(dock.toggleViewAction())

    def show_choice(self, group: QActionGroup, key: str) -> None:
        """Check the entry of a key in a group, without triggering it."""
        for action in group.actions():
            if action.data() == key:
                action.setChecked(True)

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


def search_words(action: QAction) -> str:
    """Return the search words of an entry beyond its text."""
    return str(action.property(_SEARCH_WORDS) or "")


def words_of(name: str) -> str:
    """Write a file's name in words: ``led-1khz`` as LED 1 kHz."""
    words = re.sub(r"(\d)(k?)hz\b", r"\1 \2Hz", name.replace("-", " "))
    return capitalize(re.sub(r"\bled\b", "LED", words))


def _add_file(menu: QMenu, path: Path, text: str, open_file: Callable[[Path], None]) -> None:
    action = menu.addAction(in_menu(text))
    action.setToolTip(in_tool_tip(one_line(str(path), LONGEST_TEXT)))
    action.triggered.connect(lambda: open_file(path))


class FullScreen(QObject):
    """Keeps the menu entry and the window's state in step, whichever changes."""

    def __init__(self, window: QMainWindow, action: QAction) -> None:
        super().__init__(window)
        self._window, self._action = window, action
        action.toggled.connect(self._show)
        window.installEventFilter(self)

    def _show(self, full: bool) -> None:
        # Only this bit of the state, so that a maximized window is maximized again afterwards.
        state = self._window.windowState()
        flag = Qt.WindowState.WindowFullScreen
        self._window.setWindowState(state | flag if full else state & ~flag)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if watched is self._window and event.type() == QEvent.Type.WindowStateChange:
            self._action.setChecked(self._window.isFullScreen())
        return False
