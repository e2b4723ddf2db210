"""Controller of the pins: keep two states, compare them, and return to either."""

from collections.abc import Callable, Iterator
from contextlib import suppress

import numpy as np
from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Report, Task
from occ_gui.pins.pinned import ComparedRow, Pin, Pinned
from occ_gui.scene.forced_effects import forced_text
from occ_gui.scene.gesture import new_gesture
from occ_gui.scene.parameter_rows import explain
from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.jobs import snapshot_of
from occ_gui.simulation.snapshot import Pins, SimulationRequest, Snapshot
from occ_model.errors import OccError, one_line
from occ_model.results.decoding import DecodeResult
from occ_model.scene.parameter_kinds import Parameter, ParameterValue, distinguished
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS
from occ_model.scene.simulation_settings import TOLERANCE
from occ_model.simulation.render import render_with

_LONGEST_PAYLOAD = 24
"""Characters of a payload that the table shows."""


_NAMES = ("A", "B")


class PinController(QObject):
    """Keeps up to two states, A and B.

    What is pinned is the present state: while it is being computed, the pin waits for it.
    """

    status_message = Signal(str)
    """What was done, or why it could not be done."""

    changed = Signal()
    """Something else is pinned."""

    both_pinned = Signal()
    """There are two states to compare, as the user has just asked for."""

    def __init__(
        self,
        scenes: SceneStore,
        is_present: Callable[[Snapshot], bool] = lambda _snapshot: True,
    ) -> None:
        super().__init__()
        self._is_present = is_present
        self._waiting = ""
        self._scenes = scenes
        self._snapshot: Snapshot | None = None
        self.pinned = Pinned()
        self._restored: dict[str, SimulationRequest] = {}
        self._runner: Task[dict[str, SimulationRequest], None] | None = None

    @property
    def kept(self) -> Pins:
        """What is pinned as A and as B, also while its picture is still being simulated."""
        a, b = (
            self._restored.get(name) if pin is None else pin.request
            for name, pin in zip(_NAMES, (self.pinned.a, self.pinned.b), strict=True)
        )
        return a, b

    @property
    def is_idle(self) -> bool:
        """Whether all that is pinned can be compared."""
        return not self._restored

    def restore(self, pins: Pins) -> None:
        """Pin what an earlier window had pinned, once the first picture is there."""
        kept = zip(_NAMES, pins, strict=True)
        self._restored = {name: pin for name, pin in kept if pin is not None}

    def _begin_restoring(self) -> None:
        if not self._restored or self._runner is not None:
            return
        self._runner = runner = Task(_simulate_all, "comparison", impatient=True)
        runner.reported.connect(self._take_restored)
        runner.finished.connect(self._end_restoring)
        runner.failed.connect(self._end_restoring)
        runner.ask(dict(self._restored))

    def _take_restored(self, result: tuple[str, Snapshot]) -> None:
        name, snapshot = result
        if self._restored.pop(name, None) is not None:
            self._put_one(name, self._pin_of(snapshot))

    def _end_restoring(self, _result: object) -> None:
        self._restored.clear()

    def stop(self) -> None:
        """Stop what restores the pins of an earlier window."""
        if self._runner is not None:
            self._runner.stop()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Keep these results for the next pin, or for the one that waits for them."""
        self._snapshot = snapshot
        self._begin_restoring()
        if self._waiting and self._is_present(snapshot):
            self.pin(self._waiting)

    def give_up(self) -> None:
        """Pin nothing any more: the present scene has no picture."""
        self._begin_restoring()
        if self._waiting:
            name, self._waiting = self._waiting, ""
            self.status_message.emit(f"{name} is not pinned: this scene has no picture.")

    def pin(self, name: str) -> None:
        """Keep the current state as A or as B."""
        if self._snapshot is None:
            self.status_message.emit("There is no picture to pin yet.")
            return
        if not self._is_present(self._snapshot):
            self._waiting = name
            self.status_message.emit(f"{name} is pinned as soon as this scene is computed.")
            return
        self._waiting = ""
        self._restored.pop(name, None)
        self._put_one(name, self._pin_of(self._snapshot))
        told = "Pinned the current state as {name}."
        if self.pinned.a is None or self.pinned.b is None:
            told = "Pinned the current state as {name}: change it, and pin {other}, too."
        else:
            self.both_pinned.emit()
        other = "B" if name == "A" else "A"
        self.status_message.emit(told.format(name=name, other=other))

    def clear(self) -> None:
        """Forget both."""
        self._restored.clear()
        self._put(None, None)
        self.status_message.emit("Nothing is pinned any more.")

    def go_to(self, name: str) -> None:
        """Replace the scene by that of A or of B, as one step."""
        pin = self.kept[_NAMES.index(name)]
        if pin is None:
            self.status_message.emit(f"Nothing is pinned as {name} yet.")
            return
        title = f"return to {name}"
        self._scenes.put(pin.scene, title, new_gesture(), force=pin.settings.force)

    def _put_one(self, name: str, pin: Pin) -> None:
        a, b = self.pinned.a, self.pinned.b
        self._put(*((pin, b) if name == "A" else (a, pin)))

    def _put(self, a: Pin | None, b: Pin | None) -> None:
        inputs: tuple[ComparedRow, ...] = ()
        outputs: tuple[ComparedRow, ...] = ()
        if a is not None and b is not None:
            inputs = tuple(self._differing_inputs(a, b))
            outputs = tuple(self._differing_outputs(a, b))
        self.pinned = Pinned(a, b, inputs, outputs)
        self.changed.emit()

    def _differing_inputs(self, a: Pin, b: Pin) -> list[ComparedRow]:
        names = (name for names in GROUPS.values() for name in names)
        inputs: list[tuple[Parameter, ParameterValue, ParameterValue]] = [
            (PARAMETERS[name], a.scene.value(name), b.scene.value(name)) for name in names
        ]
        inputs.append((TOLERANCE, a.settings.tolerance, b.settings.tolerance))
        rows = []
        for declared, one, other in inputs:
            if one != other:
                texts = distinguished(declared, one, other)
                first, second = (text or "none" for text in texts)
                rows.append(ComparedRow(declared.label, first, second, explain(declared)))
        if a.settings.force != b.settings.force:
            labels = self._scenes.settings.effect_labels
            forced = (forced_text(pin.settings.force, labels) for pin in (a, b))
            first, second = (text or "none" for text in forced)
            meaning = "Effects that you have switched on or off; the plan decides others."
            rows.append(ComparedRow("Effects by hand", first, second, meaning))
        return rows

    def _differing_outputs(self, a: Pin, b: Pin) -> Iterator[ComparedRow]:
        """Compare by name: a slow decoder, or a plug-in's, has read only where it was chosen."""
        texts = [{what: text for what, text, _ in pin.outputs} for pin in (a, b)]
        meanings = {what: meaning for what, _, meaning in (*a.outputs, *b.outputs)}
        for what, meaning in meanings.items():
            one, other = (found.get(what, "not read") for found in texts)
            if one != other:
                yield ComparedRow(what, one, other, meaning)

    def _pin_of(self, snapshot: Snapshot) -> Pin:
        frame = snapshot.frame
        return Pin(
            request=snapshot.request,
            profile=frame.profile,
            first_column=snapshot.panel_origin[0],
            packet_columns=snapshot.packet_columns,
            outputs=tuple(self._outputs(snapshot)),
        )

    def _outputs(self, snapshot: Snapshot) -> list[tuple[str, str, str]]:
        frame = snapshot.frame
        scene = frame.scene
        period = scene.transmitter.switching_period
        shown = {d.effect: d.label for d in frame.plan.decisions if d.included}
        return [
            (
                "Contrast",
                f"{float(np.ptp(frame.profile)):.1f} grey levels",
                "Swing of the profile: its largest minus its smallest value.",
            ),
            (
                "Columns a chip",
                f"{period / scene.camera.readout_time:.2f} columns",
                "Switching period divided by readout time.",
            ),
            (
                "Exposure",
                f"{scene.camera.exposure_time / period:.3f} chips",
                "Exposure time divided by switching period.",
            ),
            (
                "Effects simulated",
                ", ".join(shown.values()) or "none",
                "The effects that the plan includes.",
            ),
            (
                "Simulation time",
                f"{1e3 * snapshot.simulation_seconds:.1f} ms",
                "Computing time of the picture.",
            ),
            *self._readings(snapshot),
        ]

    def _readings(self, snapshot: Snapshot) -> list[tuple[str, str, str]]:
        rows = []
        for result in (snapshot.decoded, *snapshot.others):
            name = f"Decoder “{result.decoder}”"
            rows.append((name, self._reading(result, snapshot), "The code that it read."))
            if result.decoder != snapshot.decoded.decoder:
                sure = result.confidence
                text = "none" if sure is None else f"{sure:.3f}"
                meaning = "Lead of the best code over the second best, 0 to 1."
                rows.append((f"Confidence, “{result.decoder}”", text,
                             meaning))  # fmt: skip
        return rows

    def _reading(self, result: DecodeResult, snapshot: Snapshot) -> str:
        if result.code is None:
            return result.failure or "no code read"
        right = tuple(result.bits.tolist()) == snapshot.sent
        verdict = "right" if right else "wrong"
        if result.payload:
            payload = one_line(result.payload, _LONGEST_PAYLOAD)
            return f"“{payload}”, {verdict}"
        return f"code {result.code}, {verdict}"


def _simulate_all(pins: dict[str, SimulationRequest], report: Report) -> None:
    """Simulate the pictures of pins; one that has none, or no longer, is left out."""
    for name, pin in pins.items():
        with suppress(OccError):
            report((name, snapshot_of(pin, render_with(pin.scene, pin.settings))))
