"""Answers to lessons while the window is open, and their check on a thread."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Task
from occ_model.results.match import Match
from occ_model.results.teaching import AnsweredStep, CheckedAnswer, Lesson
from occ_model.scene.scene import Scene
from occ_model.teaching.answers import check_answer


@dataclass(frozen=True, slots=True)
class MatchedPhoto:
    name: str = ""
    match: Match | None = None


@dataclass(frozen=True, slots=True)
class _Question:
    lesson: Lesson
    place: int
    text: str
    scene: Scene
    photo: MatchedPhoto


class LessonAnswers(QObject):
    """Checks answers, which may take seconds, and keeps each with the scene it was given for."""

    checked = Signal(Lesson, int)
    """The lesson and the place of the step whose answer has been checked."""

    def __init__(self) -> None:
        super().__init__()
        self._records: dict[tuple[str, int], tuple[CheckedAnswer, Scene, MatchedPhoto]] = {}
        self._queue: list[_Question] = []  # the one being checked, then those that wait
        self.runner: Task[_Question, tuple[_Question, CheckedAnswer]] = Task(
            lambda question, _: _check(question), "lesson"
        )
        self.runner.finished.connect(self._keep)
        self.runner.failed.connect(self._keep_failure)
        self.runner.idle.connect(self._check_next)

    def check(
        self, lesson: Lesson, place: int, text: str, scene: Scene, photo: MatchedPhoto
    ) -> None:
        """Check an answer to a step, given while ``scene`` was shown and ``photo`` open."""
        if not lesson.steps[place].own_photo:
            photo = MatchedPhoto()
        scene = lesson.steps[place].scene_to_judge(scene)
        pending = CheckedAnswer(text, None, "The model computes…")
        self._records[lesson.name, place] = (pending, scene, photo)  # in place of an earlier one
        self._queue.append(_Question(lesson, place, text, scene, photo))
        if self.runner.is_idle:
            self._check_next()

    def is_checking(self, lesson: Lesson) -> bool:
        return any(question.lesson.name == lesson.name for question in self._queue)

    def find_answer(self, lesson: Lesson, place: int) -> CheckedAnswer | None:
        record = self._records.get((lesson.name, place))
        return None if record is None else record[0]

    def is_valid_for(self, lesson: Lesson, place: int, scene: Scene) -> bool:
        """Return whether an answer was checked for this scene, or depends on none."""
        record, step = self._records.get((lesson.name, place)), lesson.steps[place]
        if record is None or step.check is None or step.own_photo:
            return True
        return record[1] == step.scene_to_judge(scene)

    def list_steps(self, lesson: Lesson) -> tuple[AnsweredStep, ...]:
        steps = []
        for place, step in enumerate(lesson.steps):
            unanswered = None, step.question_scene, MatchedPhoto()
            answer, scene, photo = self._records.get((lesson.name, place), unanswered)
            steps.append(AnsweredStep(step, answer, scene, photo.match, photo.name))
        return tuple(steps)

    def _check_next(self) -> None:
        if self._queue:
            self.runner.ask(self._queue[0])

    def _keep_failure(self, sentence: str) -> None:
        question = self._queue[0]
        self._keep((question, CheckedAnswer(question.text.strip(), None, sentence)))

    def _keep(self, outcome: tuple[_Question, CheckedAnswer]) -> None:
        question, answer = outcome
        del self._queue[0]
        key = (question.lesson.name, question.place)
        if key not in {(later.lesson.name, later.place) for later in self._queue}:
            self._records[key] = (answer, question.scene, question.photo)
            self.checked.emit(question.lesson, question.place)


def _check(question: _Question) -> tuple[_Question, CheckedAnswer]:
    step = question.lesson.steps[question.place]
    return question, check_answer(step, question.text, question.photo.match, question.scene)
