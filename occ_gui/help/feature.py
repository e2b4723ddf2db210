"""The manual, declared."""

from collections.abc import Callable

from PySide6.QtWidgets import QMainWindow

from occ_gui.shell.feature import Feature, Service
from occ_gui.shell.shell import Shell

_CONTROLS = {"controls": "guide.md#set-up-a-scene"}
"""Page and heading that explain the controls, which are no declared pane."""


def manual(window: QMainWindow, shell: Shell, current_pane: Callable[[], str]) -> Feature[None]:
    def make() -> Service:
        from occ_gui.help.help_window import Manual

        return Manual(window, current_pane, {**_CONTROLS, **shell.help_pages})

    return Feature(
        name="help",
        make=make,
        commands={
            "guide": lambda manual: manual.show_page(),
            "about_pane": lambda manual: manual.show_pane(),
        },
    )
