"""Main window: panes in docks, menus and status bar."""

import html
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QShowEvent, QUndoStack
from PySide6.QtWidgets import QApplication, QLabel, QMainWindow, QWidget

from occ_gui.scene.control_panel import ControlPanel
from occ_gui.story.story_view import StoryView
from occ_gui.values.modes import MODES, PICTURE, PanePlace, Places, Side
from occ_gui.widgets.building import bring_into_view
from occ_gui.widgets.event_filters import leave_drops_to_window
from occ_gui.widgets.state_look import Badge
from occ_gui.window.docks import DeclaredPane, Dock, ModeSwitch, Panes
from occ_gui.window.failure_banner import FailureBanner
from occ_gui.window.menus import Menus
from occ_gui.window.pane_room import PaneRoom
from occ_gui.window.reading_order import next_to_focus
from occ_gui.window.status_line import StatusLine
from occ_gui.window.style_sheet import style_sheet
from occ_gui.window.toolbar import ToolBar
from occ_model.errors import one_line

_FIRST_SIZE = QSize(1280, 800)
_LONGEST_NAME = 30  # characters of a photo's name in the status line
_PROPAGATED = Qt.ApplicationAttribute.AA_UseStyleSheetPropagationInWidgetStyles
_WITH_PICTURE = "photo"  # the pane that is shown together with the whole picture and the photo

_IN_STORY = ("profile", "decode")  # panes whose subject has a row in the story


_CONTROLS = {
    "explore": PanePlace("left", width=340),
    "photo": PanePlace("left"),
    "limits": PanePlace("left", width=340),
    "effects": PanePlace("left", width=340),
    "lessons": PanePlace("left", width=320),
    "video": PanePlace("left", width=340),
}


class MainWindow(QMainWindow):
    """Docks, menus and status bar; :mod:`occ_gui.app.application` connects them."""

    closing = Signal()

    dropped = Signal(list)
    """The paths of the files that were dropped on the window; empty if none is a file."""

    def __init__(
        self, controls: ControlPanel, centre: QWidget, story: StoryView, *, undo_stack: QUndoStack
    ) -> None:
        super().__init__()
        self.setWindowTitle("Optical Camera Communication")
        # Otherwise children keep the colours of the theme in which they were first shown.
        QApplication.setAttribute(_PROPAGATED)
        self.apply_style()
        self.setFocus()  # on no control, until a key or the mouse chooses one
        self.setDockNestingEnabled(True)
        self.setAnimated(False)  # each step of an animation would redraw all plots
        self.setCentralWidget(centre)
        self.docks: dict[str, Dock] = {}
        self._panes = Panes()
        self._room = PaneRoom(self, self.docks, lambda: self._panes.main_of(self.modes.mode))
        self._add_dock("controls", "Scene", controls, _CONTROLS, "left")
        self.menus = Menus(self, undo_stack, self.docks.values())
        self.actions_by_name = self.menus.actions
        self.modes = ModeSwitch(self, self._panes, self._show_page)
        self.menus.modes.triggered.connect(lambda action: self.modes.switch(action.data()))
        self.modes.changed.connect(lambda mode: self.menus.show_choice(self.menus.modes, mode))
        self.toolbar = ToolBar(self.menus.actions, self.menus.drop_downs, self.menus.modes)
        self.addToolBar(self.toolbar)
        self.setAcceptDrops(True)
        leave_drops_to_window(self)
        self._centre, self._story = centre, story
        self.may_close: Callable[[], bool] = lambda: True
        self._status_line = StatusLine()
        self.setStatusBar(self._status_line)
        line = self._status_line
        self.failure = FailureBanner(self, self.toolbar)
        self.leave_messages_to(self.failure.sentence)
        self.loading_bar, self.animation_bar = line.loading_bar, line.animation_bar
        self.readout = line.readout
        self.show_timing = self._status_line.show_timing
        self.show_accuracy = self._status_line.show_accuracy
        self._photo_name = ""
        self.modes.changed.connect(lambda _: self.show_photo(self._photo_name))
        self.show_plan_change = self._status_line.show_plan_change
        self.modes.changed.connect(
            lambda mode: line.show_times("controls" in self._panes.places_in(mode))
        )
        self.resize(_FIRST_SIZE)

    def _add_dock(
        self, name: str, title: str, content: QWidget, places: Places, default_side: Side
    ) -> Dock:
        dock = self.docks[name] = Dock(name, title, content, self)
        dock.opened_by_user.connect(self._room.give_to_sender)
        self._panes[name] = DeclaredPane(dock, places, default_side)
        return dock

    def add_pane(
        self, name: str, title: str, content: QWidget, places: Places, default_side: Side
    ) -> Dock:
        """Add a pane, and its entry in the view menu, before the window is shown."""
        dock = self._add_dock(name, title, content, places, default_side)
        self.menus.add_dock(dock)
        return dock

    def bring_to_front(self, name: str) -> None:
        """Show a pane in front of the others in its place.

        The mode changes to the pane's own unless the pane is open in the present one.
        """
        home = self._panes.home_of(name)
        if self.docks[name].isHidden() and home:
            self.modes.switch(home)
        self._room.show_in_front(self.docks[name])

    def bring_into_view(self, name: str) -> None:
        """Show a pane in front in the present mode, or the story if it has a row for the pane.

        The mode stays, because it shows the lesson that asks for the pane.
        """
        if name in _IN_STORY and MODES[self.modes.mode].centre:
            self._story.show_whole_picture(False)
            return
        if name == _WITH_PICTURE:
            self._story.show_whole_picture(True)
        self._room.show_in_front(self.docks[name])

    def hide_pane(self, name: str) -> None:
        """Hide a pane that the present mode does not show."""
        if name not in self._panes.places_in(self.modes.mode):
            self.docks[name].hide()

    def _show_page(self, page: str) -> None:
        """Show the story in the middle, the whole picture in its place, or neither."""
        self._centre.setVisible(bool(page))
        if page:
            self._story.show_whole_picture(page == PICTURE)

    def show_message(self, sentence: str) -> None:
        """Show a sentence in the status line in place of the last one; empty removes it."""
        self._status_line.showMessage(sentence)
        if sentence != self.failure.sentence.text():
            self.failure.hide()

    def show_photo(self, name: str) -> None:
        """Say in each mode but its own that a photo is open; empty if none is."""
        self._photo_name = name
        badge = None
        if name and self.modes.mode != _WITH_PICTURE:
            text = html.escape(one_line(name, _LONGEST_NAME))
            meaning = f"The photo {name} is open: the mode Photo shows it, and the menu closes it."
            badge = Badge("photo", f"photo {text}", meaning)
        self._status_line.show_photo(badge)

    def show_failure(self, sentence: str) -> None:
        """Show why a file was not opened or saved, unless a pane in view says it."""
        QTimer.singleShot(0, self, lambda: self._show_failure(sentence))

    def _show_failure(self, sentence: str) -> None:
        if not self._status_line.is_shown_elsewhere:
            self.failure.show_sentence(sentence)

    def leave_messages_to(self, *labels: QLabel) -> None:
        """Suppress messages in the status line that one of these labels shows."""
        self._status_line.leave_to(*labels)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        if not self.modes.is_shown:
            self.modes.begin()

    def focusNextPrevChild(self, next_: bool) -> bool:  # noqa: N802 - Qt's name
        """Let the Tab key go through toolbar, panes and story in reading order."""
        widget = next_to_focus(self, self.focusWidget(), next_)
        if widget is None:
            return False
        reason = Qt.FocusReason.TabFocusReason if next_ else Qt.FocusReason.BacktabFocusReason
        widget.setFocus(reason)
        bring_into_view(widget)
        return True

    def apply_style(self) -> None:
        sheet = style_sheet(QApplication.palette())
        if sheet != self.styleSheet():
            size = self.size()
            self.setStyleSheet(sheet)
            # Panes ask for more space while their parts are restyled one by one.
            if self.isVisible() and not self.isMaximized():
                QTimer.singleShot(0, self, lambda: self.resize(size))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:  # noqa: N802 - Qt's name
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:  # noqa: N802 - Qt's name
        event.acceptProposedAction()
        urls = [url for url in event.mimeData().urls() if url.isLocalFile()]
        self.dropped.emit([Path(url.toLocalFile()) for url in urls])

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 - Qt's name
        if not self.may_close():
            event.ignore()
            return
        self.closing.emit()
        super().closeEvent(event)
