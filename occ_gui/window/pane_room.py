"""Room in the window for a pane that opens: as a tab of another pane, or beside larger ones."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication, QMainWindow

from occ_gui.window.docks import Dock

_OPENED_BELOW, _OPENED_BESIDE = 0.37, 0.26
"""Fractions of the window's height and width for a pane opening below the middle or beside it."""

_LEAST_BELOW = 530  # pixels of width that each pane below the middle may need


class PaneRoom(QObject):
    """Shows panes in front of others; one that has just opened gets room without a larger window.

    ``find_main_pane`` returns the name of the present mode's main pane, which stays in view.
    """

    def __init__(
        self, window: QMainWindow, docks: Mapping[str, Dock], find_main_pane: Callable[[], str]
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._find_main_pane = window, docks, find_main_pane

    def give_to_sender(self) -> None:
        """Give room to the pane that the user has opened from the menu."""
        dock = self.sender()
        if isinstance(dock, Dock):
            self._join_tabs(dock)
            QTimer.singleShot(0, dock, lambda: self._bring_forward(dock, True))

    def show_in_front(self, dock: Dock) -> None:
        is_new = dock.isHidden()
        # Otherwise Qt would widen the window for the former page of the middle.
        QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        dock.show()
        if is_new:
            self._join_tabs(dock)
        # A window that has just been shown arranges its docks once more, in another order.
        QTimer.singleShot(0, dock, lambda: self._bring_forward(dock, is_new))

    def _join_tabs(self, dock: Dock) -> None:
        """Make a pane that has just opened a tab of another one if there is no room for both.

        Qt would widen the window beyond the screen, and draw one pane over the other.
        """
        window = self._window
        below = Qt.DockWidgetArea.BottomDockWidgetArea
        if dock.isFloating() or window.dockWidgetArea(dock) != below:
            return
        others = [
            other
            for other in self._docks.values()
            if other is not dock
            and window.dockWidgetArea(other) == below
            and not (other.isFloating() or other.visibleRegion().isEmpty())
        ]
        if not others or window.tabifiedDockWidgets(dock):
            return
        left = min(other.geometry().left() for other in others)
        room = max(other.geometry().right() for other in others) - left
        if _LEAST_BELOW * (len(others) + 1) > room:
            window.tabifyDockWidget(others[-1], dock)

    def _bring_forward(self, dock: Dock, is_new: bool) -> None:
        """Bring a pane to the front, and enlarge it if it is too small when it opens."""
        window = self._window
        dock.raise_()
        if not is_new or dock.isFloating():
            return
        if self._fit_height(dock):
            dock.raise_()
        area = window.dockWidgetArea(dock)
        if area == Qt.DockWidgetArea.BottomDockWidgetArea:
            least_length, length = round(_OPENED_BELOW * window.height()), dock.height()
            orientation = Qt.Orientation.Vertical
        else:
            least_length, length = round(_OPENED_BESIDE * window.width()), dock.width()
            orientation = Qt.Orientation.Horizontal
        if length < least_length:
            window.resizeDocks([dock], [least_length], orientation)
        if orientation == Qt.Orientation.Horizontal:
            self._give_half_height(dock)

    def _fit_height(self, dock: Dock) -> bool:
        """Make a pane a tab of another one if there is no room for one above the other.

        Qt would make the window higher than the screen. Return whether the pane has moved.
        """
        window = self._window
        QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        if window.minimumSizeHint().height() <= dock.height_before:
            return False
        area, main = window.dockWidgetArea(dock), self._find_main_pane()
        others = [
            other
            for name, other in self._docks.items()
            if other not in {dock, *window.tabifiedDockWidgets(dock)}
            and name not in {"controls", main}
            and not (other.isFloating() or other.isHidden())
        ]
        if not others:
            return False
        neighbours = [other for other in others if window.dockWidgetArea(other) == area]
        window.tabifyDockWidget((neighbours or others)[-1], dock)
        QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        window.resize(window.width(), dock.height_before)
        return True

    def _give_half_height(self, dock: Dock) -> None:
        """Give a pane at a side half of the height, if those above it can spare it."""
        window = self._window
        above = [
            other
            for other in self._docks.values()
            if other not in {dock, *window.tabifiedDockWidgets(dock)}
            and window.dockWidgetArea(other) == window.dockWidgetArea(dock)
            and other.isVisible()
            and not other.isFloating()
        ]
        room = dock.height() + sum(other.height() for other in above)
        needed = sum(other.sizeHint().height() for other in above)
        height = min(room // 2, room - needed)
        if dock.height() < height:
            window.resizeDocks([dock], [height], Qt.Orientation.Vertical)
