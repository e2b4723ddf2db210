"""Slider from fast to exact: the tolerance, from infinity to zero, with a mark at each plan."""

import math
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSlider, QWidget

from occ_gui.scene.number_edits import QuantityEdit
from occ_gui.scene.parameter_rows import explain
from occ_gui.widgets.building import fill
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_model.results.frame import EffectSet
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.scene import TOLERANCE, unit_of
from occ_model.scene.units import Unit

STEPS = 200  # positions between the slider's ends, infinity and zero, while no marks are known

_INFINITE = ("∞", "inf", "infinity", "infinite")

_DECISION_TOLERANCE = replace(
    TOLERANCE,
    meaning="How much the omitted effects may change the observable, in margins: at 1 a chip could "
    "be misread.",
    unit=Unit(unit_of("decision")),
)


class ToleranceEdit(QuantityEdit):
    """A field for the tolerance, which may be infinite, in levels or in margins."""

    def show_quantity(self, quantity: Quantity) -> None:
        self._quantity = quantity
        self._show()

    def _show(self) -> None:
        super()._show()
        if self._value == math.inf:
            self.lineEdit().setText(f"∞ {self._quantity.unit.symbol}")

    def accept_text(self) -> None:
        text = self.lineEdit().text().removesuffix(self._quantity.unit.symbol).strip().lower()
        if self._is_edited and text in _INFINITE:
            self.set_value(math.inf)
            self.edited.emit(math.inf)
            return
        super().accept_text()


class ToleranceSlider(QWidget):
    edited = Signal(float)

    refused = Signal(str)  # why an entered value is refused

    def __init__(self) -> None:
        super().__init__()
        self.marks: tuple[float, ...] = ()
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, STEPS + 1)
        self.slider.setPageStep(STEPS // 20)
        self.field = ToleranceEdit(TOLERANCE)
        self._unit = TOLERANCE.unit.symbol
        self._explain(TOLERANCE)
        for control in (self.slider, self.field):
            control.setAccessibleName(TOLERANCE.label)
            keep_wheel_for_scrolling(control)
        self.slider.valueChanged.connect(self._slide)
        self.field.edited.connect(self._set_tolerance)
        self.field.refused.connect(self.refused)
        parts = (QLabel("fast"), (self.slider, 1), QLabel("exact"), self.field)
        fill(QHBoxLayout(self), *parts, margins=0, spacing=8)
        self.show_value(TOLERANCE.default)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a height in which the style's frame does not cut off the text."""
        least = super().minimumSizeHint()
        return least.expandedTo(QSize(0, self.field.minimumSizeHint().height()))

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return super().sizeHint().expandedTo(QSize(0, self.minimumSizeHint().height()))

    def show_unit(self, unit: str) -> None:
        if unit == self._unit:
            return
        self._unit = unit
        quantity = TOLERANCE if unit == TOLERANCE.unit.symbol else _DECISION_TOLERANCE
        self.field.show_quantity(quantity)
        self._explain(quantity)

    def _explain(self, quantity: Quantity) -> None:
        meaning = (
            explain(quantity)
            + "\nFast: infinity, the paper's model without any effect. Exact: 0, all effects."
        )
        for control in (self.slider, self.field):
            control.setToolTip(meaning)

    def show_value(self, tolerance: float) -> None:
        self.field.set_value(tolerance)
        self._place(tolerance)

    def show_marks(self, marks: tuple[float, ...]) -> None:
        """Let the slider stop where plans begin: at ``marks``, tolerances in descending order."""
        if marks == self.marks:
            return
        self.marks = marks
        with QSignalBlocker(self.slider):
            self.slider.setRange(0, (len(marks) or STEPS) + 1)
            self.slider.setPageStep(1 if marks else STEPS // 20)
            ticks = QSlider.TickPosition.TicksBelow if marks else QSlider.TickPosition.NoTicks
            self.slider.setTickPosition(ticks)
            self.slider.setTickInterval(1)
        self._place(self.field.value())

    def _place(self, tolerance: float) -> None:
        with QSignalBlocker(self.slider):
            self.slider.setValue(position_of(tolerance, self.marks))

    def _slide(self, position: int) -> None:
        tolerance = tolerance_at(position, self.marks)
        self.field.set_value(tolerance)
        self.edited.emit(tolerance)

    def _set_tolerance(self, tolerance: float) -> None:
        self._place(tolerance)
        self.edited.emit(tolerance)


def list_marks(effect_sets: Sequence[EffectSet]) -> tuple[float, ...]:
    """Return the tolerances at which plans begin, without those at the slider's ends."""
    errors = (each.error for each in effect_sets[1:] if 0.0 < each.error < math.inf)
    return tuple(error for error in errors if error > TOLERANCE.at(0.0))


def tolerance_at(position: int, marks: Sequence[float] = ()) -> float:
    """Return the tolerance at a position of the slider, from 0 (infinity) to the last (zero)."""
    if position == 0:
        return math.inf
    if position > (len(marks) or STEPS):
        return 0.0
    return marks[position - 1] if marks else TOLERANCE.at(1.0 - (position - 1) / (STEPS - 1))


def position_of(tolerance: float, marks: Sequence[float] = ()) -> int:
    if tolerance == math.inf:
        return 0
    if tolerance == 0.0:
        return (len(marks) or STEPS) + 1
    if marks:
        return 1 + sum(mark > tolerance for mark in marks)
    return 1 + round((1.0 - TOLERANCE.fraction(tolerance)) * (STEPS - 1))
