"""Visit every mode and pane at several sizes, and list what is cut off there.

As a program, it does so in a process of its own: ``python -m gui.window.size_walk PRESET``, with
QT_SCALE_FACTOR as the environment has it, and prints a fault a line.
"""

import sys
from collections.abc import Callable, Iterator

from gui.layout_faults import find_cut_axis_labels, find_cut_texts, find_faults
from PySide6.QtCore import QEvent, QSize
from PySide6.QtWidgets import QApplication, QTabWidget
from shiboken6 import isValid

from occ_gui.app.application import Application
from occ_gui.values.modes import MODES

LARGE, USUAL, LEAST = QSize(1920, 1080), QSize(1280, 800), QSize(1000, 700)
SIZES = (LARGE, USUAL, LEAST)
"""Largest first: what a pane shows in a large window must not keep it from getting smaller."""

Settle = Callable[[], None]


def walk(
    application: Application, settle: Settle, sizes: tuple[QSize, ...] = SIZES
) -> dict[str, str]:
    """Return each fault in any mode, pane or tab, at any of the sizes, and where it is first."""
    window, faults = application.window, dict[str, str]()
    for size in sizes:
        window.resize(size)
        for place in _list_places(application, settle):
            # A report that has just come may have changed a text that is not laid out yet.
            for _ in range(4):
                QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
            found = [*find_faults(window), *find_cut_texts(window)]
            found += [f"axis {text!r}" for text in find_cut_axis_labels(window)]
            if window.size() != size:
                found.append(f"the window is {_text(window.size())}")
                window.resize(size)
                settle()
            for fault in found:
                faults.setdefault(fault, f"{_text(size)}, {place}")
    return faults


def _text(size: QSize) -> str:
    return f"{size.width()} x {size.height()}"


def _list_places(application: Application, settle: Settle) -> Iterator[str]:
    """Bring each pane of each mode, and each tab of it, to the front, and yield its name."""
    window = application.window
    for mode in MODES:
        window.modes.switch(mode)
        settle()
        yield mode
        for name, dock in window.docks.items():
            if dock.isHidden():
                continue
            window.bring_to_front(name)
            settle()
            yield f"{mode}, {name}"
            for tabs in [tabs for tabs in dock.findChildren(QTabWidget) if tabs.isVisible()]:
                for place in range(1, tabs.count()):
                    if isValid(tabs):
                        tabs.setCurrentIndex(place)
                        settle()
                        yield f"{mode}, {name}, {tabs.tabText(place)}"
                tabs.setCurrentIndex(0)


def main(preset: str) -> None:
    import occ_model as occ
    from occ_gui.app.command_line import start
    from occ_gui.app.screenshot import wait_until_shown
    from occ_gui.core.workspace import Workspace

    _, application = start(Workspace(occ.load_preset(preset)), sys.argv[:1])
    window = application.window
    window.show()

    def settle() -> None:
        wait_until_shown(application)
        for _ in range(4):  # what is laid out asks for more in turn
            QApplication.processEvents()

    settle()
    for fault, place in walk(application, settle).items():
        sys.stdout.write(f"{place}: {fault}\n")
    window.close()
    application.stop()


if __name__ == "__main__":
    main(*sys.argv[1:])
