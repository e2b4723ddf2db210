"""Display: why no window can be opened, and where the first one opens."""

import ctypes
import os
import re
from pathlib import Path

from PySide6.QtCore import QLibraryInfo, QRect, QSize, Qt
from PySide6.QtWidgets import QWidget

from occ_gui.app.system_libraries import describe_missing, find_missing_libraries

NO_DISPLAY = "There is no display that a window can be opened on; use --screenshot FILE."

_MISSING_LIBRARY = re.compile(r"^(\S+): cannot open shared object file")
"""Message of the dynamic linker on a missing library."""

_LARGEST_SIZE, _LEAST_SIZE = QSize(1680, 1050), QSize(1280, 800)
_SCREEN_FRACTION = 0.92
"""Fraction of the screen's sides that the first window takes; all of a screen too small for it."""


def explain_no_window() -> str:
    """Explain why Qt cannot open a window: libraries are missing, or there is no display."""
    missing = find_missing_libraries(*platforms())
    if missing:
        return describe_missing(missing)
    library = find_unlisted_library(platforms())
    return NO_DISPLAY if library is None else describe_missing({library: ""})


def platforms() -> tuple[str, ...]:
    """Return the available kinds of display, by the names of Qt's plug-ins for them."""
    chosen = os.environ.get("QT_QPA_PLATFORM", "").split(";")[0].split(":")[0]
    if chosen:
        return (chosen,)
    named = (("wayland", "WAYLAND_DISPLAY"), ("xcb", "DISPLAY"))
    return tuple(platform for platform, name in named if os.environ.get(name))


def find_unlisted_library(names: tuple[str, ...]) -> str | None:
    """Return the first library that Qt's plug-ins of these names lack, None if none is missing."""
    folder = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.PluginsPath), "platforms")
    for name in names:
        plugin = folder / f"libq{name}.so"
        try:
            if plugin.is_file():
                ctypes.CDLL(str(plugin))
        except OSError as error:
            match = _MISSING_LIBRARY.match(str(error))
            if match:
                return match[1]
    return None


def find_first_place(screen: QRect) -> QRect:
    """Return the first window's place: the middle, or all of a small screen."""
    size = (screen.size() * _SCREEN_FRACTION).boundedTo(_LARGEST_SIZE)
    if size != size.expandedTo(_LEAST_SIZE):
        return screen
    place = QRect(screen.topLeft(), size)
    place.moveCenter(screen.center())
    return place


def open_first_window(window: QWidget, screen: QRect) -> None:
    """Place a window; maximize it where its place is the whole screen."""
    place = find_first_place(screen)
    window.setGeometry(place)
    if place == screen:  # the frame must fit, too
        window.setWindowState(Qt.WindowState.WindowMaximized)
