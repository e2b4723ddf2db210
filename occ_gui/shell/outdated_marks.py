"""Outdated marks, shown on the results of an earlier scene."""

from typing import Any

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QWidget

from occ_gui.shell.feature import CodeVerdictView, Pane
from occ_gui.shell.results import MadeOf, ResultsStore, of_picture, of_reading, of_snapshot
from occ_gui.simulation.controller import SimulationController
from occ_gui.values.simulated import SimulationRequest
from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark
from occ_model.scene.parameters import quantity

VERDICT_DELAY = 0.06
"""Seconds before a verdict on an earlier scene is marked: about four frames of a screen."""


_DIGITS = 4  # significant digits of a slider's value

_NOT_REFUSED = object()


class OutdatedMarks(QObject):
    """Compares the scenes of all results with the present scene whenever either changes.

    A pane is marked once its result has been outdated for a moment. A verdict usually follows the
    scene within a few milliseconds. One that takes longer than ``VERDICT_DELAY`` is marked until
    there is a verdict on the present scene and the scene no longer changes, so that the mark does
    not flicker.

    The picture always lags behind a slider that runs by itself, so that picture and readings are
    not marked then; the verdicts say to which value of the slider they belong.
    """

    def __init__(
        self, results_store: ResultsStore, simulation: SimulationController, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._results_store, self._simulation = results_store, simulation
        self._ages = simulation.ages
        self._verdicts: list[CodeVerdictView] = []
        self._marks: list[tuple[OutdatedMark, MadeOf]] = []
        self._picture_when_refused: object = _NOT_REFUSED
        """The picture that stays while the present scene is refused; it may be None."""
        self._is_verdict_marked = False
        self._running_parameter = ""
        self._timer = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._update)
        results_store.changed.connect(self._update)
        simulation.submitted.connect(self._update)
        simulation.failed.connect(self._on_failure)

    @property
    def is_idle(self) -> bool:
        return not self._timer.isActive()

    def find_marks(self, *made_of: MadeOf) -> list[OutdatedMark]:
        return [mark for mark, function in self._marks if function in made_of or not made_of]

    def mark(self, widget: QWidget, made_of: MadeOf) -> None:
        self._marks.append((OutdatedMark(widget), made_of))
        self._update()

    def mark_pane(self, _name: str, pane: Pane[Any]) -> None:
        self._verdicts += pane.verdicts
        for widget, made_of in pane.made_of.items():
            self.mark(widget, made_of)
        self._update()

    def follow_run(self, parameter: str) -> None:
        self._running_parameter = parameter
        self._update()

    def _on_failure(self, _sentence: str) -> None:
        # The failure of an earlier request says nothing about the present one.
        if self._simulation.task.is_idle:
            self._picture_when_refused = self._results_store.results.picture
        self._update()

    def _update(self) -> None:
        results = self._results_store.results
        is_refused = self._picture_when_refused is results.picture
        text = "of an earlier scene: this one has no picture" if is_refused else "computing…"
        is_running = bool(self._running_parameter) and not is_refused
        for mark, made_of in self._marks:
            age = self._ages.age(made_of(results))
            mark.show_age(self._age_in_run(mark, made_of, age) if is_running else age, text)
        reading_request = of_reading(results)
        if reading_request is not None:
            values = ("", "")
            if is_running:
                values = self._run_values(reading_request, of_picture(results))
            for verdict in self._verdicts:
                verdict.show_run(*values)
            if is_running:
                self._is_verdict_marked = False
            self._mark_verdicts(0.0 if is_running else self._ages.age(reading_request))

    def _age_in_run(self, mark: OutdatedMark, made_of: MadeOf, age: float) -> float:
        """Return the age that decides about a mark while a slider runs.

        Picture and readings are not marked: the verdicts name their value. Any other mark, once
        shown, stays until the run ends, so that it does not flicker.
        """
        if made_of is not of_snapshot:
            return 0.0
        return age if mark.isHidden() else max(age, DELAY)

    def _run_values(
        self, reading_request: SimulationRequest, picture_request: SimulationRequest | None
    ) -> tuple[str, str]:
        declared = quantity(self._running_parameter)
        texts = [
            ""
            if request is None
            else declared.format(float(request.scene.value(self._running_parameter)), _DIGITS)
            for request in (reading_request, picture_request)
        ]
        return f"{declared.label} {texts[0]}", texts[1] if texts[1] != texts[0] else ""

    def _mark_verdicts(self, age: float) -> None:
        wait = self._ages.rest() if age == 0.0 else VERDICT_DELAY - age
        if wait <= 0.0:
            self._is_verdict_marked = age > 0.0
        for verdict in self._verdicts:
            verdict.show_outdated(self._is_verdict_marked)
        if wait > 0.0 and (age > 0.0) != self._is_verdict_marked:
            self._timer.start(int(1e3 * wait) + 1)
        else:
            self._timer.stop()
