"""Code entry: the transmitted code as a number and as bits, or a payload in its place."""

import re

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLineEdit, QWidget

from occ_gui.scene.count_edit import CountEdit
from occ_gui.scene.gesture import Gestures
from occ_gui.scene.refusal_notice import RefusalNotice
from occ_gui.widgets.event_filters import leave_undo_to_window
from occ_model.errors import ParameterError, shown
from occ_model.scene.parameters import count, payload_parameter
from occ_model.scene.scene import Scene


class CodeEntry(QWidget):
    """Two fields that show the code as a number and as bits; either can be edited.

    The field of the bits also takes a payload, such as ``text:HELLO``, and shows it; emptied, it
    shows the code again.
    """

    edited = Signal(str, object, int)
    """The parameter's name, code or payload, its value, and the number of the gesture."""

    refused = Signal(str)
    """The reason why an input is not valid."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._bits, self._code, self._payload = 0, -1, ""
        self._gestures = Gestures()
        self.number = CountEdit(count("code"))
        self.number.setAccessibleName(self.tr("Code as a number"))
        self.bits = QLineEdit()
        self.bits.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.bits.setAccessibleName(self.tr("Code as bits"))
        self.bits.setToolTip(
            self.tr("The bits, the first sent first; or a payload, such as text:HELLO.")
        )
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setVerticalSpacing(1)
        layout.setColumnStretch(1, 1)
        self.notices = (RefusalNotice(self.number), RefusalNotice(self.bits))
        for place, field in enumerate((self.number, self.bits)):
            layout.addWidget(field, 0, place)
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
        self.setEnabled(not transmitter.pattern)
        self.number.setEnabled(not transmitter.payload)
        shown = (self._bits, self._code, self._payload)
        if (transmitter.bits, transmitter.code, transmitter.payload) == shown:
            return
        self._bits, self._payload = transmitter.bits, transmitter.payload
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
        self._write()

    def _write(self) -> None:
        """Write what is sent in the field of the bits."""
        self.bits.setText(self._payload or f"{self._code:0{self._bits}b}")
        self.bits.setCursorPosition(0)

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
        typed = self.bits.text()
        if self._payload and typed == self._payload:
            self.notices[1].end()
            return
        if ":" in typed or (self._payload and not typed.strip()):
            self._enter_payload(typed.strip() and typed)
            return
        text = "".join(typed.split())
        if re.fullmatch(f"[01]{{{self._bits}}}", text):
            self.bits.setText(text)
            self.notices[1].end()
            if self._payload:
                self._enter_payload("")
            if int(text, 2) != self._code:
                self._enter(int(text, 2))
            return
        self._write()
        sentence = self.tr("The bits are {text}; allowed: {bits} characters 0 and 1.").format(
            text=shown(text), bits=self._bits
        )
        self._refuse(sentence)

    def _enter_payload(self, text: str) -> None:
        try:
            payload = payload_parameter().parse(text)
        except ParameterError as error:
            self._write()
            self._refuse(str(error))
            return
        self.end_refusal()
        changed = payload != self._payload
        self._payload = payload
        self.number.setEnabled(not payload)
        self._write()
        if changed:
            self.edited.emit("payload", payload, self._gestures.of_change())

    def _refuse(self, sentence: str) -> None:
        self.notices[1].show_refusal(sentence)
        self.refused.emit(sentence)
