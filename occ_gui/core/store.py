"""Store: holds the workspace, notifies listeners of changes, and keeps the steps to undo."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from occ_gui.core.workspace import Step, Workspace
from occ_gui.values.room_choice import RoomChoice
from occ_model.errors import OccError, one_line
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS


@dataclass(frozen=True, slots=True)
class StepChange:
    """A step: its title, the scene's values that it changes, and the rest of the new state."""

    title: str
    values: Mapping[str, ParameterValue]
    force: Mapping[str, bool]
    room: RoomChoice = field(default_factory=RoomChoice)
    preset: str = ""

    @classmethod
    def between(cls, title: str, before: Step, after: Step) -> "StepChange":
        old, new = before.scene, after.scene
        values = {
            name: new.value(name) for name in PARAMETERS if new.value(name) != old.value(name)
        }
        return cls(title, values, after.force, after.room, after.preset)


@dataclass(frozen=True, slots=True)
class History:
    """The state before the first step, the steps, and how many of them are done."""

    first: Step
    steps: tuple[StepChange, ...] = ()
    done: int = 0

    def states(self) -> Iterator[Step]:
        """Return the state before each step and that after the last; raises as `Scene.replace`."""
        scene = self.first.scene
        yield self.first
        for step in self.steps:
            scene = scene.replace(**step.values)
            yield Step(scene, dict(step.force), step.room, step.preset)


T = TypeVar("T")

NO_GESTURE = -1  # the gesture of a change that is a step of its own
MOST_STEPS = 500  # steps that can be undone; each of them keeps two scenes in memory


class Selection(QObject, Generic[T]):
    """A part of the workspace, or of the results, which emits a signal when it changes."""

    changed = Signal(object)

    def __init__(self, of: Callable[[Any], T], whole: object) -> None:
        super().__init__()
        self.of, self.value = of, of(whole)


class Store(QObject):
    """Holds the workspace; announces changes one by one, to listeners in order of selection."""

    step_begun = Signal(object)
    """The workspace before a new step, an undo or a redo; emitted before the change is
    announced."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self._told = workspace
        self._left: Workspace | None = None
        self._is_telling = self._is_resuming = False
        self._selections: list[Selection[object]] = []
        self.undo_stack = QUndoStack(self, undoLimit=MOST_STEPS)
        # Announced when the stack has finished: a listener that edits in turn puts its step on top.
        self.undo_stack.indexChanged.connect(self._on_index)

    def select(self, of: Callable[[Workspace], T]) -> Selection[T]:
        selection = Selection(of, self.workspace)
        self._selections.append(selection)  # type: ignore[arg-type]  # it returns what it was given
        return selection

    def put(self, workspace: Workspace, title: str = "", gesture: int = NO_GESTURE) -> None:
        """Replace the workspace, as a step to undo; changes of one gesture are one step."""
        left, self.workspace = self.workspace, workspace
        if workspace.step != left.step:
            self._keep_step(left, title, gesture)
        if self._is_telling:  # it is announced when the last one has heard of the change before
            return
        self._is_telling = True
        try:
            while self._told is not self.workspace:
                self._told = self.workspace
                for selection in self._selections:
                    value = selection.of(self.workspace)  # the present one, not that of the change
                    if value != selection.value:
                        selection.value = value
                        selection.changed.emit(value)
        finally:
            self._is_telling = False

    def _keep_step(self, left: Workspace, title: str, gesture: int) -> None:
        before, after = left.step, self.workspace.step
        last = self._last_step()
        if last is None or gesture == NO_GESTURE or gesture != last.gesture:
            self.undo_stack.push(_Command(self, before, after, title, gesture))
            self.step_begun.emit(left)
            return
        # Not by QUndoCommand.mergeWith: PySide never frees a command that was merged.
        last.after = after
        if last.after == last.before:
            last.setObsolete(True)  # a gesture that ends where it began is no step
            self.undo_stack.undo()  # only removes the obsolete step

    def _last_step(self) -> "_Command | None":
        """Return the step that led to this workspace, None without one or after an undo."""
        index = self.undo_stack.index()
        if index != self.undo_stack.count():
            return None
        step = self.undo_stack.command(index - 1)
        return step if isinstance(step, _Command) else None

    def _on_index(self) -> None:
        left, self._left = self._left, None
        if left is not None:  # an undo or a redo, which the stack has finished
            self.step_begun.emit(left)
            self.put(self.workspace)

    def history(self, state: Step) -> History:
        """Return the steps; for an earlier state, only those that led to it."""
        stack, present = self.undo_stack, self.undo_stack.index()
        commands = (stack.command(place) for place in range(stack.count()))
        steps = [command for command in commands if isinstance(command, _Command)]
        first = steps[0].before if steps else self.workspace.step
        states = [first, *(step.after for step in steps)]
        done = next((place for place in range(present, -1, -1) if states[place] == state), None)
        if done is None:
            return History(state)
        kept = steps if done == present else steps[:done]
        return History(first, tuple(step.change for step in kept), done)

    def resume(self, history: History) -> None:
        """Restore the steps of an earlier window, if they lead to the present state."""
        try:
            states = [*history.states()]
        except OccError:
            return
        if states[history.done] != self.workspace.step:
            return
        self._is_resuming = True
        self.undo_stack.clear()
        for step, before, after in zip(history.steps, states, states[1:], strict=False):
            self.undo_stack.push(_Command(self, before, after, step.title, NO_GESTURE))
        self.undo_stack.setIndex(history.done)
        self._is_resuming = False

    def _lay_over(self, step: Step) -> None:
        if self._is_resuming:
            return
        if step != self.workspace.step:  # equal where a step that was made already is pushed
            self._left, self.workspace = self.workspace, step.laid_over(self.workspace)


class _Command(QUndoCommand):
    def __init__(self, store: Store, before: Step, after: Step, title: str, gesture: int) -> None:
        super().__init__(one_line(title).replace("&", "&&"))  # in a menu, & marks a shortcut
        self._store, self._title = store, title
        self.before, self.after = before, after
        self.gesture = gesture
        self._noted: tuple[Step, StepChange] | None = None

    @property
    def change(self) -> StepChange:
        """What the step changes, kept since a session is written each second of a drag."""
        if self._noted is None or self._noted[0] is not self.after:
            self._noted = self.after, StepChange.between(self._title, self.before, self.after)
        return self._noted[1]

    def redo(self) -> None:
        self._store._lay_over(self.after)

    def undo(self) -> None:
        self._store._lay_over(self.before)
