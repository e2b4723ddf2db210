"""Modes: the panes of each task, their places, and the change between modes."""

from binascii import crc32
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from PySide6.QtCore import QByteArray, QObject, Qt, Signal
from PySide6.QtWidgets import QDockWidget, QMainWindow

STORY, PICTURE = "story", "picture"
"""The pages in the middle: the way from light to bits, and the picture with the photo."""

Groups = tuple[tuple[str, ...], ...]
"""Panes from top to bottom; those of a group are tabs of one place, the first in front."""


@dataclass(frozen=True, slots=True)
class Mode:
    centre: str  # the page in the middle; empty where the panes around it fill the window
    main: str
    left: Groups = ()
    right: Groups = ()
    bottom: Groups = ()
    is_bottom_wide: bool = False
    is_right_high: bool = False
    # First sizes in pixels by pane, of those whose size matters
    widths: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    heights: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def panes(self) -> tuple[str, ...]:
        groups = (*self.left, *self.right, *self.bottom)
        return tuple(name for group in groups for name in group)


MODES: Mapping[str, Mode] = MappingProxyType(
    {
        "explore": Mode(
            centre=STORY, main=PICTURE, left=(("controls",),), widths={"controls": 340}
        ),
        "photo": Mode(
            centre=PICTURE,
            main="photo",
            left=(("photo", "controls"),),
            bottom=(("profile", "photos"),),
            is_bottom_wide=True,
            widths={"photo": 360},
            heights={"profile": 210},
        ),
        "limits": Mode(
            centre="",
            main="map",
            left=(("controls",),),
            right=(("map", "bench", "bands"),),
            widths={"controls": 340},
        ),
        "effects": Mode(
            centre="",
            main="accuracy",
            left=(("controls",),),
            right=(("accuracy",),),
            widths={"controls": 340},
        ),
        "lessons": Mode(
            centre=STORY,
            main="lessons",
            left=(("controls",),),
            right=(("lessons",),),
            is_bottom_wide=True,
            is_right_high=True,  # a lesson's text has all the height, whatever pane it shows below
            widths={"controls": 320, "lessons": 340},
        ),
        "video": Mode(
            centre="",
            main="video",
            left=(("controls",),),
            right=(("video",),),
            widths={"controls": 340},
        ),
        "room": Mode(centre="", main="room", right=(("room",),)),
    }
)

HOMES: Mapping[str, str] = MappingProxyType(
    {mode.main: name for name, mode in MODES.items() if mode.main != PICTURE}
)
"""The mode of each pane that is a mode's main one."""


_AREA = Qt.DockWidgetArea
_ELSEWHERE = {
    "controls": _AREA.LeftDockWidgetArea,
    "decode": _AREA.RightDockWidgetArea,
    "photo": _AREA.RightDockWidgetArea,
    "equations": _AREA.RightDockWidgetArea,
    "lessons": _AREA.RightDockWidgetArea,
    "video": _AREA.RightDockWidgetArea,
}
"""Areas of panes that the mode does not show; all others stand below."""


def arrange(window: QMainWindow, docks: Mapping[str, QDockWidget], mode: Mode) -> None:
    """Show the panes of a mode at their places, and hide all others."""
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
    window: QMainWindow, docks: Mapping[str, QDockWidget], area: Qt.DockWidgetArea, groups: Groups
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


_WIDEST_SIDE, _ANY_WIDTH = 360, 16_777_215
"""Pixels; the latter is Qt's, by which a size is not limited."""


class ModeSwitch(QObject):
    """The present mode of a window, and the layouts of those that were used before.

    ``docks``: its docks, by name; they may still be added to until the first mode is shown.
    ``show_page``: shows a page in the middle by its name, or hides the middle where that is empty.
    """

    changed = Signal(str)

    def __init__(
        self,
        window: QMainWindow,
        docks: Mapping[str, QDockWidget],
        show_page: Callable[[str], None],
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._show_page = window, docks, show_page
        self.mode = next(iter(MODES))
        self.layouts: dict[str, QByteArray] = {}
        """Layouts of the other modes when they were left, by name."""
        self.is_shown = False  # whether the window has been laid out
        self.version = 0  # the version of stored layouts: one of other panes is ignored

    def begin(self) -> None:
        """Lay out the present mode, when the window is first shown."""
        self.is_shown = True
        self.version = crc32(",".join(self._docks).encode()) & 0x7FFF_FFFF
        self._enter()

    def switch(self, name: str) -> None:
        """Change to a mode, laid out as it was left; an unknown name changes nothing."""
        if name == self.mode or name not in MODES:
            return
        if self.is_shown:
            self.layouts[self.mode] = self._window.saveState(self.version)
        self.mode = name
        if self.is_shown:
            self._enter()
        self.changed.emit(name)

    def reset(self) -> None:
        """Restore the first layout of the present mode."""
        self.layouts.pop(self.mode, None)
        self._enter()

    def present_layouts(self) -> dict[str, QByteArray]:
        if not self.is_shown:
            return dict(self.layouts)
        return {**self.layouts, self.mode: self._window.saveState(self.version)}

    def _enter(self) -> None:
        window = self._window
        size = window.size()
        window.setUpdatesEnabled(False)
        try:
            # Beside the panes of the mode before it the page might need a wider window, and Qt
            # would widen it, over the edge of the screen where it is maximized.
            for dock in self._docks.values():
                window.removeDockWidget(dock)
            self._show_page(MODES[self.mode].centre)
            self._limit_sides(MODES[self.mode])
            # First even where a layout is known: Qt leaves the tabs of the mode before it behind.
            arrange(window, self._docks, MODES[self.mode])
            if self.mode in self.layouts:
                window.restoreState(self.layouts[self.mode], self.version)
            # A layout of a wider window would widen it.
            if window.size() != size and not window.isMaximized():
                window.resize(size)
        finally:
            window.setUpdatesEnabled(True)

    def _limit_sides(self, mode: Mode) -> None:
        """Give the width that the window gains to the main pane where there is no page.

        Qt would divide it between the panes.
        """
        sides = {name for group in mode.left for name in group}
        for name, dock in self._docks.items():
            is_limited = not mode.centre and name in sides
            dock.setMaximumWidth(_WIDEST_SIDE if is_limited else _ANY_WIDTH)
