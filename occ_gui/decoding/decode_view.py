"""Pane of decoding: whether the code was read, the bits, and the steps of the decoder."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QFormLayout, QLabel, QSizePolicy, QTabBar, QVBoxLayout, QWidget

from occ_gui.decoding.bit_strip import BitStrip, PayloadText
from occ_gui.decoding.decode_steps import RunLengthPlot, SignalPlot
from occ_gui.simulation.snapshot import Reading
from occ_gui.simulation.verdict import (
    describe_missing,
    is_right,
    reason_in,
    result_of,
    verdict_on,
)
from occ_gui.widgets.building import embolden, fill, name_widget, paragraph
from occ_gui.widgets.state_look import State
from occ_model.results.decoding import DecodeResult, Location

_MARKS = {State.GOOD: "✓ ", State.NEUTRAL: "", State.WAITING: "… "}

_STEPS = {
    "bright": "Bright from",
    "region": "Region",
    "threshold": "Threshold",
    "chip": "Chip length",
    "chips": "Chips read",
    "correlation": "Correlation",
    "confidence": "Confidence",
}
"""Titles of the quantities that the decoder's steps measure."""


class DecodeView(QWidget):
    """The result in a sentence, the sent and received bits, and the quantities measured."""

    decoder_chosen = Signal(str)  # the name of the decoder that the user chose

    def __init__(self, decoders: Sequence[str] = ()) -> None:
        super().__init__()
        self._decoder_names = tuple(decoders)
        self._decoder = ""  # the chosen decoder; empty for the first
        self._reading: Reading | None = None
        self._early_reading: Reading | None = None
        self._drawn_result: DecodeResult | None = None
        self._is_outdated = False
        self._run_value = ""
        tip = "The decoder whose result and steps are shown."
        self.decoders = name_widget(QTabBar(drawBase=False), "Decoder", tip)
        self.decoders.currentChanged.connect(self._choose)
        self.verdict = embolden(paragraph())
        self.origin = paragraph(name="What the code was read from")
        self.payload = PayloadText()
        self.strip = BitStrip()
        self.reason = paragraph()
        self.reason.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.omissions = paragraph(name="What the picture leaves out")
        self._steps = {name: QLabel() for name in _STEPS}
        self.signal, self.run_lengths = SignalPlot(), RunLengthPlot()
        sections = (self.origin, self.payload, self.strip, self.reason, self.omissions)
        plots = (self.signal, self.run_lengths)
        fill(
            QVBoxLayout(self), self.decoders, self.verdict, *sections, self._make_form(),
            *((plot, 1) for plot in plots), None, margins=(6, 4, 6, 4), spacing=4,
        )  # fmt: skip
        # Before the first result these are empty.
        for widget in (*sections, *plots):
            widget.hide()
        for step in self._steps.values():
            self._form.setRowVisible(step, False)

    def _make_form(self) -> QFormLayout:
        self._form = form = QFormLayout()
        form.setVerticalSpacing(2)
        for name, title in _STEPS.items():
            self._steps[name].setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            form.addRow(title, self._steps[name])
        return form

    def show_reading(self, reading: Reading) -> None:
        before = self._reading
        if before is None or before.request != reading.request:
            self._early_reading = self._drawn_result = None
        elif before.source != reading.source:
            self._early_reading = before
        self._reading = reading
        results = self._list_results(reading)
        with QSignalBlocker(self.decoders):
            while self.decoders.count() < len(results):
                self.decoders.addTab("")
            while self.decoders.count() > len(results):
                self.decoders.removeTab(self.decoders.count() - 1)
            self.choose_decoder(self._decoder)
        self._mark_tabs(reading)
        self.origin.show()
        self.strip.setVisible(bool(reading.sent))
        self.omissions.setVisible(bool(reading.missing_effects))
        self.omissions.setText(describe_missing(reading))
        self._show_result()

    def show_outdated(self, outdated: bool) -> None:
        reading = self._reading
        if reading is None or outdated == self._is_outdated:
            return
        self._is_outdated = outdated
        self.strip.show_outdated(outdated)
        self._mark_tabs(reading)
        self.verdict.setText(self._describe_verdict(reading))

    def show_run(self, value: str, _pictured: str) -> None:
        """Show at which value of a running slider the verdict holds; empty while none runs."""
        if value != self._run_value:
            self._run_value = value
            if self._reading is not None:
                self.verdict.setText(self._describe_verdict(self._reading))

    def _list_results(self, reading: Reading) -> tuple[DecodeResult, ...]:
        names = dict.fromkeys((*self._decoder_names, *reading.results))
        return tuple(result_of(reading, name) for name in names)

    def _mark_tabs(self, reading: Reading) -> None:
        for place, result in enumerate(self._list_results(reading)):
            mark = " ✓" if is_right(result, reading.sent) else " ✗"
            mark = " …" if self._is_outdated else mark
            mark = mark if result.decoder in reading.results else ""
            text = f"{result.decoder}{mark}"
            if text != self.decoders.tabText(place):  # a new text makes Qt lay out all tabs
                self.decoders.setTabText(place, text)

    def _find_result(self, reading: Reading) -> DecodeResult:
        return self._list_results(reading)[max(0, self.decoders.currentIndex())]

    def choose_decoder(self, name: str) -> None:
        self._decoder = name
        results = () if self._reading is None else self._list_results(self._reading)
        names = [result.decoder for result in results]
        if name in names:
            self.decoders.setCurrentIndex(names.index(name))

    def _choose(self) -> None:
        if self._reading is not None:
            self._decoder = self._find_result(self._reading).decoder
            self._show_result()
            self.decoder_chosen.emit(self._decoder)

    def _show_result(self) -> None:
        reading = self._reading
        if reading is None:
            return
        result = self._find_result(reading)
        bits = result.bits.tolist()
        self.payload.show_payload(reading.request.scene.transmitter.payload, bits)
        self.strip.show_bits(reading.sent, bits)
        self.verdict.setText(self._describe_verdict(reading))
        self.origin.setText(self._describe_origin(reading))
        self.reason.setText(reason_in(reading, result))
        self.reason.setVisible(bool(self.reason.text()))
        for name, text in self._format_quantities(result).items():
            step = self._steps[name]
            if step.text() != text:
                step.setText(text)
                self._form.setRowVisible(step, bool(text))
        if self.isVisible():
            self._draw_steps()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        self._draw_steps()

    def _draw_steps(self) -> None:
        reading = self._reading
        if reading is None:
            return
        result = self._find_result(reading)
        if not _look_alike(result, self._drawn_result):  # painting takes longer than comparing
            self._drawn_result = result
            self.signal.show_result(result, reading.period_columns)
            self.run_lengths.show_result(result)

    def _describe_origin(self, reading: Reading) -> str:
        """State what was read, and the early verdict where it differs."""
        early = self._early_reading
        if reading.source == "profile":
            return "Read from the column profile; the picture follows."
        if reading.source == "draft":
            return "Read from a draft of the picture; the exact one follows."
        if early is not None:
            before, now = self._write_verdict(early), self._write_verdict(reading)
            if before != now:
                is_profile = early.source == "profile"
                source = "The column profile alone" if is_profile else "Its draft"
                return f"Read from the picture. {source} gave: {before}."
        return "Read from the picture."

    def _write_verdict(self, reading: Reading) -> str:
        verdict = verdict_on(self._find_result(reading), reading.sent)
        return f"{_MARKS.get(verdict.state, '✗ ')}{verdict.title}"

    def _describe_verdict(self, reading: Reading) -> str:
        text = self._write_verdict(reading)
        if self._is_outdated:
            return f"Earlier scene: {text}"
        return f"{self._run_value}: {text}" if self._run_value else text

    def _describe_location(self, location: Location | None) -> str:
        if location is None:  # a row that appears later would move those below it
            is_early = self._reading is not None and self._reading.source == "profile"
            return "known with the picture" if is_early else ""
        return (
            f"{location.bright_level}; contours: {location.contours}, grown by {location.growth} px"
        )

    def _format_quantities(self, result: DecodeResult) -> dict[str, str]:
        """Format the measured quantities; empty where a step was not reached."""
        region, level, chip = result.region, result.threshold, result.chip_length
        return {
            "bright": self._describe_location(result.location),
            "region": "" if region is None else f"{region.columns} x {region.rows} px",
            "threshold": _format("{:.1f} grey levels", level),
            "chip": _format("{:.2f} columns", chip),
            "chips": str(result.chips.size) if result.chips.size else "",
            "correlation": _format("{:.4f}", result.correlation),
            "confidence": _format("{:.3f}", result.confidence),
        }


def _format(text: str, value: float | None) -> str:
    return "" if value is None else text.format(value)


def _look_alike(one: DecodeResult, other: DecodeResult | None) -> bool:
    """Return whether two results look alike: of one decoder, from the same signal."""
    return (
        other is not None
        and one.decoder == other.decoder
        and one.signal is not None
        and other.signal is not None
        and np.array_equal(one.signal, other.signal)
        and (one.failure, one.code, one.threshold) == (other.failure, other.code, other.threshold)
    )
