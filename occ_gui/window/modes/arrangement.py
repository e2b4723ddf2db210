"""Arrangement of the docks of a window as a mode wants them."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow

from occ_gui.window.modes.mode import Groups, Mode

_AREA = Qt.DockWidgetArea
_ELSEWHERE = {
    "controls": _AREA.LeftDockWidgetArea,
    "decode": _AREA.RightDockWidgetArea,
    "photo": _AREA.RightDockWidgetArea,
    "equations": _AREA.RightDockWidgetArea,
    "lessons": _AREA.RightDockWidgetArea,
    "video": _AREA.RightDockWidgetArea,
}
"""Where a pane stands that the mode does not show; all others stand below."""


def arrange(window: QMainWindow, docks: Mapping[str, QDockWidget], mode: Mode) -> None:
    """Show the panes of a mode at their places, and hide all others.

    Another pane, when it is asked for, stands at the right or below.
    """
    for dock in docks.values():
        window.removeDockWidget(dock)
    corner = _AREA.BottomDockWidgetArea if mode.is_bottom_wide else _AREA.LeftDockWidgetArea
    window.setCorner(Qt.Corner.BottomLeftCorner, corner)
    corner = _AREA.RightDockWidgetArea if mode.is_right_high else _AREA.BottomDockWidgetArea
    window.setCorner(Qt.Corner.BottomRightCorner, corner)
    for area, groups in (
        (_AREA.LeftDockWidgetArea, mode.left),
        (_AREA.RightDockWidgetArea, mode.right),
        (_AREA.BottomDockWidgetArea, mode.bottom),
    ):
        _place(window, docks, area, groups)
    _place_others(window, docks, mode)
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


def _place_others(window: QMainWindow, docks: Mapping[str, QDockWidget], mode: Mode) -> None:
    for name, dock in docks.items():
        if name not in mode.panes:
            window.addDockWidget(_ELSEWHERE.get(name, _AREA.BottomDockWidgetArea), dock)
            dock.hide()
