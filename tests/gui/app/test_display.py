"""The display: missing libraries are named, and the first window is whole on any screen."""

import ctypes
import shlex
import shutil

import pytest
from gui.kinds import add_widget
from PySide6.QtCore import QRect
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app import display, system_libraries
from occ_gui.app.display import (
    explain_no_window,
    find_first_place,
    find_unlisted_library,
    open_first_window,
)
from occ_gui.app.system_libraries import APT_INSTALL, DISPLAY_LIBRARIES

SCREENS = [(0, 28, 1024, 740), (60, 0, 1920, 1080), (0, 0, 2560, 1600), (-1920, 0, 1920, 1040)]


def refuse(monkeypatch: pytest.MonkeyPatch, reason: str) -> None:
    """Let loading any library fail with this reason."""

    def load(_path: str) -> None:
        raise OSError(reason)

    monkeypatch.setattr(ctypes, "CDLL", load)
    monkeypatch.setattr(system_libraries, "can_load", lambda library: True)
    monkeypatch.setenv("QT_QPA_PLATFORM", "xcb")


def test_all_missing_libraries_are_named_with_the_line_that_installs_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    absent = DISPLAY_LIBRARIES["xcb"]
    monkeypatch.setattr(system_libraries, "can_load", lambda library: library not in absent)
    monkeypatch.setattr(shutil, "which", lambda name: name if name == "apt-get" else None)
    monkeypatch.setenv("QT_QPA_PLATFORM", "xcb")
    reason = explain_no_window()
    assert all(library in reason for library in absent)
    assert f"'apt-get update && {shlex.join([*APT_INSTALL, *absent.values()])}'" in reason
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert "apt-get" not in explain_no_window()
    monkeypatch.setenv("QT_QPA_PLATFORM", "wayland")
    assert "libxcb" not in explain_no_window()


def test_a_missing_library_that_no_table_lists_is_named_or_else_the_display(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    refuse(monkeypatch, "libnew.so.0: cannot open shared object file: No such file")
    assert find_unlisted_library(("xcb",)) == "libnew.so.0"
    assert "libnew.so.0" in explain_no_window()
    refuse(monkeypatch, "/x/libqxcb.so: invalid ELF header")
    assert explain_no_window() == display.NO_DISPLAY


def test_the_displays_are_those_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    assert display.platforms() == ()
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setenv("WAYLAND_DISPLAY", "wayland-0")
    assert display.platforms() == ("wayland", "xcb")
    monkeypatch.setenv("QT_QPA_PLATFORM", "xcb:option;wayland")
    assert display.platforms() == ("xcb",)


@pytest.mark.parametrize("screen", SCREENS, ids=str)
def test_the_first_window_is_whole_and_in_the_middle(screen: tuple[int, int, int, int]) -> None:
    free = QRect(*screen)
    place = find_first_place(free)
    assert free.contains(place)
    assert (place.center() - free.center()).manhattanLength() <= 2
    assert place.width() >= min(1280, free.width())
    assert place.height() >= min(800, free.height())


@pytest.mark.parametrize("screen", [(0, 0, 1366, 740), (0, 0, 1920, 860), (0, 0, 1920, 1080)])
def test_the_first_window_is_maximized_on_a_small_screen_only(
    qtbot: QtBot, screen: tuple[int, int, int, int]
) -> None:
    window = add_widget(qtbot, QWidget())
    open_first_window(window, QRect(*screen))
    assert window.isMaximized() == (screen[3] < 1000)
    assert (window.geometry() == QRect(*screen)) == window.isMaximized()
