"""Answers to lessons while the window is open, and their check on a thread."""

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Task
from occ_model.results.match import Match
from occ_model.results.teaching import AnsweredStep, CheckedAnswer, Lesson
from occ_model.scene.scene import Scene
from occ_model.teaching.answers import check_answer


@dataclass(frozen=True, slots=True)
class _Question:
    lesson: Lesson
    place: int
    text: str
    asked: AnsweredStep  # with a provisional answer


class LessonAnswers(QObject):
    """Checks answers, which may take seconds, and keeps each with the scene it was given for."""

    checked = Signal(Lesson, int)
    """The lesson and the place of the step whose answer has been checked."""

    def __init__(self) -> None:
        super().__init__()
        self._records: dict[tuple[str, int], AnsweredStep] = {}
        self._queue: list[_Question] = []  # the one being checked, then those that wait
        self.task: Task[_Question, tuple[_Question, CheckedAnswer]] = Task(
            lambda question, _: _check(question), "lesson"
        )
        self.task.finished.connect(self._keep)
        self.task.failed.connect(self._keep_failure)
        self.task.idle.connect(self._check_next)

    def check(
        self, lesson: Lesson, place: int, text: str, scene: Scene, match: Match | None, photo: str
    ) -> None:
        """Check an answer given while a scene was shown, and the photo of this name was open."""
        step, pending = lesson.steps[place], CheckedAnswer(text, None, "The model computes…")
        asked = AnsweredStep(step, pending, step.scene_to_judge(scene))
        if step.own_photo:
            asked = replace(asked, match=match, photo=photo)
        self._records[lesson.name, place] = asked  # in place of an earlier one
        self._queue.append(_Question(lesson, place, text, asked))
        if self.task.is_idle:
            self._check_next()

    def is_checking(self, lesson: Lesson) -> bool:
        return any(question.lesson.name == lesson.name for question in self._queue)

    def find_answer(self, lesson: Lesson, place: int) -> CheckedAnswer | None:
        record = self._records.get((lesson.name, place))
        return None if record is None else record.answer

    def is_valid_for(self, lesson: Lesson, place: int, scene: Scene) -> bool:
        """Return whether an answer was checked for this scene, or depends on none."""
        record, step = self._records.get((lesson.name, place)), lesson.steps[place]
        if record is None or step.check is None or step.own_photo:
            return True
        return record.scene == step.scene_to_judge(scene)

    def list_steps(self, lesson: Lesson) -> tuple[AnsweredStep, ...]:
        return tuple(
            self._records.get((lesson.name, place), AnsweredStep(step, None, step.question_scene))
            for place, step in enumerate(lesson.steps)
        )

    def _check_next(self) -> None:
        if self._queue:
            self.task.ask(self._queue[0])

    def _keep_failure(self, sentence: str) -> None:
        question = self._queue[0]
        self._keep((question, CheckedAnswer(question.text.strip(), None, sentence)))

    def _keep(self, outcome: tuple[_Question, CheckedAnswer]) -> None:
        question, answer = outcome
        del self._queue[0]
        key = (question.lesson.name, question.place)
        if key not in {(later.lesson.name, later.place) for later in self._queue}:
            self._records[key] = replace(question.asked, answer=answer)
            self.checked.emit(question.lesson, question.place)


def _check(question: _Question) -> tuple[_Question, CheckedAnswer]:
    asked = question.asked
    return question, check_answer(asked.step, question.text, asked.match, asked.scene)
