"""View of accuracy and time: slider from fast to exact, table of effects, plot, answer."""

from PySide6.QtCore import Signal
from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.accuracy.accuracy_plot import AccuracyPlot
from occ_gui.accuracy.effect_detail import EffectDetail
from occ_gui.accuracy.effect_rows import find_slowest, make_rows
from occ_gui.accuracy.effect_table import EffectTable
from occ_gui.accuracy.panels import Panel, Panels
from occ_gui.accuracy.plan_changes import describe_switches
from occ_gui.accuracy.tolerance_slider import ToleranceSlider, list_marks
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.simulated import SimulationRequest
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import KeyedComboBox, fill
from occ_model.results.accuracy import Forecast, MeasuredCosts, TimeFractions
from occ_model.results.frame import Decision
from occ_model.results.move_cost import (
    state_measurement,
    state_move,
    state_saving,
    state_switches,
)
from occ_model.scene.scene import SimulationSettings, unit_of

_TABLE_WIDTH, _PLOT_WIDTH, _DETAIL_WIDTH = 560, 344, 312  # pixels of the parts side by side


class AccuracyView(QWidget):
    """The slider from fast to exact, the table of effects, and the plot of error over time."""

    tolerance_edited = Signal(float)
    refused = Signal(str)  # why an entered value is refused

    accepted = Signal()  # a valid tolerance was entered, even if unchanged

    def __init__(self) -> None:
        super().__init__()
        self._snapshot: Snapshot | None = None
        self._costs: tuple[SimulationRequest, MeasuredCosts] | None = None
        self._forecast: tuple[SimulationRequest, Forecast] | None = None
        self._new_decisions: tuple[Decision, ...] = ()
        self._marked_decisions: tuple[Decision, ...] = ()
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
            {"image": "picture", **{name: name for name in ("profile", "signal", "decision")}},
            is_fixed=True,
        )
        self.answer = Answer()
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
        controls = fill(
            QHBoxLayout(), (self.tolerance, 1), QLabel("of the"), self.observable, spacing=8
        )
        tabs = fill(QHBoxLayout(), None, self.panels.tabs)
        parts = (controls, self.answer, tabs, (self.panels, 1))
        fill(QVBoxLayout(self), *parts, margins=(8, 2, 8, 2), spacing=2)

    @property
    def scene_parts(self) -> tuple[QWidget, ...]:
        return self.table, self.detail

    def show_settings(self, settings: SimulationSettings) -> None:
        self.tolerance.show_unit(unit_of(settings.observable))
        self.plot.show_unit(unit_of(settings.observable))
        self.tolerance.show_value(settings.tolerance)
        self.table.show_tolerance(settings.tolerance)
        self.observable.show_key(settings.observable)
        self.table.show_force(settings.force)

    def offer_decision(self, has_code: bool) -> None:
        """Let the tolerance limit errors of the decision only while a code is sent."""
        entries = self.observable.model()
        if isinstance(entries, QStandardItemModel):
            entries.item(self.observable.findData("decision")).setEnabled(has_code)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._draw()
        if self._marked_decisions != self._new_decisions:
            self._marked_decisions = self._new_decisions
            self.table.bring_into_view({each.effect for each in self._new_decisions})

    def mark_switched(self, decisions: tuple[Decision, ...]) -> None:
        """Mark the effects that the plan has just switched; an empty tuple removes the marks."""
        if decisions != self._new_decisions:
            self._new_decisions = decisions
            if not decisions:  # new marks are drawn with the picture, which follows
                self._draw()

    def show_costs(self, request: SimulationRequest, costs: MeasuredCosts) -> None:
        """Show the measured costs of a scene with some settings."""
        self._costs = (request, costs)
        self._draw()

    def show_forecast(self, request: SimulationRequest, forecast: Forecast) -> None:
        """Show the forecast time and error of a picture with the present settings."""
        self._forecast = (request, forecast)
        if not self.tolerance.slider.isSliderDown():
            self.tolerance.show_marks(list_marks(forecast.effect_sets))
        self.plot.show_effect_sets(forecast)
        self._draw()

    def _draw(self) -> None:
        snapshot = self._snapshot
        if snapshot is None:
            return
        frame, costs, forecast = snapshot.frame, self._find_costs(snapshot), None
        if self._forecast is not None and self._forecast[0].scene == snapshot.request.scene:
            forecast = self._forecast[1]
        switched = None
        if forecast is not None and forecast.plan.included != frame.plan.included:
            switched = forecast
        new = {decision.effect for decision in self._new_decisions}
        self.table.show_rows(make_rows(frame, costs, new, switched))
        notes = [] if forecast is None else [state_saving(costs, forecast)]
        if switched is not None:
            notes.append(state_switches(frame.plan, switched.plan))
        elif self._new_decisions:
            notes.append(f"{describe_switches(self._new_decisions)}.")
        self.answer.show_answer(
            state_move(costs, switched), [state_measurement(costs)], " ".join(notes)
        )
        self._show_detail(costs)

    def _find_costs(self, snapshot: Snapshot) -> MeasuredCosts:
        if self._costs is not None and self._costs[0].scene == snapshot.request.scene:
            return self._costs[1]
        return MeasuredCosts(TimeFractions.of(snapshot.frame))

    def _select(self, effect: str) -> None:
        self._selected = effect
        self._draw()
        self.panels.show_panel(self.detail)

    def _show_detail(self, costs: MeasuredCosts) -> None:
        rows = {row.effect: row for row in self.table.effects.rows}
        self._slowest = find_slowest(self.table.effects.rows, self._slowest)
        effect = self._selected or self._slowest
        difference = costs.differences.get(effect)
        self.detail.show_row(rows.get(effect), None if difference is None else difference.crop)
