"""The pane of three colours, simulated and read on a thread."""

from dataclasses import dataclass
from typing import TypeAlias

from occ_gui.background.task import Task, TaskReporter
from occ_gui.colour.colour_view import ColourView
from occ_gui.shell.feature import Pane
from occ_model.light.sent import period_columns
from occ_model.receiver.colour import decode_colours
from occ_model.results.colour import ColourFrame, ColourReading
from occ_model.scene.colour_scenes import is_colour, led_scene
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.colour import render_colour_with

ColourRequest: TypeAlias = tuple[Scene, SimulationSettings, str]
"""A scene, the settings of its simulation, and the decoder of its codes."""


@dataclass(frozen=True, eq=False, slots=True)
class ColourResult:
    frame: ColourFrame
    reading: ColourReading
    period_columns: float  # period of the light in columns


def compute_colours(request: ColourRequest, _report: TaskReporter | None = None) -> ColourResult:
    scene, settings, decoder = request
    frame = render_colour_with(scene, settings)
    reading = decode_colours(frame.image, scene, decoder)
    return ColourResult(frame, reading, period_columns(led_scene(scene, 0)))


class ColourPane(Pane[ColourRequest]):
    """Shows a colour camera's scene, or how to get one."""

    def __init__(self) -> None:
        self.view = ColourView()
        super().__init__(self.view)
        self._task: Task[ColourRequest, ColourResult] = Task(compute_colours, "colours")
        self.tasks = (self._task,)
        self.sentences = (self.view.sentence,)
        self._task.finished.connect(self._show)
        self._task.failed.connect(self.view.show_sentence)

    def show_part(self, part: ColourRequest) -> None:
        if is_colour(part[0]):
            self.view.show_outdated()
            self._task.ask(part)
            return
        self._task.cancel()
        self.view.show_sentence(
            "The camera of this scene is monochrome. Choose the preset of three codes in colour, "
            "or a Bayer pattern at the end of the page Model."
        )

    def _show(self, result: ColourResult) -> None:
        self.view.show_colours(result.frame, result.reading, result.period_columns)
