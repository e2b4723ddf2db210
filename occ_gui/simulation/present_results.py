"""Results of the present scene, for files and the clipboard."""

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Snapshot

ResultsConsumer = Callable[[Snapshot], None]


class PresentResults(QObject):
    """Delivers the results of the present scene, as soon as the panes show them.

    Requests wait while a scene is computed, so that no results of an earlier one are delivered. If
    a scene has no picture, they are cancelled with a message.
    """

    status_message = Signal(str)  # says that a request waits, or why it was cancelled

    def __init__(self, simulation: SimulationController) -> None:
        super().__init__()
        self._ages = simulation.ages
        self._task = simulation.task
        self._waiting_consumers: list[ResultsConsumer] = []
        self._is_refused = False
        self.latest: Snapshot | None = None
        """The results shown by the panes, of the present scene or an earlier one."""
        simulation.submitted.connect(self._on_change)
        simulation.snapshot_shown.connect(self._on_snapshot)
        simulation.failed.connect(self._on_failure)

    def is_present(self, snapshot: Snapshot) -> bool:
        return snapshot.request == self._ages.present

    def ask(self, consumer: ResultsConsumer) -> None:
        self._waiting_consumers.append(consumer)
        if self._is_refused:
            self._cancel_requests()
        elif not self._deliver():
            self.status_message.emit("Waiting for the picture of this scene…")

    def _deliver(self) -> bool:
        """Deliver the latest results to all requests, if they are those of the present scene."""
        snapshot = self.latest
        if snapshot is None or not self.is_present(snapshot):
            return False
        consumers, self._waiting_consumers = self._waiting_consumers, []
        for consumer in consumers:
            consumer(snapshot)
        return True

    def _on_change(self) -> None:
        self._is_refused = False

    def _on_snapshot(self, snapshot: Snapshot) -> None:
        self.latest, self._is_refused = snapshot, False
        self._deliver()

    def _on_failure(self, _sentence: str) -> None:
        # A failure of an earlier request says nothing about the present one.
        self._is_refused = self._task.is_idle
        if self._is_refused and self._waiting_consumers:
            self._cancel_requests()

    def _cancel_requests(self) -> None:
        self._waiting_consumers.clear()
        self.status_message.emit("This scene has no picture: nothing has been written or copied.")
