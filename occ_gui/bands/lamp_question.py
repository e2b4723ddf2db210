"""The question “my lamp makes bars”: the lamp, the camera's shutter, and the answer in one line."""

from dataclasses import replace

from PySide6.QtCore import Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QFormLayout, QHBoxLayout, QVBoxLayout, QWidget

from occ_gui.bands.jobs import LampQuestion
from occ_gui.scene.number_edits import CountEdit, QuantityEdit
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import KeyedComboBox, check_box, fill, name_widget, push_button
from occ_model.results.bars_answer import ROWS, BarsAnswer, format_shutter_time
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.units import SECOND

_LAMPS = {
    "50": "mains, 50 Hz",
    "60": "mains, 60 Hz",
    "dimmed": "dimmed",
    "rows": "panel, row by row",
}
_FIRST_VALUES = {
    "lamp_frequency": 240.0,
    "duty": 0.3,
    "exposure_time": 1 / 125,
    "readout_time": 12e-6,
}
_SHUTTER_RANGE = (1 / 8000, 1.0)  # in seconds, of the field's arrows
_FORM_WIDTH = 300


class ShutterEdit(QuantityEdit):
    """Shows a shutter time as cameras do: 1/100 s; a number without a unit is in seconds."""

    def __init__(self) -> None:
        seconds = replace(SECOND, prefixes=("",))
        super().__init__(replace(quantity("exposure_time"), unit=seconds, slider=_SHUTTER_RANGE))

    def _show(self) -> None:
        super()._show()
        self.lineEdit().setText(format_shutter_time(self.value()))


class LampForm(QWidget):
    """Asks for the lamp and the camera."""

    edited = Signal()
    scene_requested = Signal()  # the user wants to see the lamp in the scene

    def __init__(self) -> None:
        super().__init__()
        self.lamp = KeyedComboBox("My lamp", "What the lamp's light does.", _LAMPS)
        self.lamp.chosen.connect(self._choose)
        self.fields = {name: self._add_field(name) for name in _FIRST_VALUES}
        self.rows = name_widget(CountEdit(ROWS), ROWS.label, ROWS.meaning)
        self.rows.setValue(ROWS.default)
        self.rows.valueChanged.connect(self.edited)
        self.edited.connect(self.rows.notice.end)
        self.knows_readout = check_box(
            "Readout time", "Time from one line to the next, where you know it.", self._choose
        )
        self.show_button = push_button(
            "Show in the scene", "Make this lamp the light of the scene.", self.scene_requested
        )
        self._form = QFormLayout()
        self._form.addRow("My lamp", self.lamp)
        self._form.addRow(quantity("lamp_frequency").label, self.fields["lamp_frequency"])
        self._form.addRow(quantity("duty").label, self.fields["duty"])
        self._form.addRow(ROWS.label, self.rows)
        self._form.addRow("Shutter", self.fields["exposure_time"])
        self._form.addRow(self.knows_readout, self.fields["readout_time"])
        fill(
            QVBoxLayout(self),
            self._form,
            fill(QHBoxLayout(), None, self.show_button),
            None,
            margins=0,
        )
        self.setMaximumWidth(_FORM_WIDTH)
        self._choose()

    def _add_field(self, name: str) -> QuantityEdit:
        parameter = quantity(name)
        field = ShutterEdit() if name == "exposure_time" else QuantityEdit(parameter)
        name_widget(field, parameter.label, parameter.meaning)
        field.set_value(_FIRST_VALUES[name])
        field.edited.connect(self.edited)
        self.edited.connect(field.notice.end)
        return field

    def _choose(self, _: object = None) -> None:
        kind = self.lamp.key()
        for field, is_visible in (
            (self.fields["lamp_frequency"], kind in ("dimmed", "rows")),
            (self.fields["duty"], kind == "dimmed"),
            (self.rows, kind == "rows"),
        ):
            self._form.setRowVisible(field, is_visible)
        self.fields["readout_time"].setEnabled(self.knows_readout.isChecked())
        self.edited.emit()

    @property
    def question(self) -> LampQuestion:
        kind, values = self.lamp.key(), {name: field.value() for name, field in self.fields.items()}
        rows = self.rows.value() if kind == "rows" else 0
        light: dict[str, ParameterValue] = {
            "light": "lamp", "lamp_frequency": values["lamp_frequency"],
            "duty": 1.0 / rows if rows else values["duty"], "depth": 1.0,
        }  # fmt: skip
        if kind in ("50", "60"):
            light = {"light": "mains", "mains_frequency": float(kind)}
        readout = values["readout_time"] if self.knows_readout.isChecked() else None
        return LampQuestion(light, values["exposure_time"], readout, rows)


class LampBars(QWidget):
    """The form and the answer, side by side where there is room."""

    def __init__(self) -> None:
        super().__init__()
        self.form, self.answer = LampForm(), Answer()
        self._row = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        answers = fill(QVBoxLayout(), self.answer, None)
        fill(self._row, self.form, (answers, 1), margins=0, spacing=16)

    def show_answer(self, answer: BarsAnswer) -> None:
        self.answer.show_answer(answer.sentence, answer.details)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        directions = QBoxLayout.Direction
        is_wide = self.width() >= 2 * _FORM_WIDTH
        self._row.setDirection(directions.LeftToRight if is_wide else directions.TopToBottom)
