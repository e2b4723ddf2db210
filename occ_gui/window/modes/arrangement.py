"""Arrangement of the docks of a window as a mode wants them."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow

from occ_gui.window.modes.mode import Groups, Mode

_AREA = Qt.DockWidgetArea
_ELSEWHERE = {"controls": _AREA.LeftDockWidgetArea}
"""Where a pane stands that the mode neither shows nor puts behind its main pane."""


def arrange(window: QMainWindow, docks: Mapping[str, QDockWidget], mode: Mode) -> None:
    """Show the panes of a mode at their places, and hide all others.

    Another pane comes up, when it is asked for, behind the mode's main pane, or at the bottom
    where that is no dock.
    """
    for dock in docks.values():
        window.removeDockWidget(dock)
    for area, groups in (
        (_AREA.LeftDockWidgetArea, mode.left),
        (_AREA.RightDockWidgetArea, mode.right),
        (_AREA.BottomDockWidgetArea, mode.bottom),
    ):
        _place(window, docks, area, groups)
    _put_behind(window, docks, mode)
    for orientation, sizes in (
        (Qt.Orientation.Horizontal, mode.widths),
        (Qt.Orientation.Vertical, mode.heights),
    ):
        window.resizeDocks([docks[name] for name in sizes], list(sizes.values()), orientation)


def _place(
    window: QMainWindow,
    docks: Mapping[str, QDockWidget],
    area: Qt.DockWidgetArea,
    groups: Groups,
) -> None:
    for group in groups:
        front, *others = (docks[name] for name in group)
        window.addDockWidget(area, front, Qt.Orientation.Vertical)
        front.show()
        for other in others:
            window.tabifyDockWidget(front, other)
            other.show()
        front.raise_()


def _put_behind(window: QMainWindow, docks: Mapping[str, QDockWidget], mode: Mode) -> None:
    for name, dock in docks.items():
        if name in mode.panes:
            continue
        if name in _ELSEWHERE or mode.main not in docks:
            window.addDockWidget(_ELSEWHERE.get(name, _AREA.BottomDockWidgetArea), dock)
        else:
            window.tabifyDockWidget(docks[mode.main], dock)
        dock.hide()
    if mode.main in docks:
        docks[mode.main].raise_()
