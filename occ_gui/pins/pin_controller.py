"""Controller of the pins: keep two states, compare them, and return to either."""

from collections.abc import Callable, Iterator
from typing import Protocol

import numpy as np
from PySide6.QtCore import QObject, Signal

from occ_gui.pins.pinned import ComparedRow, Pin, Pinned
from occ_gui.scene.forced_effects import forced_text
from occ_gui.scene.gesture import new_gesture
from occ_gui.scene.parameter_rows import explain
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.wording import distinguished
from occ_gui.simulation.snapshot import Snapshot
from occ_model.errors import one_line
from occ_model.results import DecodeResult
from occ_model.scene.parameter_kinds import Parameter, ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS
from occ_model.scene.simulation_settings import TOLERANCE

_LONGEST_PAYLOAD = 24
"""Characters of a payload that the table shows."""


class ComparePane(Protocol):
    """A pane that shows the differences of two states."""

    def show_pinned(self, pinned: Pinned) -> None:
        """Show these two states in place of the previous ones."""


class PinController(QObject):
    """Keeps up to two states, A and B.

    What is pinned is the present state: while it is being computed, the pin waits for it.

    Parameters
    ----------
    scenes
        The scene, which a return to A or B replaces.
    pane
        The pane that shows the differences.
    is_present
        Returns whether results are those of the present scene and settings.
    """

    status_message = Signal(str)
    """What was done, or why it could not be done."""

    both_pinned = Signal()
    """There are two states to compare, as the user has just asked for."""

    def __init__(
        self,
        scenes: SceneStore,
        pane: ComparePane,
        is_present: Callable[[Snapshot], bool] = lambda _snapshot: True,
    ) -> None:
        super().__init__()
        self._is_present = is_present
        self._waiting = ""
        self._scenes = scenes
        self._pane = pane
        self._snapshot: Snapshot | None = None
        self.pinned = Pinned()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Keep these results for the next pin, or for the one that waits for them."""
        self._snapshot = snapshot
        if self._waiting and self._is_present(snapshot):
            self.pin(self._waiting)

    def give_up(self) -> None:
        """Pin nothing any more: the present scene has no picture."""
        if self._waiting:
            name, self._waiting = self._waiting, ""
            self.status_message.emit(
                self.tr("{name} is not pinned: this scene has no picture.").format(name=name)
            )

    def pin(self, name: str) -> None:
        """Keep the current state as A or as B."""
        if self._snapshot is None:
            self.status_message.emit(self.tr("There is no picture to pin yet."))
            return
        if not self._is_present(self._snapshot):
            self._waiting = name
            self.status_message.emit(
                self.tr("{name} is pinned as soon as this scene is computed.").format(name=name)
            )
            return
        self._waiting = ""
        new = self._pin_of(self._snapshot)
        a, b = (new, self.pinned.b) if name == "A" else (self.pinned.a, new)
        self._put(a, b)
        told = self.tr("Pinned the current state as {name}.")
        if self.pinned.a is None or self.pinned.b is None:
            told = self.tr("Pinned the current state as {name}: change it, and pin {other}, too.")
        else:
            self.both_pinned.emit()
        other = "B" if name == "A" else "A"
        self.status_message.emit(told.format(name=name, other=other))

    def clear(self) -> None:
        """Forget both."""
        self._put(None, None)
        self.status_message.emit(self.tr("Nothing is pinned any more."))

    def go_to(self, name: str) -> None:
        """Replace the scene by that of A or of B, as one step."""
        pin = self.pinned.a if name == "A" else self.pinned.b
        if pin is None:
            self.status_message.emit(self.tr("Nothing is pinned as {name} yet.").format(name=name))
            return
        title = self.tr("return to {name}").format(name=name)
        self._scenes.put(pin.scene, title, new_gesture(), force=pin.force)

    def _put(self, a: Pin | None, b: Pin | None) -> None:
        inputs: tuple[ComparedRow, ...] = ()
        outputs: tuple[ComparedRow, ...] = ()
        if a is not None and b is not None:
            inputs = tuple(self._differing_inputs(a, b))
            outputs = tuple(self._differing_outputs(a, b))
        self.pinned = Pinned(a, b, inputs, outputs)
        self._pane.show_pinned(self.pinned)

    def _differing_inputs(self, a: Pin, b: Pin) -> list[ComparedRow]:
        names = (name for names in GROUPS.values() for name in names)
        inputs: list[tuple[Parameter, ParameterValue, ParameterValue]] = [
            (PARAMETERS[name], a.scene.value(name), b.scene.value(name)) for name in names
        ]
        inputs.append((TOLERANCE, a.tolerance, b.tolerance))
        rows = []
        for declared, one, other in inputs:
            if one != other:
                texts = distinguished(declared, one, other)
                first, second = (text or self.tr("none") for text in texts)
                rows.append(ComparedRow(declared.label, first, second, explain(declared)))
        if a.force != b.force:
            labels = self._scenes.settings.effect_labels
            first, second = (forced_text(p.force, labels) or self.tr("none") for p in (a, b))
            meaning = self.tr("Effects that you have switched on or off; the plan decides others.")
            rows.append(ComparedRow(self.tr("Effects by hand"), first, second, meaning))
        return rows

    def _differing_outputs(self, a: Pin, b: Pin) -> Iterator[ComparedRow]:
        """Compare by name: a slow decoder, or a plug-in's, has read only where it was chosen."""
        texts = [{what: text for what, text, _ in pin.outputs} for pin in (a, b)]
        meanings = {what: meaning for what, _, meaning in (*a.outputs, *b.outputs)}
        for what, meaning in meanings.items():
            one, other = (found.get(what, self.tr("not read")) for found in texts)
            if one != other:
                yield ComparedRow(what, one, other, meaning)

    def _pin_of(self, snapshot: Snapshot) -> Pin:
        frame = snapshot.frame
        return Pin(
            scene=frame.scene,
            tolerance=frame.plan.tolerance,
            force=snapshot.request.settings.force,
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
                self.tr("Contrast"),
                self.tr("{swing:.1f} grey levels").format(swing=float(np.ptp(frame.profile))),
                self.tr("Swing of the profile: its largest minus its smallest value."),
            ),
            (
                self.tr("Columns a chip"),
                self.tr("{columns:.2f} columns").format(columns=period / scene.camera.readout_time),
                self.tr("Switching period divided by readout time."),
            ),
            (
                self.tr("Exposure"),
                self.tr("{chips:.3f} chips").format(chips=scene.camera.exposure_time / period),
                self.tr("Exposure time divided by switching period."),
            ),
            (
                self.tr("Effects simulated"),
                ", ".join(shown.values()) or self.tr("none"),
                self.tr("The effects that the plan includes."),
            ),
            (
                self.tr("Simulation time"),
                self.tr("{time:.1f} ms").format(time=1e3 * snapshot.simulation_seconds),
                self.tr("Computing time of the picture."),
            ),
            *self._readings(snapshot),
        ]

    def _readings(self, snapshot: Snapshot) -> list[tuple[str, str, str]]:
        rows = []
        for result in (snapshot.decoded, *snapshot.others):
            name = self.tr("Decoder “{name}”").format(name=result.decoder)
            rows.append((name, self._reading(result, snapshot), self.tr("The code that it read.")))
            if result.decoder != snapshot.decoded.decoder:
                sure = result.confidence
                text = self.tr("none") if sure is None else f"{sure:.3f}"
                meaning = self.tr("Lead of the best code over the second best, 0 to 1.")
                rows.append((self.tr("Confidence, “{name}”").format(name=result.decoder), text,
                             meaning))  # fmt: skip
        return rows

    def _reading(self, result: DecodeResult, snapshot: Snapshot) -> str:
        if result.code is None:
            return result.failure or self.tr("no code read")
        right = tuple(result.bits.tolist()) == snapshot.sent
        verdict = self.tr("right") if right else self.tr("wrong")
        if result.payload:
            payload = one_line(result.payload, _LONGEST_PAYLOAD)
            return self.tr("“{payload}”, {verdict}").format(payload=payload, verdict=verdict)
        return self.tr("code {code}, {verdict}").format(code=result.code, verdict=verdict)
