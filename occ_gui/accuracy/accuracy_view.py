"""Pane of accuracy and time: the tolerance, the table of effects, and error over time."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSplitter, QVBoxLayout, QWidget

from occ_gui.accuracy.accuracy_plot import AccuracyPlot
from occ_gui.accuracy.effect_table import EffectTable
from occ_gui.accuracy.plan_changes import PlanChanges, Switch
from occ_gui.scene.parameter_rows import QuantityRow, explain
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_model.scene.simulation_settings import TOLERANCE, SimulationSettings

_WIDEST_TABLE = 780
"""Largest useful width of the table in pixels; the plot takes the remaining width."""


class AccuracyView(QWidget):
    """The tolerance, the table of effects, and the plot of error over time.

    It draws only while it is visible, as :meth:`set_seen` says.
    """

    visibility_changed = Signal(bool)
    """Whether the pane has become visible or hidden."""

    tolerance_edited = Signal(float)
    observable_chosen = Signal(str)
    noise_chosen = Signal(str)
    effect_switched = Signal(str, object)
    """An effect's name, and the choice: True (on), False (off) or None (the plan decides)."""

    refused = Signal(str)
    """Why an entered value is refused."""

    mended = Signal()
    """An allowed tolerance was entered, whether or not it differs from the last one."""

    plan_changed = Signal(str)
    """A sentence on the effects that the plan has just switched in or out."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._snapshot: Snapshot | None = None
        self._drawn: Snapshot | None = None
        self._seen = False
        self._changes = PlanChanges()
        self._sentence = ""
        self._marked: tuple[Switch, ...] = ()
        self.tolerance = QuantityRow(TOLERANCE)
        self.tolerance.edited.connect(self.mended)
        self.tolerance.edited.connect(lambda _, value: self.tolerance_edited.emit(value))
        self.tolerance.refused.connect(self.refused)
        self.observable = _choice(
            self.tr("What the tolerance limits"),
            self.tr(
                "What the tolerance limits: errors of the panel's pixels, of its column means, or "
                "of the signal that a decoder reads, the column means after the enhancement."
            ),
            {
                "image": self.tr("picture"),
                "profile": self.tr("profile"),
                "signal": self.tr("signal"),
            },
        )
        self.noise = _choice(
            self.tr("Noise"),
            self.tr("Noise drawn for every pixel, or taken from a stored plane: much faster."),
            {"reused": self.tr("reused"), "exact": self.tr("exact")},
        )
        self.observable.activated.connect(
            lambda: self.observable_chosen.emit(self.observable.currentData())
        )
        self.noise.activated.connect(lambda: self.noise_chosen.emit(self.noise.currentData()))
        self.summary = ElidedLabel("", Qt.TextElideMode.ElideRight)
        self.table, self.plot = EffectTable(), AccuracyPlot()
        self.table.switched.connect(self.effect_switched)
        self._lay_out()

    def _lay_out(self) -> None:
        label = QLabel(TOLERANCE.label)
        label.setToolTip(explain(TOLERANCE))
        row = QHBoxLayout()
        row.addWidget(label)
        row.addWidget(self.tolerance, 1)
        for text, control in ((self.tr("of the"), self.observable), (self.tr("Noise"), self.noise)):
            row.addWidget(QLabel(text))
            row.addWidget(control)
        left = self.effects = QWidget()
        left.setMaximumWidth(_WIDEST_TABLE)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.summary)
        column.addWidget(self.table, 1)
        panes = QSplitter(Qt.Orientation.Horizontal)
        panes.addWidget(left)
        panes.addWidget(self.plot)
        panes.setChildrenCollapsible(False)
        panes.setSizes([590, 350])
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 2, 4, 2)
        layout.setSpacing(2)
        layout.addLayout(row)
        layout.addWidget(panes, 1)

    def set_seen(self, seen: bool) -> None:
        """Draw from now on, or stop drawing while the pane is hidden."""
        self._seen = seen
        self._redraw()
        self.visibility_changed.emit(seen)

    def show_settings(self, settings: SimulationSettings) -> None:
        """Show the simulation settings without emitting a signal."""
        self.tolerance.show_value(settings.tolerance)
        self.observable.setCurrentIndex(self.observable.findData(settings.observable))
        self.noise.setCurrentIndex(self.noise.findData(settings.noise))
        self.table.show_force(settings.force)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""
        self._snapshot = snapshot
        if self._changes.update(snapshot.frame):
            self._sentence = self._switched_effects()
            self.plan_changed.emit(self._sentence)
        self._redraw()

    def _redraw(self) -> None:
        snapshot = self._snapshot
        if snapshot is None or snapshot is self._drawn or not self._seen:
            return
        self._drawn = snapshot
        frame = snapshot.frame
        new = {switch.decision.effect for switch in self._changes.switches}
        self.table.show_frame(frame, new)
        if self._marked != self._changes.switches:
            self._marked = self._changes.switches
            self.table.bring_into_view(new)
        effects = sum(frame.timings.get(effect, 0.0) for effect in frame.plan.included)
        cost = self.tr("Frame {frame:.1f} ms, of which effects {effects:.1f} ms").format(
            frame=1e3 * snapshot.simulation_seconds, effects=1e3 * effects
        )
        self.summary.set_full_text(f"{self._sentence}. {cost}" if self._sentence else cost)

    def _switched_effects(self) -> str:
        """Name the effects that were switched, with the time that each costs or saves."""
        switches = self._changes.switches
        switched_in = [self._cost(s, "+") for s in switches if s.decision.included]
        switched_out = [self._cost(s, "−") for s in switches if not s.decision.included]  # noqa: RUF001
        parts = []
        if switched_in:
            parts.append(self.tr("Switched in: {effects}").format(effects="; ".join(switched_in)))
        if switched_out:
            parts.append(self.tr("Switched out: {effects}").format(effects="; ".join(switched_out)))
        return ". ".join(parts)

    def _cost(self, switch: Switch, sign: str) -> str:
        return self.tr("{label}, {sign}{time:.1f} ms").format(
            label=switch.decision.label, sign=sign, time=1e3 * switch.seconds
        )


def _choice(name: str, meaning: str, words: dict[str, str]) -> QComboBox:
    control = QComboBox()
    for key, word in words.items():
        control.addItem(word, key)
    control.setAccessibleName(name)
    control.setToolTip(meaning)
    keep_wheel_for_scrolling(control)
    return control
