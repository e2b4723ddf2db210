"""A window that tests use one after another, each of which finds it as the first did."""

import gc
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QEvent, QSize
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDockWidget,
    QGraphicsScene,
    QGraphicsView,
    QLabel,
    QLineEdit,
    QMenu,
    QPlainTextEdit,
    QTabBar,
    QTabWidget,
    QTextEdit,
    QWidget,
)
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.values.choices import (
    OVERLAYS,
    FilmChoice,
    PhotoChoice,
    RoomChoice,
)
from occ_gui.values.modes import MODES
from occ_model.receiver.decode import DECODERS
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
    application = Application(Workspace(scene))
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
    if _leaked(before):
        gc.collect()  # other tests may have left some since, which Python forgets late
    assert not _leaked(before), "top-level widgets outlive the window"


def _leaked(before: Sequence[QWidget]) -> list[QWidget]:
    # pyqtgraph's menus have no parent: they go when Python forgets the plot, as another test sees.
    widgets = QApplication.topLevelWidgets()
    return [each for each in widgets if each not in before and not isinstance(each, QMenu)]


def forget_lessons(application: Application) -> None:
    """Leave the lesson, and forget what has been done of any, which no user can."""
    if application.shell.find_pane("lessons") is None:
        return
    lessons = application.shell.pane("lessons")
    lessons.controller.leave()
    lessons.controller._places.clear()
    lessons.answers._records.clear()


def state_of(application: Application) -> list[object]:
    """Return what a test could have changed in a window beside its widgets."""
    window = application.window
    return [
        application.scene_store.store.workspace,
        application.scene_store.undo_stack.count(),
        application.results_store.results.photo,
        application.view("picture").overlay.placement,
        application.view("photo").form.choice(),
        application.preferences.files,
        (application.pins.pinned.a, application.pins.pinned.b),
        application.view("picture").mode.key(),
        application.options.theme.theme,
        window.modes.mode,
        window.windowTitle(),
        window.size(),
        window.focusWidget(),
        window.statusBar().currentMessage(),
    ]


def look_of(window: QWidget) -> list[str]:
    """Return what users see of a window's widgets, and its entries, in no order.

    Some widgets are made anew each time, so none is known by its place.
    """
    seen = [
        repr(
            (
                type(widget).__name__,
                widget.isEnabled(),
                widget.toolTip(),
                [shown(widget) for kind, shown in _SHOWN.items() if isinstance(widget, kind)],
            )
        )
        for widget in [window, *window.findChildren(QWidget)]
        if not widget.visibleRegion().isEmpty()
    ]
    entries = [
        repr((entry.text(), entry.isChecked(), entry.isEnabled(), entry.isVisible()))
        for entry in window.findChildren(QAction)
        # Not those of a plot or a field that was made meanwhile.
        if entry.text() and not isinstance(entry.parent(), QGraphicsScene)
    ]
    return [*sorted(seen), *sorted(entries)]


@dataclass(frozen=True)
class Home:
    """What a window had at first, and gets again."""

    size: QSize
    docks: list[bool]
    column: int

    @classmethod
    def of(cls, application: Application) -> "Home":
        docks = [dock.isHidden() for dock in application.window.docks.values()]
        column = application.story.rows.crosshair.column or 0
        return cls(application.window.size(), docks, column)


class SharedWindow:
    """Keeps a window from one test to the next, where the next finds it as the first did."""

    def __init__(self) -> None:
        self._kept: Application | None = None
        self._scene: Scene | None = None
        self._first: list[object] = []
        self._home: Home | None = None
        self._before: list[QWidget] = []

    @property
    def is_kept(self) -> bool:
        return self._kept is not None

    @contextmanager
    def lent(self, qtbot: QtBot, scene: Scene) -> Iterator[Application]:
        """Lend the window to a test: the one that is kept, or a new one."""
        if self._kept is not None and self._scene != scene:  # that of tests in another folder
            self.close()
        if self._kept is None:
            self._open(qtbot, scene)
        # The keys, which a widget has had that another test has shown.
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        self._kept.window.activateWindow()
        qtbot.waitUntil(self._kept.window.isActiveWindow)
        yield self._kept
        if not self._is_as_at_first(qtbot, scene, self._kept):
            self.close()

    def _open(self, qtbot: QtBot, scene: Scene) -> None:
        self._before = QApplication.topLevelWidgets()
        self._kept, self._scene = new_window(qtbot, scene), scene
        kept = self._kept
        qtbot.wait(_SETTLED_MS)
        self._home = Home.of(kept)
        # Each test finds a window that had another scene, the first one too.
        kept.scene_store.change(iso=1.1 * scene.camera.iso)
        qtbot.waitUntil(lambda: kept.is_idle)
        self._put_back(qtbot, scene, kept)
        self._first = [*state_of(kept), *look_of(kept.window)]

    def _is_as_at_first(self, qtbot: QtBot, scene: Scene, kept: Application) -> bool:
        """Put the window back, and tell whether nothing of the test is left in it."""
        if kept.window.isHidden():
            return False
        self._put_back(qtbot, scene, kept)
        return [*state_of(kept), *look_of(kept.window)] == self._first

    def close(self) -> None:
        kept, self._kept = self._kept, None
        if kept is None:
            return
        self._first = []
        was_on = gc.isenabled()
        gc.disable()  # let no worker destroy what is left of the widgets
        end(kept, self._before)
        self._before, kept = [], None
        gc.collect()  # it has outlived collections, so that a smaller one would leave it
        if was_on:
            gc.enable()

    def _put_back(self, qtbot: QtBot, scene: Scene, kept: Application) -> None:
        """Undo what the tests do most, as far as a window lets users undo it; let it come to rest.

        What is not undone here is found by the comparison, and ends the window.
        """
        qtbot.waitUntil(lambda: kept.is_idle)
        window, mode, home = kept.window, next(iter(MODES)), self._home
        forget_lessons(kept)
        kept.video.close()
        kept.pins.clear()
        kept.preferences.clear()
        first = replace(kept.scene_store.store.workspace, scene=scene, settings=FIRST_SETTINGS)
        first = replace(first, photo=PhotoChoice(), film=FilmChoice(), room=RoomChoice())
        first = replace(first, preset="", scene_file=None)
        kept.scene_store.store.put(first, "first scene")
        kept.scene_store.undo_stack.clear()
        kept.document.show_photo(None)  # writes the title
        kept.options.theme.choose("system")
        is_moved = window.size() != home.size or bool(window.modes.layouts)
        window.resize(home.size)
        window.modes.layouts.clear()
        if window.modes.mode != mode:
            window.modes.switch(mode)
            window.modes.layouts.clear()
        elif is_moved or home.docks != Home.of(kept).docks:
            window.modes.reset()
        kept.story.show_whole_picture(False)
        kept.view("picture").before.checkbox.setChecked(False)
        for pages in kept.controls.findChildren(QTabWidget):
            pages.setCurrentIndex(0)
        kept.controls.end_refusals()
        kept.options.choose_overlay(OVERLAYS[0])
        kept.view("picture").choose_picture("camera")
        kept.view("decode").choose_decoder(next(iter(DECODERS)))
        kept.options.brightness.switch(False)
        window.actions_by_name["measure"].setChecked(False)
        qtbot.waitUntil(lambda: kept.is_idle)
        kept.story.rows.crosshair.choose(home.column)
        kept.view("picture").fit()
        window.setFocus()
        QApplication.processEvents()
        # What the status line says of the last change, and of the time that it took.
        window.statusBar().clearMessage()
        window.readout.set_full_text("")
        window.show_plan_change("")
        window.show_timing(0.0, 0.0)
