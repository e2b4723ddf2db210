"""The report of a mistake: it has what is asked for, and its window copies it."""

import logging
from pathlib import Path

from gui.user import User
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QDialog, QLabel, QPlainTextEdit, QPushButton

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.app.report import report_text
from occ_model.scene.simulation_settings import SimulationSettings


def test_it_has_the_version_and_the_scene(application: Application) -> None:
    scene = occ.load_preset("phone-68us")
    text = report_text(scene, SimulationSettings(), [])
    assert occ.__version__ in text
    assert occ.Scene.from_toml(text.partition("Scene:\n")[2]) == scene


def test_it_hides_the_users_folder(application: Application) -> None:
    text = report_text(
        application.store.scene, SimulationSettings(), [f'File "{Path.home() / "a.py"}", line 3']
    )
    assert str(Path.home()) not in text
    assert "~" in text


def test_it_has_what_was_logged_last(application: Application) -> None:
    reports = application.error_reports
    reports.install()
    try:
        logging.getLogger("occ_gui").warning("the lamp is %s", "off")
    finally:
        reports.remove()
    logging.getLogger("occ_gui").debug("and this is not wanted")
    assert [line.endswith("the lamp is off") for line in reports.last.lines] == [True]


def test_the_menu_shows_and_copies_it(application: Application, user: User) -> None:
    user.enter("iso", "456")
    application.window.actions_by_name["report"].trigger()
    dialogs = [each for each in application.window.findChildren(QDialog) if each.isVisible()]
    (dialog,) = dialogs
    (field,) = dialog.findChildren(QPlainTextEdit)
    shown = field.toPlainText()
    assert "iso = 456" in shown
    (copy,) = [b for b in dialog.findChildren(QPushButton) if b.text() == "&Copy"]
    copy.click()
    assert QGuiApplication.clipboard().text() == shown
    assert any(label.text().startswith("Copied: ") for label in dialog.findChildren(QLabel))
    dialog.reject()
    QApplication.sendPostedEvents()
