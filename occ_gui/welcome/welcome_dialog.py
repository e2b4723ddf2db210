"""Welcome: three doors into the program, shown at the first start and from the menu."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.welcome.door import Door
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.named import paragraph
from occ_gui.widgets.text_scale import emboldened

_LARGER = 1.5


class WelcomeDialog(QDialog):
    """Asks what the user wants to do first; closing it means to explore freely."""

    chosen = Signal(str)  # the door: ``learn``, ``photo`` or ``explore``

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Welcome")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        title = emboldened(QLabel("Light that carries bits"), _LARGER)
        about = paragraph(
            "An LED panel blinks a code, a phone's camera photographs it as stripes, and the "
            "code is read back from them. See how, and where it ends."
        )
        self.doors = {
            "learn": Door(
                "door-learn",
                "Learn in five minutes",
                "See how a rolling shutter turns a blinking lamp into stripes.",
            ),
            "photo": Door(
                "door-photo",
                "Match my photo",
                "Open a photo of a blinking LED, and measure the camera with it.",
            ),
            "explore": Door(
                "door-explore",
                "Free exploration",
                "Move the sliders, and watch picture, profile and code follow.",
            ),
        }
        width = max(door.size_for().width() for door in self.doors.values())
        height = max(door.size_for(width).height() for door in self.doors.values())
        row = QHBoxLayout()
        row.setSpacing(16)
        for name, door in self.doors.items():
            door.setFixedSize(width, height)
            door.setProperty("door", name)
            door.clicked.connect(self._choose)
            row.addWidget(door)
        filled(QVBoxLayout(self), title, about, row, margins=24, spacing=16)

    def _choose(self) -> None:
        name = self.sender().property("door")
        self.accept()
        self.chosen.emit(name)
