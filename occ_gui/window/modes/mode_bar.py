"""Mode bar: a tab with an icon and a word for each mode."""

from PySide6.QtCore import QSignalBlocker, QSize
from PySide6.QtGui import QActionGroup, QIcon, QKeySequence, QResizeEvent
from PySide6.QtWidgets import QTabBar

from occ_gui.widgets.icons import icon
from occ_gui.widgets.plain_text import plain
from occ_gui.window.toolbar.tool_button import ICON_SIZE

_NATIVE = QKeySequence.SequenceFormat.NativeText


class ModeBar(QTabBar):
    """Shows which mode is active, and lets the user choose another one.

    ``modes``: the menu entries of the modes; each has the name of its icon as data.
    """

    def __init__(self, modes: QActionGroup) -> None:
        super().__init__()
        self._actions = modes.actions()
        self._icons: list[QIcon] = []
        self._has_icons, self._whole = False, 0
        self.setObjectName("modes")
        self.setAccessibleName("Mode")
        self.setToolTip("The task that the window is laid out for.")
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
        for place, action in enumerate(self._actions):
            if action.isChecked() and place != self.currentIndex():
                with QSignalBlocker(self):
                    self.setCurrentIndex(place)

    def _choose(self, place: int) -> None:
        self._actions[place].trigger()

    def draw(self) -> None:
        ratio = self.devicePixelRatioF()
        self._icons = [icon(a.data(), self.palette(), ICON_SIZE, ratio) for a in self._actions]
        self._show_icons(True)
        self._whole = super().sizeHint().width()
        self.updateGeometry()
        self._fit()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        hint = super().sizeHint()
        return QSize(max(hint.width(), self._whole), hint.height())

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        has_room = self.width() >= self._whole
        if self._icons and has_room != self._has_icons:
            self._show_icons(has_room)

    def _show_icons(self, shown: bool) -> None:
        self._has_icons = shown
        for place, found in enumerate(self._icons):
            self.setTabIcon(place, found if shown else QIcon())
