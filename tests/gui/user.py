"""Somebody at the window: types, chooses from menus, waits and looks."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QSlider
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.parameter_rows import CountRow, QuantityRow
from occ_model.scene.scene import Scene

PATIENCE_S = 120.0
"""How long is waited at most: only what hangs takes so long, however busy the machine is."""


class PatientQtBot(QtBot):
    """pytest-qt's robot, which waits as long as a busy machine needs in place of 5 s."""

    def waitUntil(  # noqa: N802 - the name is pytest-qt's
        self, callback: Callable[[], bool | None], *, timeout: int = round(1e3 * PATIENCE_S)
    ) -> None:
        """Wait until the callback returns true, or no longer fails."""
        super().waitUntil(callback, timeout=timeout)

    def waitSignal(  # noqa: N802
        self, signal: Any, *, timeout: int = round(1e3 * PATIENCE_S), **options: Any
    ) -> Any:
        """Wait for a signal at the end of a ``with`` block."""
        return super().waitSignal(signal, timeout=timeout, **options)


class User:
    """What a user does at the window, by keys and menus as far as possible."""

    def __init__(self, qtbot: QtBot, application: Application) -> None:
        self._qtbot = qtbot
        self._application = application

    def wait_until_idle(self) -> None:
        self._qtbot.waitUntil(lambda: self._application.is_idle)

    def row(self, name: str) -> QuantityRow | CountRow:
        panels = self._application.controls.panels.values()
        (row,) = [panel.rows[name] for panel in panels if name in panel.rows]
        assert isinstance(row, QuantityRow | CountRow)
        return row

    def slider(self, name: str) -> QSlider:
        row = self.row(name)
        assert isinstance(row, QuantityRow)
        return row.slider

    def enter(self, name: str, text: str) -> None:
        field = self.row(name).field
        field.selectAll()
        self._qtbot.keyClicks(field, text)
        self._qtbot.keyClick(field, Qt.Key.Key_Return)
        self.wait_until_idle()

    def choose(self, text: str) -> None:
        """Choose the menu entry whose text starts like this, and wait."""
        self.entry(text).trigger()
        self.wait_until_idle()

    def entry(self, text: str) -> QAction:
        actions = self._application.window.findChildren(QAction)
        (found,) = [action for action in actions if action.text().startswith(text)]
        return found

    def press(self, button: QAbstractButton) -> None:
        button.click()
        self.wait_until_idle()

    def change(self, **parameters: Any) -> None:
        """Change parameters of the scene, and wait."""
        self._application.scene_store.change(**parameters)
        self.wait_until_idle()

    def put(self, scene: Scene, title: str) -> None:
        self._application.scene_store.put(scene, title)
        self.wait_until_idle()

    def open_photo(self, path: Path) -> None:
        self._application.files.open_photo(path)
        self.wait_until_idle()

    def switch(self, mode: str) -> None:
        self._application.window.modes.switch(mode)
        self.wait_until_idle()

    def bring_to_front(self, pane: str) -> None:
        self._application.window.bring_to_front(pane)
        self.wait_until_idle()

    def choose_next_preset(self) -> str:
        self._qtbot.keyClick(self._application.controls.preset, Qt.Key.Key_Down)
        self.wait_until_idle()
        return str(self._application.controls.preset.currentData())

    @property
    def message(self) -> str:
        return self._application.window.statusBar().currentMessage()
