"""The run of a slider is written as an animation, off the window's thread."""

from pathlib import Path

import pytest
from gui.user import User
from PIL import Image
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application


def test_the_run_of_a_slider_from_end_to_end_and_back_is_saved(
    application: Application, user: User, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("occ_gui.export.animation.STEPS", 2)
    chosen = (str(tmp_path / "run"), "Animated PNG (*.png)")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: chosen)
    application.shell.pane("animation").ask("iso")
    user.wait_until_idle()
    with Image.open(tmp_path / "run.png") as pictures:
        assert getattr(pictures, "n_frames", 1) == 4
        seen = []
        for place in range(4):
            pictures.seek(place)
            seen.append(pictures.convert("L").tobytes())
    assert len(set(seen)) == 3
    assert seen[1] == seen[3]  # on the way back
    assert user.message == "Saved run.png"


@pytest.mark.own_window
def test_an_animation_is_given_up_at_once_and_leaves_nothing(
    application: Application, user: User, qtbot: QtBot, tmp_path: Path
) -> None:
    animation = application.shell.pane("animation")
    animation.write(tmp_path / "a.gif", "iso")
    with qtbot.waitSignal(animation.writer.runner.reported):
        pass
    application.window.filming.cancelled.emit()
    assert animation.writer.is_idle
    assert user.message == "The animation was given up."
    animation.writer.stop()
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_cannot_be_written_is_told(application: Application, user: User) -> None:
    application.shell.pane("animation").write(Path("/none/a.gif"), "iso")
    user.wait_until_idle()
    assert "/none" in user.message
