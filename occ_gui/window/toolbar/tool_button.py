"""Tool button: a menu entry, or a whole menu, as an icon."""

from PySide6.QtCore import QSize
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu, QToolButton
from shiboken6 import isValid

from occ_gui.widgets.icons import icon
from occ_gui.widgets.plain_text import in_tool_tip, plain

ICON_SIZE = 20

_NATIVE = QKeySequence.SequenceFormat.NativeText


class ToolButton(QToolButton):
    """Carries out an action, or opens a menu; it is named, enabled and checked as the action is."""

    def __init__(self, drawing: str, action: QAction) -> None:
        super().__init__()
        self._drawing, self.shown = drawing, action
        self.setAutoRaise(True)
        self.setIconSize(QSize(ICON_SIZE, ICON_SIZE))
        menu = action.menu()
        if isinstance(menu, QMenu):
            self.setMenu(menu)
            self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        else:
            self.clicked.connect(action.trigger)
        action.changed.connect(self._follow)
        self._follow()

    def draw(self) -> None:
        found = icon(self._drawing, self.palette(), ICON_SIZE, self.devicePixelRatioF())
        self.setIcon(found)

    def _follow(self) -> None:
        action = self.shown
        if not isValid(action):  # Qt tells of changes while it deletes the window
            return
        name = plain(action.text()).rstrip("…")
        keys = action.shortcut().toString(_NATIVE)
        self.setAccessibleName(name)
        text = f"{name} ({keys})" if keys else name
        meaning = action.toolTip()
        if meaning != name:  # where none is given, Qt takes the name
            text = f"{text}\n{meaning}"
        self.setToolTip(in_tool_tip(text))
        self.setStatusTip("")
        self.setEnabled(action.isEnabled())
        self.setCheckable(action.isCheckable())
        self.setChecked(action.isChecked())
