"""The pane of the bars, which are computed on threads, in a quarter of a second for a scene."""

from PySide6.QtCore import QSize

from occ_gui.background.result_age import ResultAges
from occ_gui.background.task import Task
from occ_gui.bands.bands_view import BandsView
from occ_gui.bands.jobs import LampQuestion, SceneBars, answer_question, compute_bars
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.widgets.building import ScrollPane
from occ_model.results.bars_answer import BarsAnswer
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import as_bright

_LEAST = QSize(320, 200)


class BandsPane(Pane[Scene]):
    """Shows the bars of a scene; a speed that the user chooses becomes the scene's exposure."""

    def __init__(self, scenes: SceneStore) -> None:
        self.view = BandsView()
        super().__init__(ScrollPane(self.view, _LEAST))
        self._scenes = scenes
        self._ages, self._shown_scene = ResultAges(scenes.seen), scenes.seen
        self._task: Task[Scene, SceneBars] = Task(lambda scene, _: compute_bars(scene), "bars")
        self._answers: Task[LampQuestion, BarsAnswer] = Task(
            lambda question, _: answer_question(question), "answer of bars"
        )
        self.tasks = (self._task, self._answers)
        self._task.finished.connect(self._show)
        self._task.failed.connect(self._fail)
        self.view.exposure_chosen.connect(self._set_exposure)
        lamp = self.view.lamp
        self._answers.finished.connect(lamp.show_answer)
        self._answers.failed.connect(lamp.answer.show_answer)
        lamp.form.edited.connect(self._ask)
        lamp.form.scene_requested.connect(self._show_lamp)
        self._ask()

    def show_part(self, part: Scene) -> None:
        self._ages.begin(part)
        self._show_age("computing…")
        self._task.ask(part)

    def _ask(self) -> None:
        self._answers.ask(self.view.lamp.form.question)

    def _show_lamp(self) -> None:
        question = self.view.lamp.form.question
        scene = as_bright(self._scenes.seen, question.exposure_time)
        self._scenes.put(question.apply_to(scene), "lamp that makes bars")

    def _show(self, bars: SceneBars) -> None:
        self._shown_scene = bars.scene
        self.view.show_bands(bars)
        self._show_age("computing…")

    def _fail(self, sentence: str) -> None:
        self.view.show_failure(sentence)
        self._show_age("of an earlier scene")

    def _show_age(self, text: str) -> None:
        self.view.outdated.show_age(self._ages.age(self._shown_scene), text)

    def _set_exposure(self, exposure: float) -> None:
        scene = as_bright(self._scenes.seen, exposure)
        self._scenes.put(scene, "shutter speed without bars")
