"""The answers given to lessons while the window is open, and their check on a thread."""

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
class _Asked:
    lesson: Lesson
    place: int
    text: str
    scene: Scene
    photo: MatchedPhoto


class LessonAnswers(QObject):
    """Checks answers, which may take seconds, and keeps them with the scene they were given at."""

    checked = Signal(Lesson, int)
    """The lesson and the place of the step whose answer has been checked."""

    def __init__(self) -> None:
        super().__init__()
        self._given: dict[tuple[str, int], tuple[CheckedAnswer, Scene, MatchedPhoto]] = {}
        self._waiting: list[_Asked] = []  # the answer that is being checked, then those that wait
        self.runner: Task[_Asked, tuple[_Asked, CheckedAnswer]] = Task(
            lambda request, _: _check(request), "lesson"
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
        self._given[lesson.name, place] = (pending, scene, photo)  # the one before is outdated
        self._waiting.append(_Asked(lesson, place, text, scene, photo))
        if self.runner.is_idle:
            self._check_next()

    def is_checking(self, lesson: Lesson) -> bool:
        return any(asked.lesson.name == lesson.name for asked in self._waiting)

    def of(self, lesson: Lesson, place: int) -> CheckedAnswer | None:
        given = self._given.get((lesson.name, place))
        return None if given is None else given[0]

    def is_at(self, lesson: Lesson, place: int, scene: Scene) -> bool:
        """Return whether an answer holds beside a scene: it was checked there, or judges none."""
        given, step = self._given.get((lesson.name, place)), lesson.steps[place]
        if given is None or step.check is None or step.own_photo:
            return True
        return given[1] == step.scene_to_judge(scene)

    def all_of(self, lesson: Lesson) -> tuple[AnsweredStep, ...]:
        found = []
        for place, step in enumerate(lesson.steps):
            answer, scene, photo = self._given.get(
                (lesson.name, place), (None, step.asked, MatchedPhoto())
            )
            found.append(AnsweredStep(step, answer, scene, photo.match, photo.name))
        return tuple(found)

    def _check_next(self) -> None:
        if self._waiting:
            self.runner.ask(self._waiting[0])

    def _keep_failure(self, sentence: str) -> None:
        asked = self._waiting[0]
        self._keep((asked, CheckedAnswer(asked.text.strip(), None, sentence)))

    def _keep(self, done: tuple[_Asked, CheckedAnswer]) -> None:
        asked, answer = done
        del self._waiting[0]
        key = (asked.lesson.name, asked.place)
        if key not in {(later.lesson.name, later.place) for later in self._waiting}:
            self._given[key] = (answer, asked.scene, asked.photo)
            self.checked.emit(asked.lesson, asked.place)


def _check(asked: _Asked) -> tuple[_Asked, CheckedAnswer]:
    step = asked.lesson.steps[asked.place]
    return asked, check_answer(step, asked.text, asked.photo.match, asked.scene)
