"""Lesson controller: each step sets its scene, opens its photo and shows its pane."""

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.files.file_controller import sample_photos
from occ_gui.lessons.answers import LessonAnswers
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.photo.shown_photo import find_match
from occ_gui.scene.scene_store import new_gesture
from occ_gui.shell.results import ResultsStore
from occ_gui.values.choices import PhotoChoice
from occ_gui.widgets.columns import PACKETS_IN_VIEW
from occ_gui.widgets.plain_text import LONGEST_TEXT
from occ_model.errors import OccError, one_line
from occ_model.light.sent import light_period
from occ_model.results.match import known_parameter
from occ_model.results.teaching import Lesson, LessonStep, LoadedLessons
from occ_model.teaching.answers import describe_changes, explanation
from occ_model.teaching.lessons import lessons
from occ_model.teaching.light_over_columns import rolling_shutter


class LessonController(QObject):
    """Goes from step to step, and remembers the steps reached while the window is open.

    A step sets scene, simulation, decoder and picture as in a new window; the end of the lesson
    restores the user's own.
    """

    status_message = Signal(str)  # the reason why a step is incomplete
    pane_requested = Signal(str)  # the name of the pane that a step refers to; empty for none
    control_requested = Signal(str)  # the parameter that a step is about, by name; empty for none

    columns_held = Signal(object)
    """Number of columns that a step keeps in view, so that changes are visible; None: usual."""

    equation_requested = Signal(str)  # the equation that explains a step, by name; empty for none
    action_requested = Signal(str)  # the name of the action that the button of a step starts

    report_asked = Signal(Lesson)

    def __init__(
        self, store: Store, results_store: ResultsStore, view: LessonView, answers: LessonAnswers
    ) -> None:
        super().__init__()
        self._store, self._results_store = store, results_store
        self._view, self._answers = view, answers
        self._loaded = LoadedLessons(())
        self.current: Lesson | None = None
        self._places: dict[str, int] = {}
        """The step reached in each lesson, by its name; after its end, the number of its steps."""
        self._workspace_before: Workspace | None = None
        self._has_set_room = False
        self._first_photo: Path | None = None
        """The photo that was open before the lesson; steps without a photo hide it."""
        self._ended_lesson: Lesson | None = None
        answers.checked.connect(self._show_answer)
        store.select(lambda workspace: workspace.scene).changed.connect(self._follow_scene)
        view.list.chosen.connect(self.choose)
        for page in (view.step, view.end):
            page.list_asked.connect(self.leave)
        view.step.moved.connect(self.go)
        view.step.again_asked.connect(self.reset_step)
        view.step.control_asked.connect(self._request_control)
        view.step.answer_given.connect(self._check)
        view.step.action_asked.connect(self._ask_action)
        view.end.report_asked.connect(self._ask_report)
        view.end.next_asked.connect(self._go_to_next)

    def set_visible(self, visible: bool) -> None:
        """Read the lessons when their pane is shown, unless a lesson is under way."""
        if visible and self.current is None and self._ended_lesson is None:
            failure = ""
            try:
                self._loaded = lessons()
            except OccError as error:
                failure = one_line(str(error), LONGEST_TEXT)
            except Exception as error:  # noqa: BLE001 - the window works whatever they contain
                reason = one_line(f"{type(error).__name__}: {error}")
                failure = f"The lessons cannot be read: {reason}."
            self._list_lessons(failure)

    def _list_lessons(self, failure: str = "") -> None:
        self._view.list.show_lessons(self._loaded, self._places, failure)
        self._view.setCurrentWidget(self._view.list)

    def begin_first(self) -> None:
        self.set_visible(True)
        if self._loaded.lessons:
            self.choose(self._loaded.lessons[0].name)

    def choose(self, name: str) -> None:
        for lesson in self._loaded.lessons:
            if lesson.name == name:
                if self._workspace_before is None:
                    self._workspace_before = self._store.workspace
                    self._first_photo = self._workspace_before.photo.path
                self.current, self._ended_lesson = lesson, None
                place = self._places.get(name, 0)
                self._go_to(place if place < len(lesson.steps) else 0)

    def go(self, steps: int) -> None:
        """Go forward or back by some steps; end the lesson after its last step."""
        if self.current is None:
            return
        name, count = self.current.name, len(self.current.steps)
        place = self._places[name] + steps
        if place < count:
            self._go_to(max(place, 0))
            return
        self._places[name] = count
        self._ended_lesson, self.current = self.current, None
        self.control_requested.emit("")
        self.restore_user()
        self._show_end(self._ended_lesson)

    def _show_end(self, lesson: Lesson) -> None:
        answers = [step.answer for step in self._answers.list_steps(lesson)]
        next_lesson = self._find_next()
        end = self._view.end
        end.show_answers(lesson, answers, "" if next_lesson is None else next_lesson.title)
        end.report.setEnabled(not self._answers.is_checking(lesson))
        self._view.setCurrentWidget(end)

    def _find_next(self) -> Lesson | None:
        """Return the next lesson in the list; None after the last, or if its file is gone."""
        if self._ended_lesson is not None and self._ended_lesson in self._loaded.lessons:
            later = self._loaded.lessons[self._loaded.lessons.index(self._ended_lesson) + 1 :]
            return next(iter(later), None)
        return None

    def _go_to_next(self) -> None:
        next_lesson = self._find_next()
        if next_lesson is not None:
            self.choose(next_lesson.name)

    def leave(self) -> None:
        """End the lesson and return to the list; the step reached is kept."""
        self.current = self._ended_lesson = None
        self.control_requested.emit("")
        self.restore_user()
        self._list_lessons()

    def user_workspace(self) -> Workspace | None:
        """Return what the end of the lesson restores; None if none is under way."""
        user, present = self._workspace_before, self._store.workspace
        if user is None:
            return None
        # A photo opened or matched during the lesson stays, and so does all that no step sets.
        photo = present.photo if is_own(present.photo) else user.photo
        return replace(
            present, scene=user.scene, settings=user.settings, preset=user.preset, photo=photo,
            decoder=user.decoder, picture_kind=user.picture_kind, is_enhanced=user.is_enhanced,
            overlay=user.overlay, frame_rate=user.frame_rate,
            room=user.room if self._has_set_room else present.room,
        )  # fmt: skip

    def restore_user(self) -> None:
        """Restore the user's own work, with one step of undo for the scene."""
        user, self._workspace_before, self._has_set_room = self.user_workspace(), None, False
        self.columns_held.emit(None)
        if user is not None:
            self._store.put(user, "end of the lesson", new_gesture())
            self.pane_requested.emit("")

    def reset_step(self) -> None:
        if self.current is not None:
            self._set_step(self.current, self._places[self.current.name])

    def _go_to(self, place: int) -> None:
        lesson = self.current
        if lesson is None:
            return
        self._places[lesson.name] = place
        step = lesson.steps[place]
        self._view.step.show_step(lesson, place, self._answers.find_answer(lesson, place))
        self._view.setCurrentWidget(self._view.step)
        self.equation_requested.emit(step.equation)
        self._set_step(lesson, place)
        self.control_requested.emit(step.control)
        self._follow_scene()

    def _set_step(self, lesson: Lesson, place: int) -> None:
        step, user = lesson.steps[place], self.user_workspace()
        if user is None:
            return
        self._workspace_before = user
        title = f"step {place + 1} of “{lesson.title}”"
        photo = self._choose_photo(step, user.photo)
        self._has_set_room |= step.pane == "room"
        first = Workspace(step.scene)
        workspace = replace(
            user, scene=first.scene, settings=first.settings, preset=first.preset, photo=photo,
            decoder=step.decoder or first.decoder, picture_kind=first.picture_kind,
            is_enhanced=first.is_enhanced, overlay=first.overlay, frame_rate=first.frame_rate,
            room=first.room if step.pane == "room" else user.room,
        )  # fmt: skip
        self._store.put(workspace, title, new_gesture())
        period = float(light_period(step.scene.transmitter)) / step.scene.camera.readout_time
        self.columns_held.emit(PACKETS_IN_VIEW * period)
        if step.photo and photo.path is None:
            self.status_message.emit(f"The photo {step.photo} is missing.")
        self.pane_requested.emit(step.pane)

    def _choose_photo(self, step: LessonStep, user_photo: PhotoChoice) -> PhotoChoice:
        """Return the photo of a step: the sample that it names, the user's own, or none."""
        present = self._store.workspace.photo
        samples = {path.stem: path for path in sample_photos()}
        if step.own_photo and is_own(user_photo):
            return user_photo  # in place of the sample
        if not step.photo:
            is_new = is_own(present) and present.path != self._first_photo
            return present if is_new else replace(user_photo, path=None)
        path = samples.get(step.photo)
        if path is None:
            return replace(user_photo, path=None)
        sample = present if present.path == path else user_photo.open(path)
        known = known_parameter("readout_time", step.scene.transmitter)
        return sample.with_known(known, float(step.scene.value(known)))

    def _current_step(self) -> LessonStep | None:
        lesson = self.current
        return None if lesson is None else lesson.steps[self._places[lesson.name]]

    def _request_control(self) -> None:
        step = self._current_step()
        self.control_requested.emit("" if step is None else step.control)

    def _follow_scene(self) -> None:
        step = self._current_step()
        if step is None:
            return
        scene = self._store.workspace.scene
        self._view.step.show_changes(describe_changes(step, scene))
        self._view.step.show_explanation(explanation(step, scene))
        self._mark_answer()
        if step.animation:
            self._view.step.animation.show_shutter(rolling_shutter(scene))

    def _mark_answer(self) -> None:
        lesson = self.current
        if lesson is not None:
            place = self._places[lesson.name]
            self._view.step.answer_field.show_outdated(
                not self._answers.is_valid_for(lesson, place, self._store.workspace.scene)
            )

    def _check(self, text: str) -> None:
        lesson = self.current
        if lesson is not None:
            self._view.step.answer_field.show_waiting()
            results = self._results_store.results
            name = "" if results.photo is None else one_line(results.photo.path.name)
            outcome = find_match(results)
            match = None if outcome is None else outcome.match
            scene = self._store.workspace.scene
            self._answers.check(lesson, self._places[lesson.name], text, scene, match, name)

    def _show_answer(self, lesson: Lesson, place: int) -> None:
        answer = self._answers.find_answer(lesson, place)
        if lesson is self.current and place == self._places[lesson.name] and answer is not None:
            self._view.step.answer_field.show_outcome(answer)
            self._mark_answer()
        if lesson is self._ended_lesson:  # its end was shown before this answer was checked
            self._show_end(lesson)

    def _ask_action(self) -> None:
        step = self._current_step()
        if step is not None:
            self.action_requested.emit(step.action)

    def _ask_report(self) -> None:
        if self._ended_lesson is not None:
            self.report_asked.emit(self._ended_lesson)


def is_own(photo: PhotoChoice) -> bool:
    return photo.path not in {None, *sample_photos()}
