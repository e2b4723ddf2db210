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
}
"""Where a pane stands that the mode neither shows nor puts behind its main pane; else below."""


def arrange(window: QMainWindow, docks: Mapping[str, QDockWidget], mode: Mode) -> None:
    """Show the panes of a mode at their places, and hide all others.

    Another pane, when it is asked for, shares the place of the mode's main pane, or stands at the
    right or below where that is no dock.
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
    main = docks.get(mode.main)
    fronts: dict[Qt.DockWidgetArea, QDockWidget] = {}
    for name, dock in docks.items():
        if name in mode.panes:
            continue
        area = _ELSEWHERE.get(name, _AREA.BottomDockWidgetArea)
        front = fronts.get(area) if main is None or name == "controls" else main
        if front is None:
            window.addDockWidget(area, dock)
            fronts[area] = dock
        else:
            window.tabifyDockWidget(front, dock)
        dock.hide()
    if main is not None:
        main.raise_()
