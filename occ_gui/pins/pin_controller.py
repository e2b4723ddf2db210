"""Controller of the pins: keeps two scenes, compares them, and returns to either."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Report, Task
from occ_gui.scene.forced_effects import forced_text
from occ_gui.scene.parameter_rows import explain
from occ_gui.scene.scene_store import SceneStore, new_gesture
from occ_gui.simulation.jobs import explain_failures, snapshot_of
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.simulation.verdict import cause_in, is_right, reason_in
from occ_gui.values.simulated import PinnedScene, Pins, SimulationRequest
from occ_model.arrays import FloatArray
from occ_model.errors import OccError, one_line
from occ_model.results.bands import format_depth
from occ_model.results.decoding import PAPER_DECODER, DecodeResult
from occ_model.scene.light_words import has_chips
from occ_model.scene.parameter_kinds import Parameter, ParameterValue, format_distinctly
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, TOLERANCE, Scene, SimulationSettings
from occ_model.simulation.render import render_with


@dataclass(frozen=True, eq=False, slots=True)
class Pin:
    request: SimulationRequest
    profile: FloatArray  # shape (columns,), in grey levels
    # The first column of the panel, and the columns of one period of the signal sent
    first_column: float
    period_columns: float
    outputs: tuple[tuple[str, str, str], ...]  # the name, text and meaning of each

    @property
    def scene(self) -> Scene:
        return self.request.scene

    @property
    def settings(self) -> SimulationSettings:
        return self.request.settings


@dataclass(frozen=True, slots=True)
class DifferenceRow:
    name: str
    a: str
    b: str
    meaning: str


@dataclass(frozen=True, eq=False, slots=True)
class PinnedPair:
    a: Pin | None = None
    b: Pin | None = None
    inputs: tuple[DifferenceRow, ...] = ()
    outputs: tuple[DifferenceRow, ...] = ()


_LONGEST_PAYLOAD = 24  # characters of a payload that the table shows


_NAMES = ("A", "B")


class PinController(QObject):
    """Keeps up to two scenes, A and B; a pin waits until the present scene is simulated."""

    status_message = Signal(str)  # what was done, or why it could not be done
    changed = Signal()  # the pinned scenes or their results have changed
    both_pinned = Signal()  # the user has just pinned the second of two scenes

    def __init__(
        self, scenes: SceneStore, is_present: Callable[[Snapshot], bool] = lambda _snapshot: True
    ) -> None:
        super().__init__()
        self._is_present = is_present
        self._waiting_name = ""
        self._scenes, self._store = scenes, scenes.store
        self._snapshot: Snapshot | None = None
        self._pins: dict[str, Pin] = {}
        self._may_simulate = False
        self.pinned = PinnedPair()
        self.runner: Task[dict[str, SimulationRequest], None] = Task(
            _simulate_all, "comparison", impatient=True
        )
        self.runner.reported.connect(self._take_snapshot)
        self.runner.finished.connect(self._forget_missing)
        self.runner.failed.connect(self._forget_missing)
        self._store.select(lambda workspace: workspace.pins).changed.connect(self._follow_pins)

    @property
    def _pinned_scenes(self) -> dict[str, PinnedScene]:
        pins = zip(_NAMES, self._store.workspace.pins, strict=True)
        return {name: pin for name, pin in pins if pin is not None}

    @property
    def _missing(self) -> dict[str, SimulationRequest]:
        """Pins from an earlier session that are not simulated yet."""
        return {
            name: pin.request for name, pin in self._pinned_scenes.items() if name not in self._pins
        }

    @property
    def is_idle(self) -> bool:
        return not self._missing

    def _store_pin(self, name: str, pin: PinnedScene | None) -> None:
        workspace = self._store.workspace
        a, b = workspace.pins
        pins = (pin, b) if name == "A" else (a, pin)
        self._store.put(replace(workspace, pins=pins))

    def _follow_pins(self, _pins: Pins) -> None:
        scenes = self._pinned_scenes
        self._pins = {
            name: pin
            for name, pin in self._pins.items()
            if name in scenes and scenes[name].request == pin.request
        }
        self._compare()
        self._simulate()

    def _simulate(self) -> None:
        """Simulate the missing pins, once the window has its first picture."""
        if self._missing and self._may_simulate and self.runner.is_idle:
            self.runner.ask(self._missing)

    def _take_snapshot(self, result: tuple[str, Snapshot]) -> None:
        name, snapshot = result
        if self._missing.get(name) == snapshot.request:
            self._pins[name] = self._pin_of(snapshot)
            self._compare()

    def _forget_missing(self, _result: object) -> None:
        for name in self._missing:
            self._store_pin(name, None)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Use these results for the next pin, or for a pin that waits for them."""
        self._snapshot, self._may_simulate = snapshot, True
        self._simulate()
        if self._waiting_name and self._is_present(snapshot):
            self.pin(self._waiting_name)

    def cancel_waiting(self) -> None:
        """Cancel a waiting pin, because the present scene has no picture."""
        self._may_simulate = True
        self._simulate()
        if self._waiting_name:
            name, self._waiting_name = self._waiting_name, ""
            self.status_message.emit(f"{name} is not pinned: this scene has no picture.")

    def pin(self, name: str) -> None:
        snapshot = self._snapshot
        if snapshot is None:
            self.status_message.emit("There is no picture to pin yet.")
            return
        if not self._is_present(snapshot):
            self._waiting_name = name
            self.status_message.emit(f"{name} will be pinned as soon as this scene is computed.")
            return
        self._waiting_name = ""
        self._pins[name] = self._pin_of(snapshot)
        self._store_pin(name, PinnedScene(snapshot.request, self._store.workspace.preset))
        self._compare()
        pinned = f"Pinned the present scene as {name}"
        if len(self._pins) < len(_NAMES):
            other = "B" if name == "A" else "A"
            self.status_message.emit(f"{pinned}. Change it, and pin it as {other}.")
            return
        self.both_pinned.emit()
        self.status_message.emit(f"{pinned}.")

    def clear(self) -> None:
        self._store.put(replace(self._store.workspace, pins=(None, None)))
        self.status_message.emit("Nothing is pinned any more.")

    def go_to(self, name: str) -> None:
        """Replace the scene by that of A or B, as one undo step."""
        pin = self._pinned_scenes.get(name)
        if pin is None:
            self.status_message.emit(f"Nothing is pinned as {name} yet.")
            return
        scene, force = pin.request.scene, pin.request.settings.force
        title = f"return to {name}"
        self._scenes.put(scene, title, new_gesture(), force=force, preset=pin.preset)

    def _compare(self) -> None:
        a, b = (self._pins.get(name) for name in _NAMES)
        inputs: tuple[DifferenceRow, ...] = ()
        outputs: tuple[DifferenceRow, ...] = ()
        if a is not None and b is not None:
            inputs = tuple(self._compare_inputs(a, b))
            outputs = tuple(self._compare_outputs(a, b))
        self.pinned = PinnedPair(a, b, inputs, outputs)
        self.changed.emit()

    def _compare_inputs(self, a: Pin, b: Pin) -> list[DifferenceRow]:
        names = (name for names in GROUPS.values() for name in names)
        inputs: list[tuple[Parameter, ParameterValue, ParameterValue]] = [
            (PARAMETERS[name], a.scene.value(name), b.scene.value(name)) for name in names
        ]
        inputs.append((TOLERANCE, a.settings.tolerance, b.settings.tolerance))
        rows = []
        for parameter, value_a, value_b in inputs:
            if value_a != value_b:
                texts = format_distinctly(parameter, value_a, value_b)
                first, second = (text or "none" for text in texts)
                rows.append(DifferenceRow(parameter.label, first, second, explain(parameter)))
        if a.settings.force != b.settings.force:
            labels = self._scenes.settings.effect_labels
            forced = (forced_text(pin.settings.force, labels) for pin in (a, b))
            first, second = (text or "none" for text in forced)
            meaning = "Effects that you have switched on or off; the plan decides about the others."
            rows.append(DifferenceRow("Effects switched", first, second, meaning))
        return rows

    def _compare_outputs(self, a: Pin, b: Pin) -> Iterator[DifferenceRow]:
        """Compare outputs by name; slow decoders and plug-ins have one only if they were chosen."""
        texts = [{name: text for name, text, _ in pin.outputs} for pin in (a, b)]
        meanings = {name: meaning for name, _, meaning in (*a.outputs, *b.outputs)}
        for name, meaning in meanings.items():
            text_a, text_b = (texts_of_pin.get(name, "not read") for texts_of_pin in texts)
            if text_a != text_b:
                yield DifferenceRow(name, text_a, text_b, meaning)

    def _pin_of(self, snapshot: Snapshot) -> Pin:
        frame = snapshot.frame
        return Pin(
            request=snapshot.request,
            profile=frame.profile,
            first_column=snapshot.panel_origin[0],
            period_columns=snapshot.period_columns,
            outputs=tuple(self._measure_outputs(snapshot)),
        )

    def _measure_outputs(self, snapshot: Snapshot) -> list[tuple[str, str, str]]:
        frame = snapshot.frame
        included = {
            decision.effect: decision.label
            for decision in frame.plan.decisions
            if decision.included
        }
        return [
            (
                "Contrast",
                f"{float(np.ptp(frame.profile)):.1f} grey levels",
                "Swing of the profile: the largest value minus the smallest.",
            ),
            *_measure_periods(snapshot),
            (
                "Effects simulated",
                ", ".join(included.values()) or "none",
                "The effects that the plan includes.",
            ),
            (
                "Simulation time",
                f"{1e3 * snapshot.simulation_seconds:.1f} ms",
                "Time to compute the picture.",
            ),
            *self._describe_decoders(snapshot),
        ]

    def _describe_decoders(self, snapshot: Snapshot) -> list[tuple[str, str, str]]:
        rows = []
        for decoder, result in snapshot.results.items():
            name = f"Decoder “{decoder}”"
            rows.append((name, self._describe_code(result, snapshot), "The code that it read."))
            if decoder != PAPER_DECODER:
                confidence = result.confidence
                text = "none" if confidence is None else f"{confidence:.3f}"
                meaning = "Lead of the best code over the second best, 0 to 1."
                rows.append((f"Confidence, “{decoder}”", text, meaning))
        return rows

    def _describe_code(self, result: DecodeResult, snapshot: Snapshot) -> str:
        if result.code is None:
            return reason_in(snapshot, result) or "no code read"
        cause = cause_in(snapshot, result)
        verdict = "right" if is_right(result, snapshot.sent) else "wrong"
        if cause is not None:
            verdict += f": {cause.what}"
        if result.payload:
            payload = one_line(result.payload, _LONGEST_PAYLOAD)
            return f"“{payload}”, {verdict}"
        return f"code {result.code}, {verdict}"


def _measure_periods(snapshot: Snapshot) -> list[tuple[str, str, str]]:
    """Return columns per chip and chips per exposure; for other lights, those of the period."""
    camera, sent = snapshot.scene.camera, snapshot.scene.transmitter
    seconds, unit, name = snapshot.light_period, "period", "The light's period"
    if has_chips(sent):
        seconds, unit, name = sent.switching_period, "chip", "Switching period"
    return [
        (
            f"Columns per {unit}",
            f"{seconds / camera.readout_time:.2f} columns",
            f"{name} divided by readout time.",
        ),
        (
            "Exposure",
            f"{camera.exposure_time / seconds:.3f} {unit}s",
            f"Exposure time divided by {name[:1].lower()}{name[1:]}.",
        ),
        *(
            [
                (
                    "Bars",
                    f"{format_depth(snapshot.bars.peak_to_peak)} of the mean light",
                    "Depth of the bars, peak to peak.",
                )
            ]
            if snapshot.bars is not None
            else []
        ),
    ]


def _simulate_all(pins: dict[str, SimulationRequest], report: Report) -> None:
    """Simulate the pictures of pins, except those of scenes that have none."""
    for name, pin in pins.items():
        with suppress(OccError):
            report((name, explain_failures(snapshot_of(pin, render_with(pin.scene, pin.settings)))))
