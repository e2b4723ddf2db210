"""Outdated panes: each result that is not of the present scene is marked in its pane."""

from typing import Any, Protocol

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QWidget

from occ_gui.shell.feature import Pane
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Reading, SimulationRequest, Snapshot
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_model.scene.parameters import quantity

VERDICT_DELAY = 0.06
"""Seconds for which a verdict of an earlier scene is not marked, some four frames of a screen."""


_DIGITS = 4
"""Significant digits of a slider's value."""


class VerdictPane(Protocol):
    """A pane that says whether the code was read."""

    def show_outdated(self, outdated: bool) -> None:
        """Show whether the verdict is of an earlier scene."""

    def show_run(self, value: str, pictured: str) -> None:
        """Say of which values of a slider that runs verdict and picture are; empty for none."""


class OutdatedPanes(QObject):
    """Compares what the panes show with what the stores hold, at every change of either.

    A pane is marked when its result has been outdated for a moment. A verdict follows the scene
    within a few milliseconds where the profile path answers; one that is later than
    ``VERDICT_DELAY`` is shown as that of an earlier scene, until one of the present scene is there
    and the movement of the scene has ended: it would flicker otherwise.

    A slider that runs by itself is always ahead of the picture. Picture and readings are not
    marked then: the verdicts say of which of its values they are.

    Parameters
    ----------
    simulation
        Computes the results.
    parent
        The parent.
    """

    def __init__(self, simulation: SimulationController, parent: QObject) -> None:
        super().__init__(parent)
        self._simulation = simulation
        self._verdicts: list[VerdictPane] = []
        self._ages = simulation.ages
        self._pictured: SimulationRequest | None = None
        self._read: SimulationRequest | None = None
        self._decoded: SimulationRequest | None = None
        self._is_refused = self._is_verdict_marked = False
        self._run = ""
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

    def mark(self, pane: Pane[Any]) -> None:
        """Mark from now on the parts of a pane, each by what it follows from."""
        for widget in pane.of_pictures:
            self.mark_picture(widget)
        self.mark_readings(*pane.of_readings)
        self.of_results += [OutdatedMark(widget) for widget in pane.of_results]
        self._update()

    def follow_run(self, parameter: str) -> None:
        """Mark as it is right while the slider of this parameter runs; empty for none."""
        self._run = parameter
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
        text = "of an earlier scene: this one has no picture" if self._is_refused else "computing…"
        runs = bool(self._run) and not self._is_refused
        for request, marks in (
            (self._pictured, self.of_picture),
            (self._read, self.of_readings),
            (self._decoded, self.of_results),
        ):
            age = self._ages.age(request)
            for mark in marks:
                if runs:
                    age = self._age_in_run(mark, age)
                mark.show_age(age, text)
        if self._read is not None:
            for verdict in self._verdicts:
                verdict.show_run(*(self._run_values() if runs else ("", "")))
            if runs:
                self._is_verdict_marked = False
            self._mark_verdicts(0.0 if runs else self._ages.age(self._read))

    def _age_in_run(self, mark: OutdatedMark, age: float) -> float:
        """Return the age to mark by while a slider runs.

        The verdicts tell the value of picture and readings. Any other mark that has appeared stays
        to the end of the run: it would flicker otherwise.
        """
        if mark not in self.of_results:
            return 0.0
        return age if mark.isHidden() else max(age, DELAY)

    def _run_values(self) -> tuple[str, str]:
        """Write the values of the slider that runs, of the reading and of the picture."""
        declared = quantity(self._run)
        texts = [
            ""
            if request is None
            else declared.format(float(request.scene.value(self._run)), _DIGITS)
            for request in (self._read, self._pictured)
        ]
        return f"{declared.label} {texts[0]}", texts[1] if texts[1] != texts[0] else ""

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
