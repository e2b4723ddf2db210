"""The answers given to lessons while the window is open, and their check on a thread."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from occ_gui.background.latest_wins import LatestWins
from occ_model.results.lessons import AnsweredStep, CheckedAnswer, Lesson
from occ_model.scene.scene import Scene
from occ_model.teaching.answers import check_answer


@dataclass(frozen=True, slots=True)
class _Asked:
    lesson: Lesson
    place: int
    text: str
    scene: Scene


class LessonAnswers(QObject):
    """Checks answers, which may take seconds, and keeps them with the scene they were given at."""

    checked = Signal(Lesson, int)
    """The lesson and the place of the step whose answer has been checked."""

    failed = Signal(str)
    """Why an answer cannot be checked."""

    def __init__(self) -> None:
        super().__init__()
        self._given: dict[tuple[str, int], tuple[CheckedAnswer, Scene]] = {}
        self.runner: LatestWins[_Asked, tuple[_Asked, CheckedAnswer]] = LatestWins(_check, "lesson")
        self.runner.finished.connect(self._keep)
        self.runner.failed.connect(self.failed)

    def check(self, lesson: Lesson, place: int, text: str, scene: Scene) -> None:
        """Check an answer to a step, given while ``scene`` was shown."""
        self.runner.submit(_Asked(lesson, place, text, scene))

    def of(self, lesson: Lesson, place: int) -> CheckedAnswer | None:
        """Return the answer to a step; None where there is none."""
        given = self._given.get((lesson.name, place))
        return None if given is None else given[0]

    def all_of(self, lesson: Lesson) -> tuple[AnsweredStep, ...]:
        """Return the steps of a lesson with their answers."""
        found = []
        for place, step in enumerate(lesson.steps):
            answer, scene = self._given.get((lesson.name, place), (None, step.scene))
            found.append(AnsweredStep(step, answer, scene))
        return tuple(found)

    def _keep(self, done: tuple[_Asked, CheckedAnswer]) -> None:
        asked, answer = done
        self._given[asked.lesson.name, asked.place] = (answer, asked.scene)
        self.checked.emit(asked.lesson, asked.place)


def _check(asked: _Asked) -> tuple[_Asked, CheckedAnswer]:
    return asked, check_answer(asked.lesson.steps[asked.place], asked.text)
