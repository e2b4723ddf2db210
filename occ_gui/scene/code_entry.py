"""Code entry: the transmitted code as a number and as bits, or a payload in its place."""

import re

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QWidget

from occ_gui.scene.number_edits import CountEdit
from occ_gui.scene.refusal_notice import RefusalNotice
from occ_gui.scene.scene_store import Gestures
from occ_gui.widgets.event_filters import leave_undo_to_window
from occ_model.errors import ParameterError, inflect, one_line, quote
from occ_model.scene.light_words import describe_light
from occ_model.scene.parameters import count, payload_parameter
from occ_model.scene.payload import form_of
from occ_model.scene.refusal import refusal_of
from occ_model.scene.scene import Scene

_MOST_DIGITS = 20


class CodeEntry(QWidget):
    """Two fields that show the code as a number and as bits; either can be edited.

    The field of the bits also accepts a payload, such as ``HELLO``, which is then shown alone; when
    cleared, it shows the code again. Invalid text stays, with the reason, until it is corrected.
    """

    edited = Signal(str, object, int)
    """The parameter, code or payload, its value, and the number of the gesture."""

    refused = Signal(str)  # the reason why an input is not valid

    def __init__(self) -> None:
        super().__init__()
        self._bits, self._code, self._payload = 0, -1, ""
        self._gestures = Gestures()
        self.title = QLabel()  # what is sent; shown above the fields
        self.number = CountEdit(count("code"))
        self.number.setAccessibleName("Code as a number")
        self.bits = QLineEdit()
        self.bits.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.bits.setAccessibleName("Code as bits")
        self.bits.setToolTip("The bits in the order sent, or a text to send, such as HELLO.")
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setVerticalSpacing(1)
        layout.setColumnStretch(1, 1)
        self.notices = (self.number.notice, RefusalNotice(self.bits))
        for column, field in enumerate((self.number, self.bits)):
            layout.addWidget(field, 0, column)
        for line in (self.number.lineEdit(), self.bits):
            line.textEdited.connect(self._gestures.end)
        leave_undo_to_window(self.bits)
        self.number.valueChanged.connect(self._enter)
        self.number.accepted.connect(self.end_refusal)
        self.number.refused.connect(self.refused)
        self.bits.editingFinished.connect(self._read_bits)
        self.notices[1].dismissed.connect(self._show_bits)
        self._show_title(None)

    def show_scene(self, scene: Scene) -> None:
        transmitter = scene.transmitter
        self.title.setVisible(transmitter.light == "code")
        self.setVisible(transmitter.light == "code" and not transmitter.pattern)
        self._show_title(scene)
        last_values = (self._bits, self._code, self._payload)
        if (transmitter.bits, transmitter.code, transmitter.payload) == last_values:
            return
        self._bits, self._payload = transmitter.bits, transmitter.payload
        with QSignalBlocker(self.number):
            self.number.limit(2**self._bits - 1)
        self.number.setToolTip(f"The code sent, from 0 to {2**self._bits - 1}.")
        self._display(transmitter.code)

    def _show_title(self, scene: Scene | None) -> None:
        if scene is not None and scene.transmitter.pattern:
            text = f"Sent: {describe_light(scene.transmitter)}"
        elif scene is not None and scene.transmitter.payload:
            form = form_of(scene.transmitter.payload)
            form = "bytes" if form == "hex" else form
            text = f"Sent as {form}: {inflect(scene.transmitter.payload_length, 'bit')}"
        else:
            text = "Code, as a number and as bits"
        if text != self.title.text():
            self.title.setText(text)
            self.number.setVisible(scene is None or not scene.transmitter.payload)

    def _display(self, code: int) -> None:
        self._code = code
        with QSignalBlocker(self.number):
            self.number.setValue(code)
        self._show_bits()

    def _show_bits(self) -> None:
        self.bits.setText(self._bits_text)
        self.bits.setCursorPosition(0)
        self.notices[1].end()

    @property
    def _bits_text(self) -> str:
        return payload_parameter().format(self._payload) or f"{self._code:0{self._bits}b}"

    def show_problem(self, sentence: str, *, stays: bool) -> None:
        self.notices[0].show_problem(sentence, stays=stays)

    def end_refusal(self) -> None:
        """Remove the notices, except one about text that the field still shows."""
        self.notices[0].end()
        if self.bits.text() == self._bits_text:
            self.notices[1].end()

    def _enter(self, code: int) -> None:
        self.end_refusal()
        self._display(code)
        self.edited.emit("code", code, self._gestures.of_change())

    def _read_bits(self) -> None:
        typed_text = self.bits.text()
        text = "".join(typed_text.split())
        if typed_text == self._bits_text:
            self.notices[1].end()
        elif not text and not self._payload:
            self._show_bits()
        elif text and set(text) <= set("0123456789"):
            self._read_digits(text)
        else:
            self._enter_payload(typed_text)

    def _read_digits(self, text: str) -> None:
        if not re.fullmatch(f"[01]{{{self._bits}}}", text):
            sentence = (
                f"The bits cannot be {quote(text)}; allowed: {self._bits} characters 0 and 1. As a "
                f"text: text:{one_line(text, _MOST_DIGITS)}."
            )
            self._refuse(sentence)
            return
        self._enter_payload("")
        self._show_bits()
        if int(text, 2) != self._code:
            self._enter(int(text, 2))

    def _enter_payload(self, text: str) -> None:
        try:
            payload = payload_parameter().parse(text)
        except ParameterError as error:
            self._refuse(refusal_of(error))
            return
        self.notices[0].end()
        is_changed = payload != self._payload
        self._payload = payload
        self._show_bits()
        if is_changed:
            self.edited.emit("payload", payload, self._gestures.of_change())

    def _refuse(self, sentence: str) -> None:
        self.notices[1].show_problem(sentence)
        self.refused.emit(sentence)
