"""Pane of the bench: choices, plots, table, and the state of the measurement."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QPalette, QResizeEvent
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QStackedWidget, QVBoxLayout, QWidget

from occ_gui.bench.bench_results import BITS, COLOURS, RATES, SYMBOLS, BenchPlots, BenchTable
from occ_gui.scene.number_edits import QuantityEdit
from occ_gui.widgets.building import ElidedLabel, KeyedComboBox, fill, name_widget, push_button
from occ_gui.widgets.colours import thin_pen
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_gui.widgets.plot import LineLegend, marker
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import inflect
from occ_model.results.bit_errors import BenchBounds, BenchPoint, BenchRequest
from occ_model.scene.recording import FRAME_RATE

_GAP = 8  # pixels between check boxes

_LEAST_HEIGHT_WITH_TABLE = 420  # least height in pixels with the table below the plots

_SAMPLE_SIZE = QSize(14, 14)


PUBLISHED, OF_SCENE = "published", "scene"
"""Source of the code and timing: the published benchmark, or the scene."""

_EFFORTS = (2_560, 10_240, 102_400)  # choices for the number of bits at each point


@dataclass(frozen=True, slots=True)
class BenchChoice:
    code_source: str = PUBLISHED
    decoders: tuple[str, ...] = ()
    bits: int = _EFFORTS[1]


class BenchView(QWidget):
    choice_changed = Signal(object)  # the user's choice for the next measurement, a BenchChoice

    measurement_requested = Signal()

    cancelled = Signal()  # the user stops the measurement

    def __init__(self, decoders: Sequence[str], chosen: Sequence[str]) -> None:
        super().__init__()
        self._points: list[BenchPoint] = []
        self._bounds: BenchBounds | None = None
        self._frames_a_second = FRAME_RATE.default
        self._setting = self._progress = self._end_sentence = self._refusal = ""
        self._is_outdated = False
        self._make_choices(decoders, chosen)
        self.plots = {quantity: BenchPlots(quantity) for quantity in (RATES, BITS)}
        self._pages = QStackedWidget()
        for plots in self.plots.values():
            self._pages.addWidget(plots)
        self.invitation = self._make_invitation()
        self._pages.addWidget(self.invitation)
        self.outdated = OutdatedMark(self._pages)
        self.table = BenchTable()
        self.legend = LineLegend()
        self.state = name_widget(
            ElidedLabel(how=Qt.TextElideMode.ElideMiddle), "State of the bench"
        )
        self.work = WorkBar("Measured places")
        self.work.cancelled.connect(self.cancelled)
        self._lay_out()
        self._show_quantity()
        self._show_state()

    def _make_invitation(self) -> QLabel:
        text = (
            "How often does each decoder misread a bit? Choose the code and the decoders above, "
            "and press Measure. The error rates appear here, over the exposure and over the noise."
        )
        invitation = QLabel(text, wordWrap=True, alignment=Qt.AlignmentFlag.AlignCenter)
        invitation.setContentsMargins(64, 8, 64, 8)
        return invitation

    def _make_choices(self, decoders: Sequence[str], chosen: Sequence[str]) -> None:
        self.code_source = KeyedComboBox(
            "Code that is measured",
            "Manchester, 256 bits, 5 rows per symbol; or the scheme, number of bits, frequency and "
            "readout time of the scene. Exposure and noise are always those of the plots below.",
            {PUBLISHED: "the published benchmark's code", OF_SCENE: "the scene's code and timing"},
        )
        self.effort = KeyedComboBox(
            "Bits at each point",
            "More bits take longer and make the intervals narrower.",
            {str(bits): f"{bits:,} bits a point" for bits in _EFFORTS},
        )
        self.effort.show_key(str(BenchChoice().bits))
        self.quantity = KeyedComboBox(
            "What is shown",
            "Bit error rates, or the bits that arrive in a second of video.",
            {RATES: "bit error rate", BITS: "bits a second"},
        )
        self.decoders = {name: QCheckBox(name) for name in decoders}
        for name, box in self.decoders.items():
            box.setChecked(name in chosen)
            box.setToolTip("Measure this decoder.")
            box.toggled.connect(self._emit_choice)
        self.frame_rate = name_widget(
            QuantityEdit(FRAME_RATE), FRAME_RATE.label, FRAME_RATE.meaning
        )
        self.measure = push_button(
            "Measure", "Measure the chosen decoders in the background.", self.measurement_requested
        )
        for choice in (self.code_source, self.effort):
            choice.chosen.connect(self._emit_choice)
        self.quantity.chosen.connect(self._show_quantity)

    def _lay_out(self) -> None:
        head = fill(QHBoxLayout(), (self.code_source, 3), (self.effort, 2), self.measure)
        boxes = (part for box in self.decoders.values() for part in (box, _GAP))
        second_row = fill(QHBoxLayout(), *boxes, (None, 1), self.frame_rate, (self.quantity, 1))
        self._legend_place = fill(QHBoxLayout(), self.legend, (None, 1))
        foot = fill(QHBoxLayout(), (self.state, 1), self.work)
        fill(
            QVBoxLayout(self), head, second_row, (self._pages, 3), self._legend_place,
            (self.table, 2), foot, margins=(4, 2, 4, 2), spacing=2,
        )  # fmt: skip

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._show_page()

    def choice(self) -> BenchChoice:
        decoders = tuple(name for name, box in self.decoders.items() if box.isChecked())
        return BenchChoice(self.code_source.key(), decoders, int(self.effort.key()))

    def _emit_choice(self) -> None:
        self.choice_changed.emit(self.choice())

    def _show_quantity(self) -> None:
        quantity = self.quantity.key()
        self._show_page()
        self.frame_rate.setVisible(quantity == BITS)
        self._show_bound_entry()
        self._draw()
        self._show_state()

    def _show_page(self) -> None:
        """Show plots and table; before the first measurement, say what they are for."""
        has_results = bool(self._setting)
        self._pages.setCurrentWidget(
            self.plots[self.quantity.key()] if has_results else self.invitation
        )
        self.table.setVisible(has_results and self.height() >= _LEAST_HEIGHT_WITH_TABLE)

    def show_begun(self, request: BenchRequest) -> None:
        self._points, self._bounds, self._end_sentence = [], None, ""
        self._setting = (
            f"{', '.join(request.schemes)}, {inflect(request.payload_bits, 'bit')}, "
            f"{request.rows_a_symbol:.3g} rows a symbol (the row rate needs 1 or more)"
        )
        self._show_page()
        for plots in self.plots.values():
            plots.show_begun(request.decoders)
        self.table.show_begun(request)
        self._show_legend(request.decoders)
        self.work.begin()
        self.measure.setEnabled(False)

    def _show_legend(self, decoders: Sequence[str]) -> None:
        old, self.legend = self.legend, LineLegend()
        self._legend_place.replaceWidget(old, self.legend)
        old.deleteLater()
        for number, name in enumerate(decoders):
            symbol = SYMBOLS[number % len(SYMBOLS)]
            sample = marker(symbol, 8, COLOURS[number % len(COLOURS)])
            self.legend.add_sample(name, sample, _SAMPLE_SIZE, name)
        self.legend.add_sample(
            "no_error", marker("t", 8, None), _SAMPLE_SIZE, "no error: less than",
            "No bit was wrong; the mark is at the upper end of the rate's 95 % interval.",
        )  # fmt: skip
        ink = self.palette().color(QPalette.ColorRole.Text)
        self.legend.add_line(
            "nulls", thin_pen(ink, Qt.PenStyle.DotLine), "alternating chips leave no stripes"
        )
        self.legend.add_line(
            "most", thin_pen(ink, Qt.PenStyle.DashLine), "upper bound for Gaussian light"
        )
        self._show_bound_entry()

    def _show_bound_entry(self) -> None:
        if self._setting:
            self.legend.show_line("most", self.quantity.key() == BITS)
            self.legend.show_line("no_error", self.quantity.key() == RATES)

    def show_bounds(self, bounds: BenchBounds) -> None:
        self._bounds = bounds
        self._draw()

    def show_points(self, points: list[BenchPoint]) -> None:
        self._points = list(points)
        self._draw()

    def _draw(self) -> None:
        quantity = self.quantity.key()
        if self._bounds is not None:
            self.plots[quantity].show_bounds(self._bounds, self._frames_a_second)
        is_possible = quantity == RATES or not self._refusal
        self.plots[quantity].show_points(self._points if is_possible else [], self._frames_a_second)
        if is_possible:
            self.table.show_points(self._points, quantity, self._frames_a_second)

    def show_progress(self, done: int, total: int) -> None:
        self.work.show_progress(done / total)
        self._progress = f"{done} of {total} places measured"
        self._show_state()

    def show_ended(self, sentence: str) -> None:
        """Show that the measurement has ended, and why some points are missing."""
        self.work.end()
        self.measure.setEnabled(True)
        self._end_sentence = sentence
        self._show_state()

    def show_frame_rate(self, frames_a_second: float, refusal: str) -> None:
        self._frames_a_second, self._refusal = frames_a_second, refusal
        self.frame_rate.set_value(frames_a_second)
        self._draw()
        self._show_state()

    def show_outdated(self, outdated: bool) -> None:
        """Mark the points if their code or timing is not the one that is chosen now."""
        self._is_outdated = outdated
        text = "of another code or timing: measure again"
        self.outdated.show_age(DELAY if outdated else 0.0, text)
        self._show_state()

    def _show_state(self) -> None:
        text = self._end_sentence
        if self._setting:
            refusal = self._refusal if self.quantity.key() == BITS else ""
            parts = (refusal, self._end_sentence, self._progress, self._setting)
            text = "; ".join(part.removesuffix(".") for part in parts if part) + "."
            if self._is_outdated:
                text = f"Earlier setting: {text}"
        self.state.set_full_text(text)
