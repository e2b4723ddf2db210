"""Command line of ``occ-gui``: parse the options and open the window."""

import argparse
import builtins
import gc
import os
import re
import signal
import sys
from collections.abc import Callable, Sequence
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import occ_model as occ
from occ_gui.app.start import DefaultOption, Start, start_of
from occ_gui.app.system_libraries import describe_missing, find_missing_libraries
from occ_gui.core.workspace import Workspace
from occ_gui.values.choices import OVERLAYS, THEMES
from occ_gui.values.modes import MODES
from occ_model.commands.options import (
    Parser,
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.errors import one_line, quote
from occ_model.program import EXIT_MISUSE, run_program, say
from occ_model.scene.from_text import DEFAULT_PRESET

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    from occ_gui.app.application import Application

_PYTHON_IMPORT = builtins.__import__  # Python's own, which Qt for Python replaces

_DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
"""Environment variables, one of which names the display."""

_CHECK_MS = 200  # interval at which Python handles signals

_TIME_SLICE_S = 0.001  # seconds that a thread may run while others wait
_LARGEST_SIDE = 16384  # pixels of a side of the window; a larger window cannot be drawn


def main(arguments: Sequence[str] | None = None) -> int:
    is_process = arguments is None
    work = partial(read_command_line, arguments)
    return run_program("occ-gui", work, is_process=is_process, is_window=True)


def read_command_line(arguments: Sequence[str] | None) -> Callable[[], int]:
    """Parse a command line; return the function that opens the window."""
    return partial(_run, make_parser().parse_args(arguments))


def read_start(options: argparse.Namespace) -> Start:
    """Read the scene, settings and session that the window starts with."""
    _check_qt()
    settings = simulation_settings_of(options)
    has_settings = settings != simulation_settings_of(make_parser().parse_args([]))
    return start_of(options, scene_of(options, may_have_colours=True), settings, has_settings)


def _check_qt() -> None:
    """Refuse to start where Qt is not installed, or cannot be loaded."""
    absent = [name for name in ("PySide6", "pyqtgraph") if find_spec(name) is None]
    if absent:
        raise occ.OccError(
            f"The window needs {' and '.join(absent)}, which this Python lacks; this command "
            "installs what is needed: \"pip install 'occ-explorer[gui]'\"."
        )
    try:
        import PySide6.QtWidgets  # noqa: F401 - it links the system libraries that Qt needs
    except ImportError as error:
        missing = find_missing_libraries()
        reason = describe_missing(missing) if missing else f"Qt cannot be loaded: {error}."
        raise occ.OccError(reason) from error


def make_parser() -> argparse.ArgumentParser:
    parser = Parser(prog="occ-gui", description="Explore optical camera communication.")
    parser.add_argument("--version", action="version", version=f"%(prog)s {occ.__version__}")
    add_scene_options(parser)
    add_simulation_options(parser)
    # The default only marks that no preset was named; a named one replaces the last session.
    parser.set_defaults(preset=DefaultOption(DEFAULT_PRESET))
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE", help="open a scene (.toml) or photos"
    )
    parser.add_argument("--photo", type=Path, metavar="FILE", help="open this photo")
    parser.add_argument(
        "--match", action="store_true", help="match the photo and apply the result to the scene"
    )
    parser.add_argument(
        "--overlay", choices=OVERLAYS, default=OVERLAYS[0],
        help="how photo and simulation are shown; default: %(default)s",
    )  # fmt: skip
    parser.add_argument(
        "--screenshot", type=Path, metavar="FILE",
        help="draw the window, without a display, into this picture, and end",
    )  # fmt: skip
    parser.add_argument(
        "--size",
        type=_parse_size,
        metavar="WIDTHxHEIGHT",
        help="the window's size, such as 1280x800",
    )
    parser.add_argument("--mode", choices=MODES, help="lay the window out for this task")
    parser.add_argument(
        "--dock", metavar="PANE", help="bring this pane to the front, such as map or bench"
    )
    parser.add_argument("--theme", choices=THEMES, help="the window's colours")
    parser.add_argument(
        "--fresh", action="store_true", help="start without restoring the last session"
    )
    return parser


def _parse_size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{2,5})[xX](\d{2,5})", text)
    width, height = (int(match[1]), int(match[2])) if match else (0, 0)
    if not 0 < max(width, height) <= _LARGEST_SIDE:
        raise argparse.ArgumentTypeError(
            f"{quote(text)} is no size; write it as 1280x800, each up to {_LARGEST_SIDE}"
        )
    return width, height


def _run(options: argparse.Namespace) -> int:
    start_state = read_start(options)
    _prepare(options)
    qt, application = start(start_state.first_workspace, sys.argv[:1], start_state.preferences)
    _check_pane(options.dock, application)
    if not (options.screenshot or options.size):
        from occ_gui.app.display import open_first_window

        open_first_window(application.window, qt.primaryScreen().availableGeometry())
    start_state.restore(application, with_photo=options.photo is None)
    if options.theme:
        application.options.theme.choose(options.theme)
    if options.size:
        application.window.resize(*options.size)
    if options.photo:
        _open_photo(options, application)
    if options.mode:
        application.window.modes.switch(options.mode)
    if options.files:
        application.files.open_dropped(options.files)
    application.window.show()
    if options.dock:
        application.window.bring_to_front(options.dock)
    if options.screenshot:
        from occ_gui.app.screenshot import take_screenshot

        take_screenshot(application, options.screenshot)
        return 0
    _close_on_interrupt(application)
    from occ_gui.widgets.icons import program_icon

    application.window.setWindowIcon(program_icon())
    if start_state.is_new and not (options.files or options.photo or options.mode or options.dock):
        application.shell.pane("welcome").show_once()
    return qt.exec()


def _open_photo(options: argparse.Namespace, application: "Application") -> None:
    application.options.choose_overlay(options.overlay)
    application.photos.open(options.photo, match=options.match)
    if options.dock is None:
        application.window.bring_to_front("photo")


def _check_pane(name: str | None, application: "Application") -> None:
    """Refuse a pane that the window, once made, turns out not to have."""
    docks = application.window.docks
    if name is not None and name not in docks:
        application.stop()
        raise occ.OccError(f"--dock: there is no pane {quote(name)}; allowed: {', '.join(docks)}.")


def _prepare(options: argparse.Namespace) -> None:
    if options.match and not options.photo:
        raise occ.OccError("--match needs a photo; name one with --photo.")
    if options.screenshot:
        if options.screenshot.suffix.lower() != ".png":
            raise occ.OutputError(
                f"{one_line(str(options.screenshot))}: a screenshot is a .png file; name one."
            )
        # Imported here because it imports all commands, which no window needs.
        from occ_model.commands.files import check_files

        check_files(options)
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
        # A photo that cannot be read is refused here, and not drawn as an empty pane.
        if options.photo:
            occ.load_photo(options.photo)


def _close_on_interrupt(application: "Application") -> None:
    from PySide6.QtCore import QTimer

    window = application.window

    def close() -> None:
        window.may_close = lambda: True  # who stops the program from a shell is asked nothing
        window.close()

    # Not at once, because the window may be painting when the signal comes.
    signal.signal(signal.SIGINT, lambda *_: QTimer.singleShot(0, window, close))
    # Python handles signals only while it runs, so this timer makes Qt call it.
    timer = QTimer(application)
    timer.timeout.connect(lambda: None)
    timer.start(_CHECK_MS)


def start(
    workspace: Workspace, arguments: list[str], preferences: "QSettings | None" = None
) -> "tuple[QApplication, Application]":
    """Create the application with a hidden window; without ``preferences`` nothing is stored."""
    if sys.platform == "linux" and not any(os.environ.get(name) for name in _DISPLAYS):
        # Qt would print several lines instead.
        from occ_gui.app.display import NO_DISPLAY

        raise occ.OccError(NO_DISPLAY)
    gc.disable()  # from now on garbage is collected on this thread only
    # Importing Qt takes a quarter of a second, which --help and a wrong preset do not need.
    from PySide6.QtCore import QLocale
    from PySide6.QtWidgets import QApplication

    # PySide's own import searches the source of each module for a request of snake_case names. Ours
    # have none, and the search takes a thirteenth of the start-up time.
    builtins.__import__ = _PYTHON_IMPORT
    from occ_gui.app.application import Application
    from occ_gui.app.error_reports import log_qt_messages
    from occ_gui.app.garbage_collection import GarbageCollector
    from occ_gui.widgets.icons import PROGRAM
    from occ_gui.window.theme import show_theme

    # Short time slices, because the threads that start processes delay the window's thread.
    sys.setswitchinterval(_TIME_SLICE_S)
    log_qt_messages(_end_without_display)
    # Numbers have the same form in the whole window as in files and sentences.
    QLocale.setDefault(QLocale.c())
    qt = QApplication(arguments)
    qt.setDesktopFileName(PROGRAM)
    log_qt_messages()
    show_theme("system")  # before there are panes to redraw
    garbage = GarbageCollector(qt)
    application = Application(workspace, preferences)
    garbage.exclude_present_objects()
    application.window.closing.connect(garbage.include_all_objects)
    return qt, application


def _end_without_display() -> NoReturn:
    # The display does not answer, or its plug-in cannot be loaded: Qt would abort the process.
    from occ_gui.app.display import explain_no_window

    say("occ-gui", explain_no_window())
    os._exit(EXIT_MISUSE)
