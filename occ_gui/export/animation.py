"""Export of an animation in which a slider runs from end to end and back."""

from dataclasses import dataclass
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.file_writer import FileWriter
from occ_gui.background.task import Report
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Service
from occ_gui.widgets.work_bar import WorkBar
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, SimulationSettings

STEPS = 30
"""Steps of the slider from end to end; the animation has twice as many frames, there and back."""


@dataclass(frozen=True, slots=True)
class _Film:
    path: Path
    scene: Scene
    settings: SimulationSettings
    name: str
    values: tuple[float, ...]


class AnimationExport(Service):
    """Writes animations on a thread, with a progress bar that cancels it."""

    def __init__(
        self, window: QWidget | None, scenes: SceneStore, preferences: Preferences, bar: WorkBar
    ) -> None:
        super().__init__()
        self._window, self._scenes, self._preferences = window, scenes, preferences
        self.writer: FileWriter[_Film] = FileWriter(
            _write, "animation", bar, "The animation was cancelled."
        )
        self.tasks = (self.writer.task,)
        self.writer.written.connect(preferences.remember_export_folder)
        self.writer.status_message.connect(self.status_message)

    def ask(self, name: str) -> None:
        """Ask for a file, and write the animation of a slider to it."""
        kinds = ("GIF animation (*.gif)", "MP4 film (*.mp4)", "Animated PNG (*.png)")
        start = Path(self._preferences.export_folder, f"{name}.gif")
        chosen, kind = QFileDialog.getSaveFileName(
            self._window, "Save as animation", str(start), ";;".join(kinds)
        )
        if chosen:
            path = Path(chosen)
            ending = ".mp4" if kind == kinds[1] else ".png" if kind == kinds[2] else ".gif"
            self.write(path if path.suffix else path.with_suffix(ending), name)

    def write(self, path: Path, name: str) -> None:
        """Write an animation in which a slider moves from end to end and back."""
        parameter = PARAMETERS[name]
        if not isinstance(parameter, Quantity):
            return
        forward = [parameter.at(step / STEPS) for step in range(STEPS + 1)]
        values = (*forward, *forward[-2:0:-1])  # without the first value, with which it repeats
        settings = self._scenes.settings.settings
        self.writer.start(_Film(path, self._scenes.seen, settings, name, values))


def _write(film: _Film, report: Report) -> Path:
    # matplotlib takes half a second to import.
    from occ_model.figures.animation import write_animation

    write_animation(
        film.path, film.scene, film.name, film.values, settings=film.settings,
        progress=lambda done: report(done / len(film.values)),
    )  # fmt: skip
    return film.path
