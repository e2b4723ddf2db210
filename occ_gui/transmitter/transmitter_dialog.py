"""The dialog of the transmitter: board, frequency that is sent, wiring, and saving."""

from collections.abc import Mapping

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFontDatabase, QImage, QPixmap
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QPlainTextEdit,
    QPushButton,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.widgets.building import KeyedComboBox, fill, name_widget, paragraph
from occ_gui.widgets.plain_text import copy_text

_FIGURE = QSize(700, 553)  # size of the wiring on the screen, in the proportions of its figure


class TransmitterDialog(QDialog):
    board_chosen = Signal(str)

    frequency_asked = Signal()  # the user sets the scene to the sent frequency

    save_asked = Signal()

    def __init__(self, boards: Mapping[str, str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Transmitter: send this scene with an LED")
        self.board = KeyedComboBox("Board", "The board that blinks the LED.", boards)
        self.board.chosen.connect(self.board_chosen)
        self.facts = paragraph(name="What is sent", is_selectable=True)
        self.note = paragraph(name="Result of saving", is_selectable=True)
        self.wiring = paragraph(name="Wiring")
        self.wiring.setFixedSize(_FIGURE)
        self.wiring.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.sketch = name_widget(QPlainTextEdit(readOnly=True), "Sketch")
        self.sketch.setToolTip("The program that the board runs.")
        self.sketch.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.sketch.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.sketch.setTabChangesFocus(True)
        pages = QTabWidget()
        pages.addTab(self.wiring, "Wiring")
        pages.addTab(self.sketch, "Sketch")
        form = QFormLayout()
        form.addRow("&Board", self.board)
        form.addRow("Sent", self.facts)
        fill(QVBoxLayout(self), form, pages, self.note, self._make_buttons())

    def _make_buttons(self) -> QDialogButtonBox:
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        roles = QDialogButtonBox.ButtonRole
        self.save = buttons.addButton("&Save files…", roles.ActionRole)
        self.save.setToolTip(
            "Choose where to make a new folder with sketch, waveform, wiring and scene."
        )
        self.copy = buttons.addButton("&Copy the sketch", roles.ActionRole)
        self.copy.setToolTip("Copy the text of the sketch, to paste it into the board's editor.")
        self.copy.clicked.connect(lambda: copy_text(self.sketch.toPlainText()))
        self.take = buttons.addButton("&Use this frequency", roles.ActionRole)
        self.take.setToolTip("Set the scene to the frequency that the board actually sends.")
        close: QPushButton = buttons.button(QDialogButtonBox.StandardButton.Close)
        close.setToolTip("Close this dialog.")
        self.save.clicked.connect(self.save_asked)
        self.take.clicked.connect(self.frequency_asked)
        buttons.rejected.connect(self.reject)
        return buttons

    def show_transmission(self, facts: str, sketch: str, is_rounded: bool) -> None:
        self.facts.setText(facts)
        self._show_sketch(sketch)
        self.take.setEnabled(is_rounded)
        self.save.setEnabled(True)
        self.replace_wiring("Drawing the wiring…")

    def _show_sketch(self, text: str) -> None:
        self.sketch.setPlainText(text)
        self.copy.setEnabled(bool(text))

    def show_refusal(self, sentence: str) -> None:
        self.facts.setText(sentence)
        self._show_sketch("")
        self.take.setEnabled(False)
        self.save.setEnabled(False)
        self.replace_wiring("")

    def show_wiring(self, png: bytes, text: str) -> None:
        image = QImage.fromData(png)
        image.setDevicePixelRatio(image.width() / _FIGURE.width())
        self.wiring.setPixmap(QPixmap.fromImage(image))
        self.wiring.setAccessibleDescription(text)

    def replace_wiring(self, text: str) -> None:
        self.wiring.clear()  # setting an empty text would not remove the picture
        self.wiring.setText(text)
        self.wiring.setAccessibleDescription("")
