"""The dialog that tells the program's version and what it does."""

from PySide6.QtWidgets import QMessageBox, QWidget

import occ_model as occ


def show_about(window: QWidget) -> None:
    """Show the dialog over a window."""
    QMessageBox.about(
        window,
        window.tr("About"),
        window.tr(
            "Optical Camera Communication {version}\n\nSimulates the pictures that a rolling-"
            "shutter camera takes of a blinking LED panel, and decodes the code in them."
        ).format(version=occ.__version__),
    )
