"""Parameter rows: the controls of one parameter, a class for each kind of declaration."""

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QGridLayout,
    QHBoxLayout,
    QLineEdit,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from occ_gui.scene.number_edits import CountEdit, QuantityEdit
from occ_gui.scene.refusal_notice import RefusalNotice
from occ_gui.scene.scene_store import Gestures
from occ_gui.widgets.building import fill, push_button
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling, leave_undo_to_window
from occ_model.errors import ParameterError
from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.declaration import Declaration
from occ_model.scene.light_words import describe_samples
from occ_model.scene.parameter_kinds import (
    ChipPattern,
    Choice,
    Count,
    OpenChoice,
    Parameter,
    ParameterValue,
    Payload,
    Quantity,
)
from occ_model.scene.refusal import refusal_of

_SLIDER_STEPS = 1000
_SHORTEST_SLIDER = 90  # pixels; on a shorter one, a pixel is a large step

_DIGITS = 4  # significant digits of a value in a message


class ParameterRow(QWidget):
    edited = Signal(str, object, int)
    """Name, value in SI units, and the number of the gesture that the change belongs to."""

    refused = Signal(str)  # the reason why an input is not valid

    value: ParameterValue | None = None  # the value shown or entered; None before the first

    notice: RefusalNotice
    """Notice below the field: why the last input was refused, or what is wrong with the value."""

    def __init__(self, declaration: Declaration) -> None:
        super().__init__()
        self.name = declaration.name
        self.gestures = Gestures()

    def show_problem(self, sentence: str, *, stays: bool) -> None:
        """Show what is wrong; ``stays``: whether the field still shows it."""
        self.notice.show_problem(sentence, stays=stays)

    def end_refusal(self) -> None:
        self.notice.end()

    def show_value(self, value: ParameterValue) -> None:
        self.value = value
        self._display(value)

    def _display(self, value: ParameterValue) -> None:
        raise NotImplementedError

    def _enter(self, value: ParameterValue) -> None:
        self.value = value
        self.end_refusal()
        self.edited.emit(self.name, value, self.gestures.of_change())


class QuantityRow(ParameterRow):
    def __init__(self, quantity: Quantity) -> None:
        super().__init__(quantity)
        self._quantity = quantity
        self._is_running = False
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, _SLIDER_STEPS)
        self.slider.setPageStep(_SLIDER_STEPS // 20)
        self.slider.setMinimumWidth(_SHORTEST_SLIDER)
        self.field = QuantityEdit(quantity)
        self._layout = QGridLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setVerticalSpacing(1)
        self._layout.setColumnStretch(0, 1)
        self._layout.addWidget(self.slider, 0, 0)
        self._layout.addWidget(self.field, 0, 1)
        self.notice = self.field.notice
        for control in (self.slider, self.field):
            _describe_control(control, quantity)
            keep_wheel_for_scrolling(control)
        self.slider.sliderPressed.connect(self.gestures.end)
        self.slider.sliderReleased.connect(self.gestures.end)
        self.field.lineEdit().textEdited.connect(self.gestures.end)
        self.slider.valueChanged.connect(self._slide)
        self.field.edited.connect(self._accept)
        self.field.refused.connect(self.refused)
        self.show_value(quantity.default)

    def _display(self, value: ParameterValue) -> None:
        number = float(value)
        self.field.set_value(number)
        self._place_slider(number)

    def add_below(self, widget: QWidget) -> None:
        """Put a widget under the slider, as wide as the slider."""
        self._layout.addWidget(widget, 1, 0)

    def add_track(self, widget: QWidget) -> None:
        """Put a widget behind the slider, in place of its groove while the widget is shown."""
        self._layout.addWidget(widget, 0, 0, Qt.AlignmentFlag.AlignVCenter)
        widget.lower()

    def show_track(self, on: bool) -> None:
        self.slider.setProperty("tracked", on)
        self.slider.style().unpolish(self.slider)
        self.slider.style().polish(self.slider)

    @property
    def fraction(self) -> float:
        """The position of the slider, from 0 to 1."""
        return self.slider.value() / _SLIDER_STEPS

    def begin_run(self) -> None:
        """Begin a run of the slider, which is undone as one change."""
        self.gestures.end()
        self._is_running = True

    def run_to(self, fraction: float) -> None:
        self.slider.setValue(round(fraction * _SLIDER_STEPS))

    def value_at(self, fraction: float) -> float:
        """Return the value at a position of the slider, from 0 to 1."""
        return self._quantity.at(round(fraction * _SLIDER_STEPS) / _SLIDER_STEPS)

    def end_run(self) -> None:
        self._is_running = False
        self.gestures.end()

    def _place_slider(self, value: float) -> None:
        with QSignalBlocker(self.slider):
            self.slider.setValue(round(self._quantity.fraction(value) * _SLIDER_STEPS))
        self._announce_value(value)

    def _announce_value(self, value: float) -> None:
        """Set the value as the text for screen readers, which would read the slider's step."""
        self.slider.setAccessibleDescription(self._quantity.format(value, _DIGITS))

    def _slide(self, position: int) -> None:
        self.value = value = self._quantity.at(position / _SLIDER_STEPS)
        self.end_refusal()
        self.field.set_value(value)
        self._announce_value(value)
        is_held = self.slider.isSliderDown() or self._is_running
        gesture = self.gestures.of_change(is_held=is_held)
        self.edited.emit(self.name, value, gesture)

    def _accept(self, value: float) -> None:
        self._place_slider(value)
        self._enter(value)


class CountRow(ParameterRow):
    def __init__(self, declared: Count) -> None:
        super().__init__(declared)
        self._declared = declared
        self.field = CountEdit(declared)
        keep_wheel_for_scrolling(self.field)
        _set_up_row(self, self.field, declared)
        self.field.lineEdit().textEdited.connect(self.gestures.end)
        self.field.valueChanged.connect(self._enter)
        self.field.accepted.connect(self.end_refusal)
        self.field.refused.connect(self.refused)

    def _display(self, value: ParameterValue) -> None:
        with QSignalBlocker(self.field):
            self.field.setValue(int(value))

    def show_derived(self, number: int | None, reason: str = "") -> None:
        """Show a derived number with its reason; with None, show the row's own value again."""
        self.field.setEnabled(number is None)
        self.field.setToolTip(reason or explain(self._declared))
        with QSignalBlocker(self.field):
            if number is None:
                self.field.limit(self._declared.high)
                self.field.setValue(int(self.value or self._declared.low))
            else:
                self.field.setRange(number, number)


class ChoiceRow(ParameterRow):
    def __init__(self, declared: Choice, field: QComboBox | None = None) -> None:
        super().__init__(declared)
        self.field = field or QComboBox()
        self.field.addItems(declared.choices)
        keep_wheel_for_scrolling(self.field)
        _set_up_row(self, self.field, declared)
        self.field.textActivated.connect(self._enter)

    def _display(self, value: ParameterValue) -> None:
        self.field.setCurrentText(str(value))


class OpenChoiceBox(QComboBox):
    """A list to which the choices of plug-ins are added before it opens."""

    def __init__(self, declared: OpenChoice) -> None:
        super().__init__()
        self._declared = declared

    def showPopup(self) -> None:  # noqa: N802 - Qt's name
        for choice in self._declared.all_choices():
            if self.findText(choice) < 0:
                self.addItem(choice)
        super().showPopup()


class OpenChoiceRow(ChoiceRow):
    """A choice among the built-in values and those of plug-ins."""

    def __init__(self, declared: OpenChoice) -> None:
        super().__init__(declared, OpenChoiceBox(declared))

    def _display(self, value: ParameterValue) -> None:
        if self.field.findText(str(value)) < 0:  # a choice of a plug-in
            self.field.addItem(str(value))
        super()._display(value)


class PatternRow(ParameterRow):
    """A text field for a pattern or payload; unreadable text stays, with the reason."""

    def __init__(self, declared: ChipPattern | Payload | CanonicalText) -> None:
        super().__init__(declared)
        self._declared = declared
        self._value_text = ""
        self.field = QLineEdit(placeholderText=f"empty: {declared.empty}")
        leave_undo_to_window(self.field)
        _set_up_row(self, self.field, declared)
        self.field.textEdited.connect(self.gestures.end)
        self.field.editingFinished.connect(self._read_field)
        self.notice.dismissed.connect(lambda: self.field.setText(self._value_text))

    def _text_of(self, value: str) -> str:
        return self._declared.format(value)

    def _display(self, value: ParameterValue) -> None:
        self._value_text = self._text_of(str(value))
        self.field.setText(self._value_text)
        self.end_refusal()

    def end_refusal(self) -> None:
        """Remove the sentence, unless it is about the text that the field still shows."""
        if self.field.text() == self._value_text:
            super().end_refusal()

    def _read_field(self) -> None:
        if self.field.text() == self._value_text:
            self.end_refusal()
            return
        self._apply_text(self.field.text())

    def _apply_text(self, text: str) -> None:
        try:
            value = self._declared.parse(text)
        except ParameterError as error:
            self.show_problem(refusal_of(error), stays=True)
            self.refused.emit(refusal_of(error))
            return
        is_changed = value != self.value
        self.show_value(value)
        if is_changed:
            self._enter(value)


class WaveformRow(PatternRow):
    """A CSV file, by its path; once read, its number of levels and its length are shown."""

    def __init__(self, declared: CanonicalText) -> None:
        super().__init__(declared)
        self.open = push_button("Open…", "Choose a CSV file of seconds and levels.", self._ask)
        self.remove = push_button(
            "Remove", "Send the levels again in place of the file.", lambda: self._apply_text("")
        )
        buttons = fill(QHBoxLayout(), self.open, self.remove, (None, 1), margins=0)
        layout = self.layout()
        if isinstance(layout, QVBoxLayout):
            layout.addLayout(buttons)

    def _text_of(self, value: str) -> str:
        self.remove.setEnabled(bool(value))
        return describe_samples(value)

    def _ask(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, "Open waveform", "", "Tables (*.csv *.txt)")
        if path:
            self._apply_text(path)


def row_for(declared: Parameter) -> ParameterRow:
    match declared:
        case Quantity():
            return QuantityRow(declared)
        case Count():
            return CountRow(declared)
        case OpenChoice():
            return OpenChoiceRow(declared)
        case Choice():
            return ChoiceRow(declared)
        case CanonicalText(name="waveform_file"):
            return WaveformRow(declared)
        case ChipPattern() | Payload() | CanonicalText():
            return PatternRow(declared)


def explain(declared: Parameter) -> str:
    """Return a tooltip with the label, symbol, meaning and range of a parameter."""
    symbol = f" ({declared.symbol})" if declared.symbol else ""
    return f"{declared.label}{symbol}\n{declared.meaning}\nAllowed: {declared.allowed}"


def _describe_control(control: QWidget, declared: Parameter) -> None:
    control.setAccessibleName(declared.label)
    control.setToolTip(explain(declared))


def _set_up_row(row: ParameterRow, control: QWidget, declared: Parameter) -> None:
    fill(QVBoxLayout(row), control, margins=0, spacing=1)
    row.notice = control.notice if isinstance(control, CountEdit) else RefusalNotice(control)
    _describe_control(control, declared)
