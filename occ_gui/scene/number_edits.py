"""Fields for numbers, which may be typed with a decimal comma, or as ``0b101`` or ``0x1f``.

Any text can be typed; all but allowed numbers are refused with a sentence, which stands below the
field. Qt's own fields would read ``1,5`` as 15, and ignore characters that they do not allow.
"""

from dataclasses import replace

from PySide6.QtCore import QSize, Qt, Signal, SignalInstance
from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QSpinBox

from occ_gui.scene.refusal_notice import RefusalNotice
from occ_gui.widgets.event_filters import leave_undo_to_window, select_number_on_double_click
from occ_model.errors import ParameterError
from occ_model.scene.parameter_kinds import Count, Quantity
from occ_model.scene.refusal import refusal_of


def _validate(_field: object, text: str, position: int) -> tuple[QValidator.State, str, int]:
    """Allow any text while typing; invalid text is refused at the end of the input."""
    return QValidator.State.Acceptable, text, position


class CountEdit(QSpinBox):
    validate = _validate
    accepted = Signal()  # an allowed number was typed, even if it is the one shown before
    refused = Signal(str)  # why an input is not valid; the field shows the last value again
    notice: RefusalNotice

    def __init__(self, declared: Count) -> None:
        super().__init__()
        self._declared = declared
        self.setRange(declared.low, declared.high)
        _set_up(self, self.accepted)

    def limit(self, high: int) -> None:
        self._declared = replace(self._declared, high=high)
        self.setRange(self._declared.low, high)

    def valueFromText(self, text: str) -> int:  # noqa: N802 - Qt's name
        return int(_parse(self, self._declared, text.strip()))


class DecimalEdit(QDoubleSpinBox):
    validate = _validate
    accepted = Signal()  # both signals as in CountEdit
    refused = Signal(str)
    notice: RefusalNotice

    def __init__(self, declared: Quantity, decimals: int) -> None:
        super().__init__()
        self._declared = declared
        self.setDecimals(decimals)
        self.setRange(declared.low, declared.high)
        if declared.unit.symbol:
            self.setSuffix(f" {declared.unit.symbol}")
        _set_up(self, self.accepted)

    def valueFromText(self, text: str) -> float:  # noqa: N802 - Qt's name
        # Qt appends the suffix even to a unit that was typed.
        return _parse(self, self._declared, text.removesuffix(self.suffix()))


def _set_up(field: "CountEdit | DecimalEdit | QuantityEdit", accepted: SignalInstance) -> None:
    field.setKeyboardTracking(False)
    field.notice = RefusalNotice(field)
    field.refused.connect(field.notice.show_refusal)
    accepted.connect(field.notice.end)
    leave_undo_to_window(field)
    select_number_on_double_click(field)


def _parse(field: CountEdit | DecimalEdit, declared: Count | Quantity, text: str) -> float:
    """Parse the typed number, or return the last value if it is refused."""
    try:
        value = declared.parse(text)
    except ParameterError as error:
        field.refused.emit(refusal_of(error))
        return field.value()
    field.accepted.emit()
    return value


_STEP_FRACTION = 0.01  # step of the arrows, as a fraction of the slider's range

_WIDEST_TEXT = "888.888 cd/m²"


class QuantityEdit(QAbstractSpinBox):
    """Shows a quantity with its unit; accepts ``10 kHz``, ``68us``, ``1/8000 s`` or a number.

    A number without a unit is read in the unit shown. Only the text is rounded, not the value.
    """

    validate = _validate
    notice: RefusalNotice

    edited = Signal(float)  # the value that the user entered, in SI units

    refused = Signal(str)
    """The reason why an input is not valid; the field shows the last value again."""

    def __init__(self, quantity: Quantity) -> None:
        super().__init__()
        self._quantity = quantity
        self._value = quantity.default
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.lineEdit().textEdited.connect(self._mark_edited)
        self.editingFinished.connect(self.accept_text)
        self._is_edited = False
        _set_up(self, self.edited)
        self._show()

    def value(self) -> float:
        """Return the value in SI units."""
        return self._value

    def set_value(self, value: float) -> None:
        """Show a value in SI units."""
        self._value = value
        self._show()

    def _show(self) -> None:
        self._is_edited = False
        self.lineEdit().setText(self._quantity.format(self._value))

    def _mark_edited(self) -> None:
        self._is_edited = True

    def accept_text(self) -> None:
        if not self._is_edited:  # leaving the field must not round the value
            return
        shown_unit = self._quantity.unit.display(self._value)[1]
        try:
            value = self._quantity.parse(self.lineEdit().text(), shown_unit)
        except ParameterError as error:
            self._show()
            self.refused.emit(refusal_of(error))
            return
        self.set_value(value)
        self.edited.emit(value)

    def stepBy(self, steps: int) -> None:  # noqa: N802 - Qt's name
        self.accept_text()  # the step starts from the typed value
        fraction = self._quantity.fraction(self._value) + steps * _STEP_FRACTION
        self.set_value(self._quantity.at(min(max(fraction, 0.0), 1.0)))
        self.edited.emit(self._value)

    def stepEnabled(self) -> QAbstractSpinBox.StepEnabledFlag:  # noqa: N802 - Qt's name
        enabled = QAbstractSpinBox.StepEnabledFlag.StepNone
        low, high = self._quantity.slider
        if self._value > low:
            enabled |= QAbstractSpinBox.StepEnabledFlag.StepDownEnabled
        if self._value < high:
            enabled |= QAbstractSpinBox.StepEnabledFlag.StepUpEnabled
        return enabled

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        width = self.fontMetrics().horizontalAdvance(_WIDEST_TEXT) + 28
        return QSize(width, super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the same size, so that no value is cut off."""
        return self.sizeHint()
