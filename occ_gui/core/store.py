"""Store: holds the workspace, notifies listeners of changes, and keeps the steps to undo."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from occ_gui.core.workspace import UndoState, Workspace
from occ_gui.values.choices import RoomChoice
from occ_model.errors import OccError, one_line
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS


@dataclass(frozen=True, slots=True)
class StepChange:
    """One step: its title, the scene values that it changes, and the rest of the new state."""

    title: str
    values: Mapping[str, ParameterValue]
    force: Mapping[str, bool]
    room: RoomChoice = field(default_factory=RoomChoice)
    preset: str = ""

    @classmethod
    def between(cls, title: str, before: UndoState, after: UndoState) -> "StepChange":
        old, new = before.scene, after.scene
        values = {
            name: new.value(name) for name in PARAMETERS if new.value(name) != old.value(name)
        }
        return cls(title, values, after.force, after.room, after.preset)


@dataclass(frozen=True, slots=True)
class History:
    """The state before the first step, the steps, and how many of them are done."""

    first: UndoState
    steps: tuple[StepChange, ...] = ()
    done: int = 0

    def states(self) -> Iterator[UndoState]:
        """Yield the state before each step and the state after the last one.

        Raises the errors of `Scene.replace`.
        """
        scene = self.first.scene
        yield self.first
        for step in self.steps:
            scene = scene.replace(**step.values)
            yield UndoState(scene, dict(step.force), step.room, step.preset)


T = TypeVar("T")

NO_GESTURE = -1  # gesture of a change that is a step of its own
MOST_STEPS = 500  # steps that can be undone; each of them keeps two scenes in memory


class Selection(QObject, Generic[T]):
    """A part of the workspace, or of the results, which emits a signal when it changes."""

    changed = Signal(object)

    def __init__(self, find: Callable[[Any], T], whole: object) -> None:
        super().__init__()
        self.find, self.value = find, find(whole)


class Store(QObject):
    """Holds the workspace; announces changes one by one, to listeners in order of selection."""

    step_begun = Signal(object)
    """The workspace before a new step, an undo or a redo; emitted before the change is
    announced."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self._announced = workspace
        self._before_undo: Workspace | None = None
        self._is_announcing = self._is_resuming = False
        self._selections: list[Selection[object]] = []
        self.undo_stack = QUndoStack(self, undoLimit=MOST_STEPS)
        # Announced when the stack has finished, so that a listener's own edit is pushed after it.
        self.undo_stack.indexChanged.connect(self._on_index_changed)

    def select(self, find: Callable[[Workspace], T]) -> Selection[T]:
        selection = Selection(find, self.workspace)
        self._selections.append(selection)  # type: ignore[arg-type]  # Selection is invariant
        return selection

    def put(self, workspace: Workspace, title: str = "", gesture: int = NO_GESTURE) -> None:
        """Replace the workspace, as a step to undo; changes of one gesture are one step."""
        previous, self.workspace = self.workspace, workspace
        if workspace.undo_state != previous.undo_state:
            self._keep_step(previous, title, gesture)
        if self._is_announcing:  # the loop that is running announces it next
            return
        self._is_announcing = True
        try:
            while self._announced is not self.workspace:
                self._announced = self.workspace
                for selection in self._selections:
                    value = selection.find(self.workspace)  # a listener may have changed it since
                    if value != selection.value:
                        selection.value = value
                        selection.changed.emit(value)
        finally:
            self._is_announcing = False

    def _keep_step(self, previous: Workspace, title: str, gesture: int) -> None:
        before, after = previous.undo_state, self.workspace.undo_state
        last = self._last_step()
        if last is None or gesture == NO_GESTURE or gesture != last.gesture:
            self.undo_stack.push(_Command(self, before, after, title, gesture))
            self.step_begun.emit(previous)
            return
        # Not by QUndoCommand.mergeWith: PySide never frees a command that was merged.
        last.after = after
        if last.after == last.before:
            last.setObsolete(True)  # a gesture that ends where it began is no step
            self.undo_stack.undo()  # only removes the obsolete step

    def _last_step(self) -> "_Command | None":
        """Return the step that led to this workspace; None if there is none, or after an undo."""
        index = self.undo_stack.index()
        if index != self.undo_stack.count():
            return None
        step = self.undo_stack.command(index - 1)
        return step if isinstance(step, _Command) else None

    def _on_index_changed(self) -> None:
        previous, self._before_undo = self._before_undo, None
        if previous is not None:  # the stack has finished an undo or a redo
            self.step_begun.emit(previous)
            self.put(self.workspace)

    def history(self, state: UndoState) -> History:
        """Return the steps; for an earlier state, only the steps that led to it."""
        stack, present = self.undo_stack, self.undo_stack.index()
        commands = (stack.command(place) for place in range(stack.count()))
        steps = [command for command in commands if isinstance(command, _Command)]
        first = steps[0].before if steps else self.workspace.undo_state
        states = [first, *(step.after for step in steps)]
        done = next((place for place in range(present, -1, -1) if states[place] == state), None)
        if done is None:
            return History(state)
        steps = steps if done == present else steps[:done]
        return History(first, tuple(step.change for step in steps), done)

    def resume(self, history: History) -> None:
        """Restore the steps of an earlier window, if they lead to the present state."""
        try:
            states = [*history.states()]
        except OccError:
            return
        if states[history.done] != self.workspace.undo_state:
            return
        self._is_resuming = True
        self.undo_stack.clear()
        for step, before, after in zip(history.steps, states, states[1:], strict=False):
            self.undo_stack.push(_Command(self, before, after, step.title, NO_GESTURE))
        self.undo_stack.setIndex(history.done)
        self._is_resuming = False

    def _put_into_workspace(self, state: UndoState) -> None:
        if self._is_resuming:
            return
        if state != self.workspace.undo_state:  # QUndoStack calls redo on a step that is just made
            self._before_undo, self.workspace = self.workspace, state.put_into(self.workspace)


class _Command(QUndoCommand):
    def __init__(
        self, store: Store, before: UndoState, after: UndoState, title: str, gesture: int
    ) -> None:
        super().__init__(one_line(title).replace("&", "&&"))  # in a menu, & marks a shortcut
        self._store, self._title = store, title
        self.before, self.after = before, after
        self.gesture = gesture
        self._cached_change: tuple[UndoState, StepChange] | None = None

    @property
    def change(self) -> StepChange:
        """What the step changes; cached, because a drag saves the session every second."""
        if self._cached_change is None or self._cached_change[0] is not self.after:
            self._cached_change = (
                self.after,
                StepChange.between(self._title, self.before, self.after),
            )
        return self._cached_change[1]

    def redo(self) -> None:
        self._store._put_into_workspace(self.after)

    def undo(self) -> None:
        self._store._put_into_workspace(self.before)
