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
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

LIBRARIES = ("PySide6-Essentials", "pyqtgraph", "numpy", "opencv-contrib-python-headless", "Pillow")
"""Packages whose versions decide what is seen."""

_SIZE = (640, 480)


def report_text(scene: Scene, settings: SimulationSettings, messages: Iterable[str]) -> str:
    """Return the report, with ``~`` for the user's folder; a message may still name a file."""
    screen = QGuiApplication.primaryScreen()
    home = str(Path.home())
    logged = [line.replace(home, "~") for line in messages] or ["nothing was logged"]
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
            *logged,
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
    shown = name_widget(QPlainTextEdit(text, readOnly=True), "Text of the report")
    shown.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    copy = buttons.addButton("&Copy", QDialogButtonBox.ButtonRole.ActionRole)
    buttons.rejected.connect(dialog.reject)
    advice = paragraph(
        "Copy this into a report of a mistake. Read it first: a message may name a file."
    )
    # The status line is behind the dialog.
    copy.clicked.connect(lambda: advice.setText(copy_text(text)))
    fill(QVBoxLayout(dialog), advice, shown, buttons)
    dialog.resize(*_SIZE)
    dialog.open()
