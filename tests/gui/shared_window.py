"""A window that tests of a file use one after another, while each leaves it as at its start."""

import gc
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from PySide6.QtCore import QEvent
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDockWidget,
    QGraphicsView,
    QLabel,
    QLineEdit,
    QMenu,
    QPlainTextEdit,
    QTabBar,
    QTextEdit,
    QWidget,
)
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_model.scene.scene import Scene

_SHOWN: dict[type[QWidget], Callable[[Any], object]] = {
    QAbstractButton: lambda w: (w.text(), w.isChecked()),
    QAbstractSlider: lambda w: (w.value(), w.minimum(), w.maximum()),
    QAbstractSpinBox: lambda w: w.text(),
    QComboBox: lambda w: (w.currentIndex(), [w.itemText(at) for at in range(w.count())]),
    QDockWidget: lambda w: (w.size(), w.isFloating(), w.windowTitle()),
    QGraphicsView: lambda w: len(w.scene().items()) if w.scene() else 0,
    QLabel: lambda w: w.text(),
    QLineEdit: lambda w: w.text(),
    QPlainTextEdit: lambda w: w.toPlainText(),
    QTabBar: lambda w: (w.currentIndex(), w.count()),
    QTextEdit: lambda w: w.toPlainText(),
}
"""What a user sees in a widget of each kind."""

_SETTLED_MS = 100
"""How long a new window goes on arranging its docks."""


def new_window(qtbot: QtBot, scene: Scene) -> Application:
    """Show a whole application that has come to rest."""
    application = Application(scene)
    application.window.show()
    qtbot.waitUntil(lambda: application.is_idle)
    return application


def end(application: Application, before: Sequence[QWidget]) -> None:
    """Close a window, and see that nothing of it is left behind."""
    application.window.close()
    application.stop()
    application.window.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()
    # pyqtgraph's menus have no parent: they go when Python forgets the plot, as another test sees.
    leaked = [
        widget
        for widget in QApplication.topLevelWidgets()
        if widget not in before and not isinstance(widget, QMenu)
    ]
    assert not leaked, f"top-level widgets outlive the window: {leaked}"


def look_of(application: Application) -> list[object]:
    """Give all that a test could have changed in a window, and that another would see."""
    window = application.window
    widgets = [window, *window.findChildren(QWidget)]
    focus = window.focusWidget()
    return [
        application.store.scene,
        application.store.undo_stack.count(),
        application.settings.settings,
        application.photos.reading,
        application.photo_wiring.matching.photo,
        application.photo_wiring.placements.placement,
        application.image.mode.key(),
        application.image.simulation.box.viewRange(),
        application.desktop.theme.theme,
        window.modes.mode,
        window.windowTitle(),
        window.size(),
        None if focus is None else widgets.index(focus),
        [(w.isHidden(), w.isEnabled(), w.visibleRegion().isEmpty(), w.toolTip()) for w in widgets],
        [
            (type(w), shown(w))
            for w in widgets
            for kind, shown in _SHOWN.items()
            if isinstance(w, kind)
        ],
        [
            (a.text(), a.isChecked(), a.isEnabled(), a.isVisible())
            for a in window.findChildren(QAction)
        ],
    ]


class SharedWindow:
    """Keeps a window from one test to the next, where the next finds it as the first did."""

    def __init__(self) -> None:
        self._kept: Application | None = None
        self._first: list[object] = []
        self._before: list[QWidget] = []

    @contextmanager
    def lent(self, qtbot: QtBot, scene: Scene) -> Iterator[Application]:
        """Lend the window to a test: the one that is kept, or a new one."""
        if self._kept is None:
            self._before = QApplication.topLevelWidgets()
            self._kept = new_window(qtbot, scene)
            qtbot.wait(_SETTLED_MS)
            self._first = look_of(self._kept)
        yield self._kept
        self._put_back(qtbot, self._kept)
        if look_of(self._kept) != self._first:
            self.close()

    def close(self) -> None:
        """Close the window, if one is kept."""
        kept, self._kept = self._kept, None
        if kept is None:
            return
        was_on = gc.isenabled()
        gc.disable()  # let no worker destroy what is left of the widgets
        end(kept, self._before)
        self._before, kept = [], None
        gc.collect(1)
        if was_on:
            gc.enable()

    def _put_back(self, qtbot: QtBot, application: Application) -> None:
        """Let the window come to rest, and its status line say nothing."""
        application.window.statusBar().clearMessage()
        qtbot.waitUntil(lambda: application.is_idle)
        QApplication.processEvents()
