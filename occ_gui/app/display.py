"""Display: why no window can be opened, and where the first one opens."""

import ctypes
import os
import re
from pathlib import Path

from PySide6.QtCore import QLibraryInfo, QRect, QSize, Qt
from PySide6.QtWidgets import QWidget

from occ_gui.app.system_libraries import missing_libraries, sentence_about

NO_DISPLAY = "There is no display that a window can be opened on; use --screenshot FILE."

_MISSING = re.compile(r"^(\S+): cannot open shared object file")
"""What the dynamic linker says of a library that it does not find."""

_LARGEST, _LEAST = QSize(1680, 1050), QSize(1280, 800)
_FRACTION = 0.92
"""Fraction of the screen that the first window takes: what lies behind it stays in sight.

Where that is less than the sliders and the story need, the window takes the whole screen.
"""


def reason_for_no_window() -> str:
    """Say why Qt cannot open a window: libraries are missing, or there is no display."""
    missing = missing_libraries(*platforms())
    if missing:
        return sentence_about(missing)
    library = unlisted_library(platforms())
    return NO_DISPLAY if library is None else sentence_about({library: ""})


def platforms() -> tuple[str, ...]:
    """Name the kinds of display that are there, as Qt names its plug-ins for them."""
    chosen = os.environ.get("QT_QPA_PLATFORM", "").split(";")[0].split(":")[0]
    if chosen:
        return (chosen,)
    named = (("wayland", "WAYLAND_DISPLAY"), ("xcb", "DISPLAY"))
    return tuple(platform for platform, name in named if os.environ.get(name))


def unlisted_library(names: tuple[str, ...]) -> str | None:
    """Return the first library that Qt's plug-ins of these names lack, None if they lack none."""
    folder = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.PluginsPath), "platforms")
    for name in names:
        plugin = folder / f"libq{name}.so"
        try:
            if plugin.is_file():
                ctypes.CDLL(str(plugin))
        except OSError as error:
            found = _MISSING.match(str(error))
            if found:
                return found[1]
    return None


def first_place(screen: QRect) -> QRect:
    """Return where the first window opens: in the middle, or over all of a small screen."""
    wanted = (screen.size() * _FRACTION).boundedTo(_LARGEST)
    if wanted != wanted.expandedTo(_LEAST):
        return screen
    place = QRect(screen.topLeft(), wanted)
    place.moveCenter(screen.center())
    return place


def open_first(window: QWidget, screen: QRect) -> None:
    """Give a window its first place; one that takes the whole screen is maximized."""
    place = first_place(screen)
    window.setGeometry(place)
    if place == screen:  # its frame too must fit
        window.setWindowState(Qt.WindowState.WindowMaximized)
