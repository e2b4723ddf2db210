"""Toolbar of the window: icons of menu entries, in the order of their use."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QSize, QTimer
from PySide6.QtGui import QAction, QActionGroup, QShowEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QToolBar, QWidget

from occ_gui.window.modes.mode_bar import ModeBar
from occ_gui.window.toolbar.tool_button import ICON_SIZE, ToolButton

TOOLS = (
    {"open_photo": "open", "undo": "undo", "redo": "redo"},
    {"before": "before", "pin_a": "pin-a", "pin_b": "pin-b", "measure": "measure"},
    {"fit": "fit", "export": "export", "theme": "theme"},
)
"""Names of the menu entries and menus in groups, each with the name of its icon.

One that the menus do not have is left out: a button that does nothing helps nobody.
"""


class ToolBar(QToolBar):
    """The modes, and icons of entries and menus that are in the menu bar, too.

    The icons are drawn after the toolbar is first shown, so that the window opens no later.
    """

    def __init__(
        self,
        actions: Mapping[str, QAction],
        menus: Mapping[str, QMenu],
        modes: QActionGroup,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setObjectName("toolbar")
        self.setWindowTitle("Toolbar")
        self.setAccessibleName("Toolbar")
        self.setMovable(False)
        self.setIconSize(QSize(ICON_SIZE, ICON_SIZE))
        # The menu of Qt that hides toolbars would leave no way to show it again.
        self.toggleViewAction().setVisible(False)
        known = {**actions, **{name: menu.menuAction() for name, menu in menus.items()}}
        self.buttons: dict[str, ToolButton] = {}
        self._is_drawn = False
        self.modes = ModeBar(modes)
        self.addWidget(self.modes)
        space = QWidget()
        space.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.addWidget(space)
        self._add_tools(known)

    def _add_tools(self, known: Mapping[str, QAction]) -> None:
        for group in TOOLS:
            if self.buttons:
                self.addSeparator()
            for name, drawing in group.items():
                if name in known:
                    self.buttons[name] = ToolButton(drawing, known[name])
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
