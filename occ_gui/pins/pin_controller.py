"""Controller of the pins: keeps two scenes, and returns to either."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Report, Task
from occ_gui.pins.comparison import Pin, PinnedPair, compare_pins, make_pin
from occ_gui.scene.scene_store import SceneStore, new_gesture
from occ_gui.simulation.jobs import explain_failures, snapshot_of
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.simulated import PinnedScene, Pins, SimulationRequest
from occ_model.errors import OccError
from occ_model.simulation.render import render_with

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
        self.task: Task[dict[str, SimulationRequest], None] = Task(
            _simulate_all, "comparison", impatient=True
        )
        self.task.reported.connect(self._take_snapshot)
        self.task.finished.connect(self._forget_missing)
        self.task.failed.connect(self._forget_missing)
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
        if self._missing and self._may_simulate and self.task.is_idle:
            self.task.ask(self._missing)

    def _take_snapshot(self, result: tuple[str, Snapshot]) -> None:
        name, snapshot = result
        if self._missing.get(name) == snapshot.request:
            self._pins[name] = make_pin(snapshot)
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
        self._pins[name] = make_pin(snapshot)
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
        self.pinned = compare_pins(a, b, self._scenes.settings.effect_labels)
        self.changed.emit()


def _simulate_all(pins: dict[str, SimulationRequest], report: Report) -> None:
    """Simulate the pictures of pins, except those of scenes that have none."""
    for name, pin in pins.items():
        with suppress(OccError):
            report((name, explain_failures(snapshot_of(pin, render_with(pin.scene, pin.settings)))))
