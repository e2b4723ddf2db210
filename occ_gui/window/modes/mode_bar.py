"""Mode bar: a tab with an icon and a word for each mode."""

from PySide6.QtCore import QSize
from PySide6.QtGui import QActionGroup, QKeySequence
from PySide6.QtWidgets import QTabBar, QWidget

from occ_gui.widgets.icons import icon
from occ_gui.widgets.plain_text import plain
from occ_gui.window.toolbar.tool_button import ICON_SIZE

_NATIVE = QKeySequence.SequenceFormat.NativeText


class ModeBar(QTabBar):
    """Shows which mode is active, and lets the user choose another one.

    Parameters
    ----------
    modes
        The menu entries of the modes; each has the name of its icon as data.
    parent
        The parent widget.
    """

    def __init__(self, modes: QActionGroup, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._actions = modes.actions()
        self.setObjectName("modes")
        self.setAccessibleName(self.tr("Mode"))
        self.setToolTip(self.tr("The task that the window is laid out for."))
        self.setDrawBase(False)
        self.setExpanding(False)
        self.setIconSize(QSize(ICON_SIZE, ICON_SIZE))
        for action in self._actions:
            place = self.addTab(plain(action.text()))
            keys = action.shortcut().toString(_NATIVE)
            self.setTabToolTip(place, f"{plain(action.text())} ({keys})\n{action.toolTip()}")
            action.toggled.connect(self._follow)
        self._follow()
        self.currentChanged.connect(self._choose)

    def _follow(self) -> None:
        """Show which mode is active."""
        for place, action in enumerate(self._actions):
            if action.isChecked() and place != self.currentIndex():
                self.blockSignals(True)
                self.setCurrentIndex(place)
                self.blockSignals(False)

    def _choose(self, place: int) -> None:
        self._actions[place].trigger()

    def draw(self) -> None:
        """Draw the icons in the present colours, for the present screen."""
        for place, action in enumerate(self._actions):
            found = icon(action.data(), self.palette(), ICON_SIZE, self.devicePixelRatioF())
            self.setTabIcon(place, found)
