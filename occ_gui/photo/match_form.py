"""Form of a match: its choices, the button that starts it, and its progress."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from occ_gui.photo.match_figures import is_certain
from occ_gui.photo.shown_photo import ShownPhoto, known_of
from occ_gui.scene.number_edits import QuantityEdit
from occ_gui.scene.parameter_rows import explain
from occ_gui.scene.scene_store import new_gesture
from occ_gui.values.choices import KNOWN_PARAMETERS, MatchChoice
from occ_gui.widgets.building import (
    KeyedComboBox,
    check_box,
    fill,
    name_widget,
    paragraph,
    push_button,
)
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

_LAMP = "lamp_frequency"

_PROGRESS_STEPS = 1000


class MatchForm(QWidget):
    asked = Signal(object)  # the user starts a match: a MatchChoice
    edited = Signal(str, object, int)
    """A known value was entered: name, value in SI units, and the number of the gesture."""

    chosen = Signal(object)  # another choice was made: a MatchChoice
    certain_chosen = Signal(str, object)
    """Name of a known value, and the confirmed value in SI units; None if it is only assumed."""

    cancelled = Signal()
    refused = Signal(str)  # why an entered value is refused
    accepted = Signal()  # an allowed value was entered, whether or not it differs from the last one

    def __init__(self) -> None:
        super().__init__()
        self._shown = ShownPhoto(Scene())
        self.sent = KeyedComboBox(
            "What was sent",
            "What the LED in the photo sent: what the scene sends, a lamp of a known frequency, or "
            "what can be read from the stripes.\n"
            "Try the scene's light: if it does not explain the stripes, they are read.",
            {
                "auto": "Unknown: try the scene's light",
                "scene": "What the scene sends",
                "lamp": "Lamp of",
                "read": "Unknown: read the stripes",
            },
        )
        declared = quantity(_LAMP)
        tip = f"{declared.label}\n{declared.meaning}"
        self.lamp = name_widget(QuantityEdit(declared), declared.label, tip)
        self.estimate = KeyedComboBox(
            "What is estimated",
            "Stripes determine only the product of readout time and switching frequency. One of "
            "the two must be known; it is taken from the scene.",
            {
                "readout_time": "Readout time, frequency known",
                "switching_frequency": "Frequency, readout time known",
            },
        )
        self._make_known()
        self.gamma = check_box(
            "Fit gamma too",
            "Estimate the camera's gamma from the shape of the stripes' edges as well.",
        )
        self._make_start()
        self._lay_out()
        self.sent.chosen.connect(self._take_sent)
        for change in (
            self.sent.chosen, self.estimate.chosen, self.lamp.edited, self.gamma.clicked,
        ):  # fmt: skip
            change.connect(self._emit_choice)
        self.lamp.edited.connect(self._confirm_lamp)
        self._show_known()

    def _make_known(self) -> None:
        """Make the fields of the known values, which can also be edited here."""
        self.known: dict[str, QuantityEdit] = {}
        note = "A known value of the photo; entering it changes the scene."
        for name in KNOWN_PARAMETERS:
            declared = quantity(name)
            tip = f"{note}\n\n{explain(declared)}"
            field = name_widget(QuantityEdit(declared), f"Known: {declared.label}", tip)
            field.edited.connect(lambda value, name=name: self._enter_known(name, value))
            self.known[name] = field
        self.hint = paragraph()
        self.certain = check_box(
            "certain",
            "Tick if you know this value for this photo. Results that depend on a value that is "
            "only assumed are stated with the assumption. A value that you enter here is taken "
            "as certain.",
        )
        self.certain.clicked.connect(self._set_certain)
        self._fields = (self.lamp, *self.known.values())
        for field in self._fields:
            field.refused.connect(self.refused)
            field.edited.connect(self.accepted)

    def match_lamp(self) -> None:
        """Match with a lamp, whose frequency is assumed until it is entered."""
        self.sent.show_key("lamp")
        self._show_known()
        self.start.click()
        self.lamp.setFocus()
        self.lamp.selectAll()

    def _enter_known(self, name: str, value: float) -> None:
        self.certain_chosen.emit(name, value)
        self.edited.emit(name, value, new_gesture())

    def _emit_choice(self) -> None:
        self.chosen.emit(self._current_choice())

    def _take_sent(self, sent: str) -> None:
        if sent == "lamp":  # choosing it confirms its frequency
            self._confirm_lamp(self.lamp.value())
        elif self._shown.choice.certain.get(_LAMP) == self.lamp.value():
            self.certain_chosen.emit(_LAMP, None)  # the confirmed frequency was that of this lamp

    def _confirm_lamp(self, frequency: float) -> None:
        self.certain_chosen.emit(_LAMP, frequency)

    def _known_name(self) -> str:
        return known_of(self._current_choice(), self._shown.scene)

    def _set_certain(self, certain: bool) -> None:
        name = self._known_name()
        self.certain_chosen.emit(name, self.known[name].value() if certain else None)

    def _make_start(self) -> None:
        self.start = push_button(
            "&Match photo",
            "Find the settings that explain the photo's stripes.",
            lambda: self.asked.emit(self.choice()),
        )
        self.progress = name_widget(QProgressBar(), "Progress of the match, in percent")
        self.progress.setRange(0, _PROGRESS_STEPS)
        self.cancel = push_button(
            "&Cancel", "Cancel this match; the previous result stays.", self.cancelled
        )
        self._show_running(False)

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(3)
        for row, label in ((0, "Sent"), (2, "Estimate"), (3, "Known")):
            grid.addWidget(QLabel(label), row, 0)
        grid.addWidget(self.sent, 0, 1)
        grid.addWidget(self.lamp, 0, 2)
        grid.addWidget(self.estimate, 2, 1, 1, 2)
        known = fill(QHBoxLayout(), *self.known.values(), self.certain, None)
        grid.addLayout(known, 3, 1, 1, 2)
        grid.addWidget(self.hint, 4, 1, 1, 2)
        grid.setColumnStretch(1, 1)
        run = fill(QHBoxLayout(), self.gamma, None, self.start, self.progress, self.cancel)
        fill(QVBoxLayout(self), grid, run, margins=0, spacing=3)

    def choice(self) -> MatchChoice:
        """Return the choices, including values that were typed but not yet entered."""
        for field in (self.lamp, *self.known.values()):
            field.accept_text()
        return self._current_choice()

    def _current_choice(self) -> MatchChoice:
        return MatchChoice(
            sent=self.sent.key(),
            lamp_frequency=self.lamp.value(),
            estimate=self.estimate.key(),
            fit_gamma=self.gamma.isChecked(),
        )

    def show_photo(self, shown: ShownPhoto) -> None:
        """Show the choices for a photo, the known values, and whether a match is running."""
        last, self._shown = self._shown, shown
        if shown.is_matching != self.is_running:
            self._show_running(shown.is_matching)
        choice = shown.choice.form
        if choice != last.choice.form:  # else keep what was typed but not yet entered
            self.sent.show_key(choice.sent)
            self.lamp.set_value(choice.lamp_frequency)
            self.estimate.show_key(choice.estimate)
            self.gamma.setChecked(choice.fit_gamma)
        if shown.scene is not last.scene:  # its values replace refused input
            for field in self._fields:
                field.notice.end()
        if (shown.scene, shown.choice) != (last.scene, last.choice):
            self._show_known()

    @property
    def is_running(self) -> bool:
        return not self.cancel.isHidden()

    def _show_running(self, running: bool) -> None:
        before, after = (self.start, self.cancel) if running else (self.cancel, self.start)
        had_focus = before.hasFocus()
        for widget in (self.progress, self.cancel):
            widget.setVisible(running)
        self.start.setVisible(not running)
        if had_focus:  # otherwise Qt would move it to the next field, where typing changes a value
            after.setFocus()
        self.gamma.setEnabled(not running)
        self.progress.setValue(0)

    def show_progress(self, fraction: float) -> None:
        self.progress.setValue(round(_PROGRESS_STEPS * fraction))

    def _show_known(self) -> None:
        is_lamp, name = self.sent.key() == "lamp", self._known_name()
        self.lamp.setVisible(is_lamp)
        if not is_lamp:
            self.lamp.notice.end()
        for field_name, field in self.known.items():
            field.setVisible(field_name == name)
            if field_name != name:
                field.notice.end()
            field.set_value(float(self._shown.scene.value(field_name)))
        is_stated = is_lamp and name == _LAMP
        self.known[name].setEnabled(not is_stated)  # the field of the lamp determines it
        if is_stated:
            self.known[name].set_value(self.lamp.value())
        known = self.known[name].value()
        self.certain.setChecked(is_certain(name, known, self._shown.choice.certain))
        lines = []
        if name == "switching_frequency":
            lamp = blinking_lamp(self._shown.scene.transmitter)
            lines.append("chips or levels per second" if lamp is None else f"a {lamp.words}")
        if self.certain.isChecked():
            pass
        elif is_certain(name, known, self._shown.choice.forgotten):
            lines.append(
                "Only assumed here: it was certain for another photo. Tick “certain” if it "
                "also holds for this one."
            )
        elif is_stated:
            assumed = self.lamp.text()
            lines.append(f"{assumed} is only assumed: enter the frequency of your lamp.")
        self.hint.setText("\n".join(lines))
        self.hint.setVisible(bool(lines))
