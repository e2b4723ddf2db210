"""Undo in a field reverts what is being typed, or else the last step of the scene."""

import pytest
from gui.pane_bench import ControlsBench
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QAbstractSpinBox, QLineEdit
from pytestqt.qtbot import QtBot

from occ_model.scene.scene import Scene

CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> ControlsBench:
    """Return controls in a window with an undo entry."""
    bench = ControlsBench(qtbot, small_scene)
    undo = bench.scenes.undo_stack.createUndoAction(bench.window)
    undo.setShortcut(QKeySequence.StandardKey.Undo)
    bench.window.addAction(undo)
    bench.window.activateWindow()
    qtbot.waitActive(bench.window)
    return bench


def field_of(bench: ControlsBench, name: str) -> QLineEdit | QAbstractSpinBox:
    if name == "code":
        return bench.controls.code.bits
    panels = bench.controls.panels.values()
    field = next(panel.rows[name].field for panel in panels if name in panel.rows)  # type: ignore[attr-defined]
    assert isinstance(field, QLineEdit | QAbstractSpinBox)
    return field


def test_undo_after_entering_a_value_restores_the_scene(
    qtbot: QtBot, bench: ControlsBench, small_scene: Scene
) -> None:
    entered = {"iso": "250", "bits": "12", "pattern": "1100", "code": "0000000001"}
    for name, typed in entered.items():
        field = field_of(bench, name)
        field.setFocus()
        field.selectAll()
        qtbot.keyClicks(field, typed)
        qtbot.keyClick(field, Qt.Key.Key_Return)
        assert bench.scenes.scene != small_scene, name
        field.setFocus()
        qtbot.keyClick(field, Qt.Key.Key_Z, CTRL)
        assert bench.scenes.scene == small_scene, name


def test_undo_while_typing_reverts_only_the_typed_text(qtbot: QtBot, bench: ControlsBench) -> None:
    bench.scenes.change(iso=200.0)
    field = bench.row("iso").field
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, "31")
    qtbot.keyClick(field, Qt.Key.Key_Z, CTRL)
    assert field.lineEdit().text() != "31"
    assert bench.scenes.scene.camera.iso == 200.0
