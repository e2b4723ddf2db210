"""Status messages: sentences in the status line for as long as they apply, and at fields."""

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.shell.results import (
    ResultsStore,
    Until,
    make_remark,
    next_change,
    next_photo,
    next_picture,
    next_sentence,
    status_message,
)
from occ_gui.values.remarks import Failure, Remark
from occ_gui.window.main_window import MainWindow
from occ_model.scene.parameters import PARAMETERS


class StatusMessages(QObject):
    """Shows the sentence that applies to workspace and results."""

    def __init__(
        self, window: MainWindow, controls: ControlPanel, store: Store, results_store: ResultsStore
    ) -> None:
        super().__init__(window)
        self._window, self._controls = window, controls
        self._store, self._results_store = store, results_store
        self._shown: tuple[Remark | None, str] = (None, "")
        self._failed_fields: tuple[str, ...] = ()  # those with the sentence of a failure
        store.select(lambda workspace: workspace).changed.connect(self._show)
        results_store.changed.connect(self._show)
        results_store.select(lambda results: results.failure).changed.connect(self._mark)

    def _show(self) -> None:
        results = self._results_store.results
        shown = (results.remark, status_message(self._store.workspace, results))
        if shown != self._shown:
            self._shown = shown
            self._window.show_message(shown[1])

    def _mark(self, failure: Failure | None) -> None:
        self._controls.end_refusals(self._failed_fields)
        self._failed_fields = () if failure is None else failure.parameters
        if failure is not None:
            self._controls.show_problem(failure.sentence, failure.parameters)

    def say(self, sentence: str, until: Until = next_sentence) -> None:
        results = self._results_store.results
        last = make_remark(sentence, until, self._store.workspace, results)
        self._results_store.put(replace(results, remark=last))

    def note(self, sentence: str) -> None:
        """Show a remark on the present scene, until the next change of scene or settings."""
        self.say(sentence, next_change)

    def say_failure(self, sentence: str, parameters: Sequence[str] = ()) -> None:
        """Show, until the next picture, why a scene has none, also at the fields concerned."""
        self.say(sentence, next_picture)
        failure = Failure(sentence, tuple(parameters))
        self._results_store.put(replace(self._results_store.results, failure=failure))

    def say_of_photo(self, sentence: str) -> None:
        """Show why a photo cannot be read, until another one is read."""
        self.say(sentence, next_photo)

    def accept(self) -> None:
        """Remove refusals, because an allowed value was entered."""
        last = self._results_store.results.remark
        if last is not None and last.until is next_change:
            self._results_store.put(replace(self._results_store.results, remark=None))
        self._controls.end_refusals(name for name in PARAMETERS if name not in self._failed_fields)
