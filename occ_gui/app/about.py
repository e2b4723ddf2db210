"""The dialog that tells the program's version and what it does."""

from PySide6.QtWidgets import QMessageBox, QWidget

import occ_model as occ


def show_about(window: QWidget) -> None:
    QMessageBox.about(
        window,
        "About",
        (
            f"Optical Camera Communication {occ.__version__}\n\nSimulates the pictures "
            "that a rolling-"
            "shutter camera takes of a blinking LED panel, and decodes the code in them."
        ),
    )
