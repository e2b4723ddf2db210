"""Pane of accuracy and time: table of effects, slider from fast to exact, plot of all ways."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.accuracy.accuracy_plot import AccuracyPlot
from occ_gui.accuracy.cost_measurement import SceneCosts
from occ_gui.accuracy.cost_sentences import ends_sentence, forecast_sentence, picture_sentence
from occ_gui.accuracy.effect_detail import EffectDetail
from occ_gui.accuracy.effect_rows import rows_of, slowest_of
from occ_gui.accuracy.effect_table import EffectTable
from occ_gui.accuracy.panels import Panel, Panels
from occ_gui.accuracy.plan_changes import switch_sentence
from occ_gui.accuracy.tolerance_slider import ToleranceSlider, marks_of
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.simulated import SimulationRequest
from occ_gui.widgets.building import fill
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.keyed_combo_box import KeyedComboBox
from occ_model.results.accuracy import Forecast, MeasuredCosts, TimeFractions
from occ_model.results.plan import Decision
from occ_model.scene.simulation_settings import SimulationSettings, unit_of

_TABLE_WIDTH, _PLOT_WIDTH, _DETAIL_WIDTH = 560, 344, 312  # pixels that the parts need side by side


class AccuracyView(QWidget):
    """The slider from fast to exact, the table of effects, and the plot of error over time."""

    tolerance_edited = Signal(float)
    refused = Signal(str)  # why an entered value is refused

    accepted = Signal()  # a valid tolerance was entered, also the same as before

    def __init__(self) -> None:
        super().__init__()
        self._snapshot: Snapshot | None = None
        self._drawn: Snapshot | None = None
        self._costs: SceneCosts | None = None
        self._forecast: tuple[SimulationRequest, Forecast] | None = None
        self._seen = False
        self._switched: tuple[Decision, ...] = ()
        self._marked: tuple[Decision, ...] = ()
        self._selected = self._slowest = ""
        self.tolerance = ToleranceSlider()
        self.tolerance.edited.connect(self.accepted)
        self.tolerance.edited.connect(self.tolerance_edited)
        self.tolerance.refused.connect(self.refused)
        self.observable = KeyedComboBox(
            "What the tolerance limits",
            "What the tolerance limits: errors of the panel's pixels, of its column means, of "
            "the signal that a decoder reads, the column means after the enhancement, or of "
            "the decision, as a fraction of the chips' margin.",
            {"image": "picture", **{each: each for each in ("profile", "signal", "decision")}},
            is_fixed=True,
        )
        self.noise = KeyedComboBox(
            "Noise",
            "Noise drawn for every pixel, or taken from a stored plane: much faster.",
            {"reused": "reused", "exact": "exact"},
            is_fixed=True,
        )
        self.summary, self.ends = ElidedLabel(), ElidedLabel()
        self.ends.hide()
        self.table, self.detail, self.plot = EffectTable(), EffectDetail(), AccuracyPlot()
        self.table.chosen.connect(self._select)
        self.table.tolerance_dragged.connect(self.tolerance.show_value)
        self.table.tolerance_dragged.connect(self.tolerance_edited)
        self.panels = Panels(
            Panel("Effects", self.table, _TABLE_WIDTH, 1),
            Panel("Ways to compute", self.plot, _PLOT_WIDTH, 3),
            Panel("Selected effect", self.detail, _DETAIL_WIDTH, 2),
        )
        self._lay_out()

    def _lay_out(self) -> None:
        controls = fill(QHBoxLayout(), (self.tolerance, 1), spacing=8)
        for text, control in (("of the", self.observable), ("Noise", self.noise)):
            controls.addWidget(QLabel(text))
            controls.addWidget(control)
        second = fill(QHBoxLayout(), (self.ends, 1), None, self.panels.tabs, spacing=8)
        fill(
            QVBoxLayout(self),
            controls,
            self.summary,
            second,
            (self.panels, 1),
            margins=(8, 2, 8, 2),
            spacing=2,
        )

    @property
    def of_scene(self) -> tuple[QWidget, ...]:
        return self.table, self.detail

    def set_seen(self, seen: bool) -> None:
        self._seen = seen
        self._redraw()

    def show_settings(self, settings: SimulationSettings) -> None:
        self.tolerance.show_unit(unit_of(settings.observable))
        self.plot.show_unit(unit_of(settings.observable))
        self.tolerance.show_value(settings.tolerance)
        self.table.show_tolerance(settings.tolerance)
        self.observable.show_key(settings.observable)
        self.noise.show_key(settings.noise)
        self.table.show_force(settings.force)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._redraw()

    def show_switched(self, switched: tuple[Decision, ...]) -> None:
        """Mark the effects that the plan has just switched; none when that is no longer news."""
        if switched != self._switched:
            self._switched = switched
            if not switched:  # else it is drawn with its picture, which comes next
                self._draw()

    def show_costs(self, costs: SceneCosts) -> None:
        self._costs = costs
        self._draw()

    def show_forecast(self, request: SimulationRequest, expected: Forecast) -> None:
        """Show the expected time and error of a picture with the present settings."""
        self._forecast = (request, expected)
        if not self.tolerance.slider.isSliderDown():
            self.tolerance.show_marks(marks_of(expected.effect_sets))
        self.plot.show_ways(expected)
        self._draw()

    def _redraw(self) -> None:
        if self._snapshot is None or self._snapshot is self._drawn or not self._seen:
            return
        self._drawn = self._snapshot
        self._draw()
        if self._marked != self._switched:
            self._marked = self._switched
            self.table.bring_into_view(self._new)

    @property
    def _new(self) -> set[str]:
        return {decision.effect for decision in self._switched}

    def _draw(self) -> None:
        snapshot = self._snapshot
        if snapshot is None or not self._seen:
            return
        frame, costs, pending, ends = snapshot.frame, self._known_costs(snapshot), None, ""
        if self._forecast is not None and self._forecast[0].scene == snapshot.request.scene:
            pending = self._forecast[1]
        same = pending is None or pending.plan.included == frame.plan.included
        self.table.show_rows(rows_of(frame, costs, self._new, None if same else pending))
        if same or pending is None:
            sentence = picture_sentence(costs, snapshot.simulation_seconds, pending)
            ends = ends_sentence(costs, frame.plan.unit)
        else:
            sentence = forecast_sentence(frame, costs.picture, pending)
        if self._switched:
            sentence += " " + switch_sentence(self._switched) + "."
        self.summary.set_full_text(sentence)
        self.ends.set_full_text(ends)
        self.ends.setVisible(bool(ends))
        self._show_detail(costs)

    def _known_costs(self, snapshot: Snapshot) -> MeasuredCosts:
        picture = TimeFractions.of(snapshot.frame)
        if self._costs is None:
            return MeasuredCosts(picture)
        return self._costs.of(snapshot.request, picture)

    def _select(self, effect: str) -> None:
        self._selected = effect
        self._draw()
        self.panels.show_panel(self.detail)

    def _show_detail(self, costs: MeasuredCosts) -> None:
        rows = {row.effect: row for row in self.table.effects.rows}
        self._slowest = slowest_of(self.table.effects.rows, self._slowest)
        effect = self._selected or self._slowest
        difference = costs.differences.get(effect)
        self.detail.show_row(rows.get(effect), None if difference is None else difference.crop)
