"""The report of a mistake: it has what is asked for, and its window copies it."""

import logging
from pathlib import Path

from gui.kinds import add_widget
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QDialog, QLabel, QPlainTextEdit, QPushButton, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.error_reports import ErrorReports
from occ_gui.app.report import report_text, show_report
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


def test_it_has_the_version_and_the_scene_and_hides_the_users_folder() -> None:
    scene = occ.load_preset("phone-68us")
    text = report_text(scene, SimulationSettings(), [])
    assert occ.__version__ in text
    assert occ.Scene.from_toml(text.partition("Scene:\n")[2]) == scene
    text = report_text(Scene(), SimulationSettings(), [f'File "{Path.home() / "a.py"}", line 3'])
    assert str(Path.home()) not in text
    assert "~" in text


def test_it_has_what_was_logged_last(qapp: QApplication) -> None:
    reports = ErrorReports()
    reports.install()
    try:
        logging.getLogger("occ_gui").warning("the lamp is %s", "off")
    finally:
        reports.remove()
    logging.getLogger("occ_gui").debug("and this is not wanted")
    assert [line.endswith("the lamp is off") for line in reports.last.lines] == [True]


def test_it_is_shown_and_copied(qtbot: QtBot) -> None:
    window = add_widget(qtbot, QWidget())
    shown = report_text(Scene().replace(iso=456.0), SimulationSettings(), [])
    assert "iso = 456" in shown
    show_report(window, shown)
    (dialog,) = window.findChildren(QDialog)
    (field,) = dialog.findChildren(QPlainTextEdit)
    assert field.toPlainText() == shown
    (copy,) = [b for b in dialog.findChildren(QPushButton) if b.text() == "&Copy"]
    copy.click()
    assert QGuiApplication.clipboard().text() == shown
    assert any(label.text().startswith("Copied: ") for label in dialog.findChildren(QLabel))
    dialog.reject()
