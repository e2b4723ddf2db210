"""Count field: a whole number, also as ``0b101`` or ``0x1f``; anything else is refused."""

from dataclasses import replace

from PySide6.QtCore import Signal
from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QSpinBox

from occ_gui.widgets.event_filters import leave_undo_to_window, select_numbers_whole
from occ_model.errors import ParameterError
from occ_model.scene.parameter_kinds import Count
from occ_model.scene.refusal import refusal_of


class CountEdit(QSpinBox):
    """A number field that lets any text be typed, and refuses what is no allowed number.

    Qt's own would read ``1,5`` as 15, and leave out the characters that it does not allow.
    """

    accepted = Signal()  # what was typed is an allowed number, also if it is the one shown before

    refused = Signal(str)
    """The reason why an input is not valid; the field shows the last value again."""

    def __init__(self, declared: Count) -> None:
        super().__init__()
        self._declared = declared
        self.setRange(declared.low, declared.high)
        self.setKeyboardTracking(False)
        leave_undo_to_window(self)
        select_numbers_whole(self)

    def limit(self, high: int) -> None:
        self._declared = replace(self._declared, high=high)
        self.setRange(self._declared.low, high)

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Allow any text to be typed; invalid text is refused with a sentence at the end."""
        return QValidator.State.Acceptable, text, position

    def valueFromText(self, text: str) -> int:  # noqa: N802 - Qt's name
        """Read the typed number; the last value stays where it is refused."""
        try:
            value = self._declared.parse(text.strip())
        except ParameterError as error:
            self.refused.emit(refusal_of(error))
            return self.value()
        self.accepted.emit()
        return value
