"""A line that finds any command or parameter by a few letters of it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialog, QLabel, QLineEdit, QListWidget, QVBoxLayout, QWidget

_WIDTH, _HEIGHT = 520, 380

_MOVES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)
"""Keys that move in the list while the line has the focus."""


@dataclass(frozen=True, slots=True)
class Command:
    """Something that can be found and done.

    Parameters
    ----------
    title
        What it is.
    hint
        The keys that do it, too, or what it is now.
    run
        Does it.
    """

    title: str
    hint: str
    run: Callable[[], object]

    def suits(self, words: Sequence[str]) -> bool:
        """Say whether all words occur in it."""
        text = f"{self.title} {self.hint}".casefold()
        return all(word in text for word in words)


class CommandPalette(QDialog):
    """Lists the commands that suit what is typed; Enter does the chosen one.

    Parameters
    ----------
    commands
        All commands.
    parent
        The window.
    """

    def __init__(self, commands: Sequence[Command], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Find a command"))
        self._commands = commands
        self._suiting: list[Command] = []
        self._chosen: Command | None = None
        self.line = QLineEdit()
        self.line.setPlaceholderText(self.tr("A few letters of a command or parameter"))
        self.line.setAccessibleName(self.tr("Words to look for"))
        self.line.setToolTip(self.tr("Up and down choose, Enter does it, Escape leaves."))
        self.line.textChanged.connect(self._filter)
        self.line.installEventFilter(self)
        self.list = QListWidget()
        self.list.setAccessibleName(self.tr("Commands found"))
        self.list.setUniformItemSizes(True)
        self.list.itemActivated.connect(self._accept_chosen)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._nothing = QLabel(self.tr("Nothing by these words."))
        layout = QVBoxLayout(self)
        for widget in (self.line, self.list, self._nothing):
            layout.addWidget(widget)
        self.resize(_WIDTH, _HEIGHT)
        self._filter("")

    def _filter(self, text: str) -> None:
        words = text.casefold().split()
        self._suiting = [command for command in self._commands if command.suits(words)]
        self.list.clear()
        for command in self._suiting:
            hint = f"    {command.hint}" if command.hint else ""
            self.list.addItem(f"{command.title}{hint}")
        self.list.setCurrentRow(0)
        self._nothing.setVisible(not self._suiting)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Let the arrows move in the list, and Enter choose, while the line is typed in."""
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
        if 0 <= row < len(self._suiting):
            self._chosen = self._suiting[row]
            self.accept()

    @property
    def chosen(self) -> Command | None:
        """The command that was chosen, if any."""
        return self._chosen
