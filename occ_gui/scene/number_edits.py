"""Fields for plain numbers, whole as ``0b101`` or ``0x1f`` too, or with a decimal comma.

Any text can be typed; what is no allowed number is refused with a sentence. Qt's own would read
``1,5`` as 15, and leave out the characters that it does not allow.
"""

from dataclasses import replace

from PySide6.QtCore import Signal
from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QDoubleSpinBox, QSpinBox

from occ_gui.widgets.event_filters import leave_undo_to_window, select_numbers_whole
from occ_model.errors import ParameterError
from occ_model.scene.parameter_kinds import Count, Quantity
from occ_model.scene.refusal import refusal_of


class CountEdit(QSpinBox):
    accepted = Signal()  # what was typed is an allowed number, also if it is the one shown before
    refused = Signal(str)  # why an input is not valid; the field shows the last value again

    def __init__(self, declared: Count) -> None:
        super().__init__()
        self._declared = declared
        self.setRange(declared.low, declared.high)
        _prepare(self)

    def limit(self, high: int) -> None:
        self._declared = replace(self._declared, high=high)
        self.setRange(self._declared.low, high)

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        return QValidator.State.Acceptable, text, position

    def valueFromText(self, text: str) -> int:  # noqa: N802 - Qt's name
        return int(_read(self, self._declared, text.strip()))


class DecimalEdit(QDoubleSpinBox):
    accepted = Signal()  # as of a whole number
    refused = Signal(str)

    def __init__(self, declared: Quantity, decimals: int) -> None:
        super().__init__()
        self._declared = declared
        self.setDecimals(decimals)
        self.setRange(declared.low, declared.high)
        if declared.unit.symbol:
            self.setSuffix(f" {declared.unit.symbol}")
        _prepare(self)

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        return QValidator.State.Acceptable, text, position

    def valueFromText(self, text: str) -> float:  # noqa: N802 - Qt's name
        # Qt keeps its own unit behind one that is typed.
        return _read(self, self._declared, text.removesuffix(self.suffix()))


def _prepare(field: CountEdit | DecimalEdit) -> None:
    field.setKeyboardTracking(False)
    leave_undo_to_window(field)
    select_numbers_whole(field)


def _read(field: CountEdit | DecimalEdit, declared: Count | Quantity, text: str) -> float:
    """Read the typed number; the last value stays where it is refused."""
    try:
        value = declared.parse(text)
    except ParameterError as error:
        field.refused.emit(refusal_of(error))
        return field.value()
    field.accepted.emit()
    return value
