"""Undo in a field takes back what is being typed, or else the scene's last step."""

import pytest
from gui.user import User
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractSpinBox, QLineEdit, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.scene.scene import Scene

CTRL = Qt.KeyboardModifier.ControlModifier


def field_of(application: Application, name: str) -> QLineEdit | QAbstractSpinBox:
    if name == "code":
        return application.controls.code.bits
    row = next(p.rows[name] for p in application.controls.panels.values() if name in p.rows)
    field: QWidget = row.field  # type: ignore[attr-defined]
    assert isinstance(field, QLineEdit | QAbstractSpinBox)
    return field


@pytest.mark.parametrize(
    ("name", "typed"),
    [("iso", "250"), ("bits", "12"), ("pattern", "1100"), ("code", "0000000001")],
)
def test_undo_after_entering_a_value_restores_the_scene(
    qtbot: QtBot, application: Application, user: User, small_scene: Scene, name: str, typed: str
) -> None:
    application.window.activateWindow()
    qtbot.waitActive(application.window)
    field = field_of(application, name)
    application.window.show()
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, typed)
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert application.store.scene != small_scene
    field.setFocus()
    qtbot.keyClick(field, Qt.Key.Key_Z, CTRL)
    assert application.store.scene == small_scene
    user.wait_until_idle()


def test_undo_while_typing_takes_back_the_letters_alone(
    qtbot: QtBot, application: Application, small_scene: Scene
) -> None:
    application.store.change(iso=200.0)
    application.window.activateWindow()
    qtbot.waitActive(application.window)
    row = application.controls.main_rows()["iso"]
    assert isinstance(row, QuantityRow)
    row.field.setFocus()
    row.field.selectAll()
    qtbot.keyClicks(row.field, "31")
    qtbot.keyClick(row.field, Qt.Key.Key_Z, CTRL)
    assert row.field.lineEdit().text() != "31"
    assert application.store.scene.camera.iso == 200.0
