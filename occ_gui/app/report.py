"""Text of an error report: versions, system, scene, settings, last messages."""

import locale
import platform
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from PySide6.QtCore import QSysInfo, Qt
from PySide6.QtGui import QFontDatabase, QGuiApplication
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QPlainTextEdit, QVBoxLayout, QWidget

import occ_model as occ
from occ_gui.widgets.building import fill, name_widget, paragraph
from occ_gui.widgets.plain_text import copy_text
from occ_model.scene.scene import Scene, SimulationSettings

LIBRARIES = ("PySide6-Essentials", "pyqtgraph", "numpy", "opencv-contrib-python-headless", "Pillow")
"""Packages on whose versions results and appearance depend."""

_SIZE = (640, 480)


def report_text(scene: Scene, settings: SimulationSettings, messages: Iterable[str]) -> str:
    """Return the report, with ``~`` for the user's folder; messages may still name files."""
    screen = QGuiApplication.primaryScreen()
    home = str(Path.home())
    lines = [line.replace(home, "~") for line in messages] or ["nothing was logged"]
    return "\n".join(
        [
            f"occ-explorer {occ.__version__}, Python {platform.python_version()}",
            f"{QSysInfo.prettyProductName()}, {platform.machine()}, "
            f"Qt platform {QGuiApplication.platformName()}, "
            f"screen {screen.size().width()}x{screen.size().height()} "
            f"at {screen.devicePixelRatio():g}, locale {locale.setlocale(locale.LC_CTYPE)}",
            ", ".join(f"{name} {_version(name)}" for name in LIBRARIES),
            f"{settings}",
            "",
            "Last messages:",
            *lines,
            "",
            "Scene:",
            scene.to_toml(),
        ]
    )


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # in a bundle
        return "(bundled)"


def show_report(window: QWidget, text: str) -> None:
    dialog = QDialog(window)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setWindowTitle("Report")
    field = name_widget(QPlainTextEdit(text, readOnly=True), "Text of the report")
    field.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    copy = buttons.addButton("&Copy", QDialogButtonBox.ButtonRole.ActionRole)
    buttons.rejected.connect(dialog.reject)
    advice = paragraph(
        "Copy this into your report of an error. Read it first: a message may name a file."
    )
    # Not in the status line, which the dialog may cover.
    copy.clicked.connect(lambda: advice.setText(copy_text(text)))
    fill(QVBoxLayout(dialog), advice, field, buttons)
    dialog.resize(*_SIZE)
    dialog.open()
