"""Toolbar: a tab for each mode, and icons of menu entries in the order of their use."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QSignalBlocker, QSize, QTimer
from PySide6.QtGui import QAction, QActionGroup, QIcon, QKeySequence, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QTabBar, QToolBar, QToolButton, QWidget
from shiboken6 import isValid

from occ_gui.widgets.icons import icon
from occ_gui.widgets.plain_text import in_tool_tip, strip_mnemonics

ICON_SIZE = 20

_NATIVE = QKeySequence.SequenceFormat.NativeText


class ToolButton(QToolButton):
    """Triggers an action or opens a menu; has the action's name, tooltip and state."""

    def __init__(self, drawing: str, action: QAction) -> None:
        super().__init__()
        self._drawing, self.source = drawing, action
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
        ratio = self.devicePixelRatioF()
        self.setIcon(icon(self._drawing, self.palette(), ICON_SIZE, ratio))

    def _follow(self) -> None:
        action = self.source
        if not isValid(action):  # Qt reports changes while it deletes the window
            return
        name = strip_mnemonics(action.text()).rstrip("…")
        keys = action.shortcut().toString(_NATIVE)
        self.setAccessibleName(name)
        text = f"{name} ({keys})" if keys else name
        meaning = action.toolTip()
        if meaning != name:  # Qt returns the name if there is no tooltip
            text = f"{text}\n{meaning}"
        self.setToolTip(in_tool_tip(text))
        self.setEnabled(action.isEnabled())
        self.setCheckable(action.isCheckable())
        self.setChecked(action.isChecked())


class ModeBar(QTabBar):
    """Shows which mode is active, and lets the user choose another one.

    ``modes``: the menu entries of the modes; each has the name of its icon as data.
    """

    def __init__(self, modes: QActionGroup) -> None:
        super().__init__()
        self._actions = modes.actions()
        self._icons: list[QIcon] = []
        self._has_icons, self._full_width = False, 0
        self.setObjectName("modes")
        self.setAccessibleName("Mode")
        self.setToolTip("Choose a task: the window shows what belongs to it.")
        self.setDrawBase(False)
        self.setExpanding(False)
        self.setIconSize(QSize(ICON_SIZE, ICON_SIZE))
        for action in self._actions:
            place = self.addTab(strip_mnemonics(action.text()))
            keys = action.shortcut().toString(_NATIVE)
            self.setTabToolTip(
                place, f"{strip_mnemonics(action.text())} ({keys})\n{action.toolTip()}"
            )
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
        self._full_width = super().sizeHint().width()
        self.updateGeometry()
        self._fit()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        hint = super().sizeHint()
        return QSize(max(hint.width(), self._full_width), hint.height())

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        has_room = self.width() >= self._full_width
        if self._icons and has_room != self._has_icons:
            self._show_icons(has_room)

    def _show_icons(self, on: bool) -> None:
        self._has_icons = on
        for place, drawing in enumerate(self._icons):
            self.setTabIcon(place, drawing if on else QIcon())


TOOLS = (
    {"open_photo": "open", "undo": "undo", "redo": "redo"},
    {"before": "before", "pin_a": "pin-a", "pin_b": "pin-b", "measure": "measure"},
    {"fit": "fit", "export": "export", "theme": "theme"},
)
"""Names of the menu entries and menus in groups, each with the name of its icon."""


class ToolBar(QToolBar):
    """The modes, and icons for some entries and menus of the menu bar.

    The icons are drawn after the toolbar is first shown, so that they do not delay the window.
    """

    def __init__(
        self,
        actions: Mapping[str, QAction],
        menus: Mapping[str, QMenu],
        modes: QActionGroup,
    ) -> None:
        super().__init__()
        self.setObjectName("toolbar")
        self.setWindowTitle("Toolbar")
        self.setAccessibleName("Toolbar")
        self.setMovable(False)
        self.setIconSize(QSize(ICON_SIZE, ICON_SIZE))
        # Qt's own menu could hide the toolbar, and nothing could show it again.
        self.toggleViewAction().setVisible(False)
        sources = {**actions, **{name: menu.menuAction() for name, menu in menus.items()}}
        self.buttons: dict[str, ToolButton] = {}
        self._is_drawn = False
        self.modes = ModeBar(modes)
        self.addWidget(self.modes)
        space = QWidget()
        space.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.addWidget(space)
        self._add_tools(sources)

    def _add_tools(self, sources: Mapping[str, QAction]) -> None:
        for group in TOOLS:
            if self.buttons:
                self.addSeparator()
            for name, drawing in group.items():
                self.buttons[name] = ToolButton(drawing, sources[name])
                self.addWidget(self.buttons[name])

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        QTimer.singleShot(0, self, self._draw)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._is_drawn:
            QTimer.singleShot(0, self, self._redraw)

    def event(self, event: QEvent) -> bool:
        """Draw the icons for a screen of another resolution."""
        if event.type() == QEvent.Type.DevicePixelRatioChange and self._is_drawn:
            self._redraw()
        return super().event(event)

    def _draw(self) -> None:
        if not self._is_drawn:
            self._redraw()

    def _redraw(self) -> None:
        self._is_drawn = True
        self.modes.draw()
        for button in self.buttons.values():
            button.draw()
