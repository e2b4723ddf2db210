"""Dialogs that list the menus' entries: a palette to find one, and a sheet of all shortcuts."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QListWidget,
    QMenu,
    QMenuBar,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.parameter_rows import ParameterRow
from occ_gui.widgets.building import bring_into_view, fill, make_read_only, name_widget, paragraph
from occ_gui.widgets.plain_text import strip_mnemonics
from occ_gui.window.menus import search_words
from occ_model.scene.parameters import PARAMETERS

_NATIVE = QKeySequence.SequenceFormat.NativeText

_WIDTH, _HEIGHT = 560, 560  # first size of both dialogs in pixels

_MOVES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)
"""Keys that move the selection in the list while the text field has the focus."""


@dataclass(frozen=True, slots=True)
class Command:
    title: str
    hint: str
    run: Callable[[], object]
    words: str = ""

    def matches(self, words: Sequence[str], *, by_name: bool = False) -> bool:
        """Return whether all words occur in its title, hint or, unless by name, search words."""
        text = f"{self.title} {self.hint} {'' if by_name else self.words}".casefold()
        return all(word in text for word in words)


class CommandPalette(QDialog):
    """Lists the commands that match the typed text; Enter runs the selected one."""

    def __init__(self, commands: Sequence[Command], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Find a command")
        self._commands = commands
        self._matches: list[Command] = []
        self.chosen: Command | None = None
        field = QLineEdit(placeholderText="A few letters of a command or parameter")
        tip = "Up and Down select, Enter runs the command, Escape closes the list."
        self.line = name_widget(field, "Search words", tip)
        self.line.textChanged.connect(self._filter)
        self.line.installEventFilter(self)
        self.list = name_widget(QListWidget(), "Commands found")
        self.list.setUniformItemSizes(True)
        self.list.itemActivated.connect(self._accept_chosen)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._no_match_label = QLabel("No command has these words.")
        fill(QVBoxLayout(self), self.line, self.list, self._no_match_label)
        self.resize(_WIDTH, _HEIGHT)
        self._filter("")

    def _filter(self, text: str) -> None:
        words = text.casefold().split()
        matches = [command for command in self._commands if command.matches(words)]
        # Commands whose names contain the words come first.
        self._matches = sorted(
            matches, key=lambda command: not command.matches(words, by_name=True)
        )
        self.list.clear()
        for command in self._matches:
            hint = f"    {command.hint}" if command.hint else ""
            self.list.addItem(f"{command.title}{hint}")
        self.list.setCurrentRow(0)
        self._no_match_label.setVisible(not self._matches)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Move in the list by the arrow keys and choose by Enter while text is typed."""
        if watched is self.line and isinstance(event, QKeyEvent):
            if event.type() == QEvent.Type.KeyPress and event.key() in _MOVES:
                self.list.keyPressEvent(event)
                return True
            enter = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
            if event.type() == QEvent.Type.KeyPress and event.key() in enter:
                self._accept_chosen()
                return True
        return super().eventFilter(watched, event)

    def _accept_chosen(self) -> None:
        row = self.list.currentRow()
        if row >= 0:
            self.chosen = self._matches[row]
            self.accept()


def menu_entries(menu: QMenu | QMenuBar, path: str = "") -> Iterator[tuple[str, QAction]]:
    for action in menu.actions():
        submenu = action.menu()
        if isinstance(submenu, QMenu):
            name = strip_mnemonics(action.text())
            yield from menu_entries(submenu, f"{path} > {name}" if path else name)
        elif not action.isSeparator():
            yield path, action


def shortcuts_of(bar: QMenuBar) -> Iterator[tuple[str, str, str]]:
    """Return menu, text and keys of every entry that has a keyboard shortcut."""
    for path, action in menu_entries(bar):
        keys = ", ".join(key.toString(_NATIVE) for key in action.shortcuts())
        if keys:
            yield path, strip_mnemonics(action.text()).rstrip("…"), keys


def commands_of(
    bar: QMenuBar, controls: ControlPanel, bring_to_front: Callable[[str], None]
) -> list[Command]:
    """List the enabled menu entries, and a command for each parameter that selects its field."""
    commands = [
        Command(
            f"{path}: {strip_mnemonics(action.text())}",
            action.shortcut().toString(_NATIVE),
            action.trigger,
            f"{action.toolTip()} {search_words(action)}",
        )
        for path, action in menu_entries(bar)
        if action.isEnabled()
    ]
    commands.append(_jump_command("Scene", "light", controls.light, bring_to_front))
    for page, panel in controls.panels.items():
        for name, row in panel.rows.items():
            if not row.isHidden():  # rows for other kinds of light are hidden
                commands.append(_jump_command(page, name, row, bring_to_front))
    return commands


def _jump_command(
    page: str, name: str, row: ParameterRow, bring_to_front: Callable[[str], None]
) -> Command:
    declared = PARAMETERS[name]

    def jump() -> None:
        bring_to_front("controls")
        bring_into_view(row)
        field: QWidget = getattr(row, "field")  # noqa: B009 - each kind of row defines it
        field.setFocus()
        if isinstance(field, QAbstractSpinBox | QLineEdit):
            field.selectAll()

    symbol = f" {declared.symbol}" if declared.symbol else ""
    return Command(f"{page}: {declared.label}{symbol}", "", jump, declared.meaning)


class ShortcutSheet(QDialog):
    def __init__(self, rows: Iterable[tuple[str, str, str]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Keyboard shortcuts")
        lines = list(rows)
        self.table = make_read_only(QTableWidget(len(lines), 3), "Keyboard shortcuts")
        self.table.setHorizontalHeaderLabels(["Menu", "Does", "Keys"])
        self.table.setShowGrid(False)
        self.table.setAlternatingRowColors(True)
        for line, texts in enumerate(lines):
            for column, text in enumerate(texts):
                self.table.setItem(line, column, QTableWidgetItem(text))
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.Stretch)
        hint = paragraph(
            "Sliders: arrows and Page Up/Down. Fields: type a number with its unit, such as "
            "68us or 1/8000 s; Enter accepts it. Alt and an underlined letter open a menu."
        )
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        fill(QVBoxLayout(self), self.table, hint, buttons)
        self.resize(_WIDTH, _HEIGHT)
