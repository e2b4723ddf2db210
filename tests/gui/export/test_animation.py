"""The run of a slider is written as an animation, outside the window's thread."""

from pathlib import Path

import pytest
from gui.pane_bench import PaneBench
from PIL import Image
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.app.services import animation
from occ_gui.export.animation import AnimationExport
from occ_gui.files.preferences import Preferences
from occ_gui.widgets.work_bar import WorkBar
from occ_model.scene.scene import Scene


class Bench(PaneBench):
    """The export of animations with its progress bar."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.bar = WorkBar("Animation")
        self.bar.setParent(self.window)
        feature = animation(self.window, self.scenes, Preferences(None), self.bar)
        self.animation: AnimationExport = self.add(feature)


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Bench:
    return Bench(qtbot, small_scene)


def test_the_run_of_a_slider_from_end_to_end_and_back_is_saved(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("occ_gui.export.animation.STEPS", 2)
    chosen = (str(tmp_path / "run"), "Animated PNG (*.png)")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: chosen)
    bench.animation.ask("iso")
    bench.wait_until_idle()
    with Image.open(tmp_path / "run.png") as pictures:
        assert getattr(pictures, "n_frames", 1) == 4
        seen = []
        for place in range(4):
            pictures.seek(place)
            seen.append(pictures.convert("L").tobytes())
    assert len(set(seen)) == 3
    assert seen[1] == seen[3]  # on the way back
    assert bench.said[-1] == "Saved run.png"


def test_a_cancelled_animation_ends_at_once_and_leaves_no_file(
    bench: Bench, qtbot: QtBot, tmp_path: Path
) -> None:
    animation = bench.animation
    animation.write(tmp_path / "a.gif", "iso")
    with qtbot.waitSignal(animation.writer.task.reported):
        pass
    bench.bar.cancelled.emit()
    assert animation.is_idle
    assert bench.said[-1] == "The animation was cancelled."
    animation.stop()
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_cannot_be_written_is_reported(bench: Bench) -> None:
    bench.animation.write(Path("/none/a.gif"), "iso")
    bench.wait_until_idle()
    assert "/none" in bench.said[-1]
