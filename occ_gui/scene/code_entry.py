"""Code entry: the transmitted code as a number and as bits, side by side."""

import re

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLineEdit, QWidget

from occ_gui.scene.count_edit import CountEdit
from occ_gui.scene.gesture import Gestures
from occ_gui.scene.refusal_notice import RefusalNotice
from occ_gui.widgets.event_filters import leave_undo_to_window
from occ_model.errors import shown
from occ_model.scene.parameters import count
from occ_model.scene.scene import Scene


class CodeEntry(QWidget):
    """Two fields that show the code as a number and as bits; either can be edited."""

    edited = Signal(str, object, int)
    """The parameter's name, the code, and the number of the gesture."""

    refused = Signal(str)
    """The reason why an input is not valid."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._bits, self._code = 0, -1
        self._gestures = Gestures()
        self.number = CountEdit(count("code"))
        self.number.setAccessibleName(self.tr("Code as a number"))
        self.bits = QLineEdit()
        self.bits.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.bits.setAccessibleName(self.tr("Code as bits"))
        self.bits.setToolTip(self.tr("The bits, the first sent first."))
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setVerticalSpacing(1)
        layout.setColumnStretch(1, 1)
        self.notices = (RefusalNotice(self.number), RefusalNotice(self.bits))
        for place, field in enumerate((self.number, self.bits)):
            layout.addWidget(field, 0, place)
            layout.addWidget(self.notices[place], 1 + place, 0, 1, 2)
        for line in (self.number.lineEdit(), self.bits):
            line.textEdited.connect(self._gestures.end)
        leave_undo_to_window(self.bits)
        self.number.valueChanged.connect(self._enter)
        self.number.accepted.connect(self.end_refusal)
        self.number.refused.connect(self.show_refusal)
        self.number.refused.connect(self.refused)
        self.bits.editingFinished.connect(self._read_bits)

    def show_scene(self, scene: Scene) -> None:
        """Show the code of a scene without emitting a signal."""
        transmitter = scene.transmitter
        # A raw pattern or a payload is sent in place of the code.
        self.setEnabled(not transmitter.pattern and not transmitter.payload)
        if (transmitter.bits, transmitter.code) == (self._bits, self._code):
            return
        self._bits = transmitter.bits
        self.number.blockSignals(True)
        self.number.limit(2**self._bits - 1)
        self.number.blockSignals(False)
        self.number.setToolTip(
            self.tr("The code sent, from 0 to {largest}.").format(largest=2**self._bits - 1)
        )
        self._display(transmitter.code)

    def _display(self, code: int) -> None:
        self._code = code
        self.number.blockSignals(True)
        self.number.setValue(code)
        self.number.blockSignals(False)
        self.bits.setText(f"{code:0{self._bits}b}")

    def show_refusal(self, sentence: str) -> None:
        """Show why a code was refused."""
        self.notices[0].show_refusal(sentence)

    def show_problem(self, sentence: str) -> None:
        """Show what is wrong with the present code."""
        self.notices[0].show_problem(sentence)

    def end_refusal(self) -> None:
        """Remove what was shown."""
        for notice in self.notices:
            notice.end()

    def _enter(self, code: int) -> None:
        self.end_refusal()
        self._display(code)
        self.edited.emit("code", code, self._gestures.of_change())

    def _read_bits(self) -> None:
        text = "".join(self.bits.text().split())
        if re.fullmatch(f"[01]{{{self._bits}}}", text):
            self.bits.setText(text)
            self.notices[1].end()
            if int(text, 2) != self._code:
                self._enter(int(text, 2))
            return
        self.bits.setText(f"{self._code:0{self._bits}b}")
        sentence = self.tr("The bits are {text}; allowed: {bits} characters 0 and 1.").format(
            text=shown(text), bits=self._bits
        )
        self.notices[1].show_refusal(sentence)
        self.refused.emit(sentence)
