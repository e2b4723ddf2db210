"""Outdated panes: each result that is not of the present scene is marked in its pane."""

from typing import Protocol

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QWidget

from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Reading, SimulationRequest, Snapshot
from occ_gui.widgets.outdated_mark import OutdatedMark

VERDICT_DELAY = 0.06
"""Seconds for which a verdict of an earlier scene is not marked, some four frames of a screen."""


class VerdictPane(Protocol):
    """A pane that says whether the code was read."""

    def show_outdated(self, outdated: bool) -> None:
        """Show whether the verdict is of an earlier scene."""


class OutdatedPanes(QObject):
    """Compares what the panes show with what the stores hold, at every change of either.

    A pane is marked when its result has been outdated for a moment. A verdict follows the scene
    within a few milliseconds where the profile path answers; one that is later than
    ``VERDICT_DELAY`` is shown as that of an earlier scene, until one of the present scene is there
    and the movement of the scene has ended: it would flicker otherwise.

    Parameters
    ----------
    simulation
        Computes the results.
    verdict
        The pane of the verdict.
    parent
        The parent.
    """

    def __init__(
        self, simulation: SimulationController, verdict: VerdictPane, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._simulation, self._verdicts = simulation, [verdict]
        self._ages = simulation.ages
        self._pictured: SimulationRequest | None = None
        self._read: SimulationRequest | None = None
        self._decoded: SimulationRequest | None = None
        self._is_refused = self._is_verdict_marked = False
        self.of_picture: list[OutdatedMark] = []
        self.of_readings: list[OutdatedMark] = []
        self.of_results: list[OutdatedMark] = []
        self._settling = QTimer(self, singleShot=True)
        self._settling.setTimerType(Qt.TimerType.PreciseTimer)
        self._settling.timeout.connect(self._update)
        simulation.submitted.connect(self._update)
        simulation.picture_ready.connect(self._on_picture)
        simulation.reading_shown.connect(self._on_reading)
        simulation.snapshot_shown.connect(self._on_snapshot)
        simulation.failed.connect(self._on_failure)

    @property
    def is_idle(self) -> bool:
        """Whether no verdict waits for the end of a movement."""
        return not self._settling.isActive()

    def mark_verdict(self, pane: VerdictPane) -> None:
        """Tell from now on another pane of the verdict whether it is of an earlier scene."""
        self._verdicts.append(pane)
        self._update()

    def mark_picture(self, pane: QWidget) -> None:
        """Mark from now on a pane of the picture, which is there before it is decoded."""
        self.of_picture.append(OutdatedMark(pane))
        self._update()

    def mark_readings(self, *panes: QWidget) -> None:
        """Mark from now on panes of readings, which need no picture where the profile does."""
        self.of_readings += [OutdatedMark(pane) for pane in panes]
        self._update()

    def mark_results(self, *panes: QWidget) -> None:
        """Mark from now on panes of what follows from the picture alone."""
        self.of_results += [OutdatedMark(pane) for pane in panes]
        self._update()

    def _on_picture(self, picture: Picture) -> None:
        self._pictured, self._is_refused = picture.request, False
        self._update()

    def _on_reading(self, reading: Reading) -> None:
        self._read = reading.request
        self._update()

    def _on_snapshot(self, snapshot: Snapshot) -> None:
        self._pictured = self._decoded = snapshot.request
        self._is_refused = False
        self._update()

    def _on_failure(self, _sentence: str) -> None:
        # One that is of an earlier request says nothing about the present one.
        self._is_refused = self._simulation.runner.is_idle
        self._update()

    def _update(self) -> None:
        text = (
            self.tr("of an earlier scene: this one has no picture")
            if self._is_refused
            else self.tr("computing…")
        )
        for request, marks in (
            (self._pictured, self.of_picture),
            (self._read, self.of_readings),
            (self._decoded, self.of_results),
        ):
            age = self._ages.age(request)
            for mark in marks:
                mark.show_age(age, text)
        if self._read is not None:
            self._mark_verdicts(self._ages.age(self._read))

    def _mark_verdicts(self, age: float) -> None:
        wait = self._ages.rest() if age == 0.0 else VERDICT_DELAY - age
        if wait <= 0.0:
            self._is_verdict_marked = age > 0.0
        for verdict in self._verdicts:
            verdict.show_outdated(self._is_verdict_marked)
        if wait > 0.0 and (age > 0.0) != self._is_verdict_marked:
            self._settling.start(int(1e3 * wait) + 1)
        else:
            self._settling.stop()
