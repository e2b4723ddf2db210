"""``occ-gui``: read the command line and open the window."""

import argparse
import gc
import os
import re
import signal
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import occ_model as occ
from occ_gui.app.start import DefaultOption, Start, start_of
from occ_model.commands.options import (
    add_scene_options,
    add_simulation_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.errors import one_line, shown
from occ_model.files.writing import write_whole
from occ_model.program import EXIT_MISUSE, run_program, say
from occ_model.scene.from_text import DEFAULT_PRESET
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    from occ_gui.app.application import Application

_DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
"""Environment variables one of which says where a window can be drawn."""

PANES = (
    "controls", "decode", "photo", "profile", "accuracy", "map",
    "equations", "compare", "explorations",
)  # fmt: skip
"""The docks, by their names in the window."""

OVERLAYS = ("beside", "blend", "split", "difference")
"""How a photo can be shown with the simulated picture."""

THEMES = ("system", "light", "dark")
"""Whose colours the window takes."""

_NO_DISPLAY = "There is no display that a window can be opened on; use --screenshot FILE."

_TURN_MS = 200

_TURN_S = 0.001
"""How long a thread may keep the others waiting."""

_LARGEST_SIDE = 16384
"""Pixels of a window's side; a larger one could not be drawn."""

_PATIENCE_MS = 60_000
"""How long a screenshot waits for the picture before it gives up."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the application; return the process's exit code.

    Parameters
    ----------
    arguments
        The command line's words; by default those of this process, which is the window's then.
    """
    is_process = arguments is None
    work = partial(read_command_line, arguments)
    return run_program("occ-gui", work, is_process=is_process, is_window=True)


def read_command_line(arguments: Sequence[str] | None) -> Callable[[], int]:
    """Read a command line; give what opens the window that it asks for."""
    return partial(_start_and_run, _parser().parse_args(arguments))


def _start_and_run(options: argparse.Namespace) -> int:
    settings = simulation_settings_of(options)
    own = settings == simulation_settings_of(_parser().parse_args([]))
    return _run(options, start_of(options, scene_of(options), settings, own))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="occ-gui", description="Explore optical camera communication."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {occ.__version__}")
    add_scene_options(parser)
    add_simulation_options(parser)
    # Noise that keeps up with a slider, and a preset that wins over the last session if named.
    parser.set_defaults(noise="reused", preset=DefaultOption(DEFAULT_PRESET))
    parser.add_argument("--photo", type=Path, metavar="FILE", help="open this photo")
    parser.add_argument(
        "--match", action="store_true", help="match the photo, and let the scene follow it"
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
        "--size", type=_size, metavar="WIDTHxHEIGHT", help="the window's size, such as 1280x800"
    )
    parser.add_argument("--dock", choices=PANES, help="bring this pane to the front")
    parser.add_argument("--theme", choices=THEMES, help="the window's colours")
    parser.add_argument(
        "--fresh", action="store_true", help="start without what the last session left"
    )
    return parser


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{2,5})[xX](\d{2,5})", text)
    width, height = (int(match[1]), int(match[2])) if match else (0, 0)
    if not 0 < max(width, height) <= _LARGEST_SIDE:
        raise argparse.ArgumentTypeError(
            f"{shown(text)} is no size; write it as 1280x800, each up to {_LARGEST_SIDE}"
        )
    return width, height


def _run(options: argparse.Namespace, begin: Start) -> int:
    _prepare(options)
    qt, application = start(begin.scene, sys.argv[:1], begin.settings, begin.memory)
    begin.restore(application, with_photo=options.photo is None)
    if options.theme:
        application.desktop.theme.choose(options.theme)
    if options.size:
        application.window.resize(*options.size)
    if options.photo:
        application.show_mode(options.overlay)
        application.open_photo(options.photo, options.match, front=options.dock is None)
    application.window.show()
    if options.dock:
        application.window.bring_to_front(options.dock)
    if options.screenshot:
        _take_screenshot(application, options.screenshot)
        return 0
    _close_on_interrupt(application)
    return qt.exec()


def _prepare(options: argparse.Namespace) -> None:
    """Refuse what cannot be, before there is a window."""
    if options.match and not options.photo:
        raise occ.OccError("--match needs a photo; name one with --photo.")
    if options.screenshot:
        if options.screenshot.suffix.lower() != ".png":
            raise occ.OutputError(
                f"{one_line(str(options.screenshot))}: a screenshot is a .png file; name one."
            )
        # It imports all commands, which a window has no use for.
        from occ_model.commands.files import check_files

        check_files(options)
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
        # A photo that cannot be read must fail here, not show as an empty pane in the picture.
        if options.photo:
            occ.load_photo(options.photo)


def _close_on_interrupt(application: "Application") -> None:
    """Close the window on Ctrl+C in the terminal that started it."""
    from PySide6.QtCore import QTimer

    signal.signal(signal.SIGINT, lambda *_: application.window.close())
    # Python sees to signals only when it gets a turn, which Qt gives it for this.
    turns = QTimer(application)
    turns.timeout.connect(lambda: None)
    turns.start(_TURN_MS)


def start(
    scene: Scene,
    arguments: list[str],
    settings: SimulationSettings | None = None,
    memory: "QSettings | None" = None,
) -> "tuple[QApplication, Application]":
    """Put the application together, its window not yet shown.

    Parameters
    ----------
    scene
        The scene to begin with.
    arguments
        What Qt may read from the command line.
    settings
        How the scene is simulated at first, by default as suits a slider.
    memory
        What is remembered from one start to the next; by default nothing.
    """
    if sys.platform == "linux" and not any(os.environ.get(name) for name in _DISPLAYS):
        # Qt would find out by itself, but say more about it than helps.
        raise occ.OccError(_NO_DISPLAY)
    gc.disable()  # from here on garbage is collected on this thread, when there is time for it
    # Qt takes a quarter of a second to import: not for --help, nor for a mistyped preset.
    from PySide6.QtCore import QLocale
    from PySide6.QtWidgets import QApplication

    from occ_gui.app.application import Application
    from occ_gui.app.error_reports import log_qt_messages
    from occ_gui.app.garbage_collection import GarbageCollector
    from occ_gui.scene.settings_store import FIRST_SETTINGS

    # The threads that hand work to processes take turns with the window's: shorter ones suit both.
    sys.setswitchinterval(_TURN_S)
    log_qt_messages(_end_without_display)
    # Numbers are read and written in one way in the whole window, as in the files and sentences.
    QLocale.setDefault(QLocale.c())
    qt = QApplication(arguments)
    log_qt_messages()
    garbage = GarbageCollector(qt)
    application = Application(scene, settings or FIRST_SETTINGS, memory)
    garbage.spare()
    application.window.closing.connect(garbage.release)
    return qt, application


def _end_without_display() -> NoReturn:
    # A display that is named but does not answer: only Qt finds out, and it returns to nobody.
    say("occ-gui", _NO_DISPLAY)
    os._exit(EXIT_MISUSE)


def wait_until_shown(application: "Application", measured: bool = False) -> None:
    """Let the window work until all that was asked for is shown.

    Parameters
    ----------
    application
        The window's.
    measured
        Whether to wait for the detection map and the strips under the sliders, too.

    Raises
    ------
    OccError
        The scene has no picture, or it took too long.
    """
    from PySide6.QtCore import QDeadlineTimer, QEventLoop, QTimer
    from PySide6.QtWidgets import QApplication

    failures: list[str] = []
    matching = application.photo_wiring.matching
    for controller in (application.simulation, application.photos, matching):
        controller.failed.connect(failures.append)
    deadline = QDeadlineTimer(_PATIENCE_MS)
    QTimer.singleShot(_PATIENCE_MS, application.window.update)  # wakes the loop in any case
    QApplication.processEvents()  # what is about to begin is no rest
    while not (rests := _is_idle(application, measured)) and not deadline.hasExpired():
        # Waiting, not spinning: the worker needs the interpreter.
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        if _is_idle(application, measured):
            QApplication.processEvents()  # paints, and may set something going again
    if failures:
        raise occ.OccError(failures[0])
    if not rests:
        raise occ.OccError(f"There was no picture after {_PATIENCE_MS // 1000} s.")


def _is_idle(application: "Application", measured: bool) -> bool:
    shown = application.is_idle and application.study.is_idle
    return shown and (application.detection_map.is_idle or not measured)


def _take_screenshot(application: "Application", path: Path) -> None:
    """Write a picture of the window, once everything is shown."""
    from PySide6.QtCore import QBuffer, QIODevice

    try:
        wait_until_shown(application, measured=True)
        buffer = QBuffer()
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        if not application.window.grab().save(buffer, "PNG"):
            raise occ.OutputError(
                f"{one_line(str(path))} cannot be written: the window cannot be drawn."
            )
    finally:
        application.window.close()
    write_whole(path, bytes(buffer.data().data()))
