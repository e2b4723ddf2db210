"""Work is there again at the next start: after an end, after a crash, and whatever was kept."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QEvent, QSettings, Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.files.autosave import Autosave
from occ_gui.files.preferences import Memory
from occ_gui.files.session import Session, recall_session
from occ_model.effects.registry import NAMES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

PROJECT = Path(__file__).resolve().parents[3]

LEFT = Qt.DockWidgetArea.LeftDockWidgetArea

Start = Callable[..., Any]


@pytest.fixture
def kept(tmp_path: Path) -> QSettings:
    return QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)


@pytest.fixture
def start(qtbot: QtBot, small_scene: Scene, tmp_path: Path, kept: QSettings) -> Start:
    """Start a window as the command line does, and end it after."""

    @contextmanager
    def begin(asked: Scene | None = None, fresh: bool = False) -> Iterator[Application]:
        session = Session() if fresh else recall_session(Memory(kept), NAMES)
        scene = asked or session.scene or small_scene
        application = Application(scene, session.settings or SimulationSettings(), kept)
        autosave = Autosave(tmp_path / "state")
        wins = asked is not None or fresh
        application.desktop.resume(autosave, session, wins, fresh)
        if session.photo is not None:
            application.open_photo(session.photo, front=False)
        application.window.show()
        qtbot.waitUntil(lambda: application.is_idle)
        try:
            yield application
        finally:
            application.window.close()
            application.stop()
            application.window.deleteLater()
            QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    return begin


def test_scene_settings_photo_and_options_are_there_again(
    start: Start, photo_file: Path, qtbot: QtBot
) -> None:
    with start() as application:
        application.store.change(iso=321.0)
        application.settings.set_tolerance(2.5)
        application.settings.force("vignetting", True)
        application.open_photo(photo_file)
        qtbot.waitUntil(lambda: application.is_idle)
        application.window.actions_by_name["hold_brightness"].trigger()
        application.desktop.theme.choose("dark")
        application.show_mode("blend")
        scene, settings = application.store.scene, application.settings.settings
    with start() as application:
        assert application.store.scene == scene
        assert not application.store.undo_stack.canUndo()
        assert application.settings.settings == settings
        assert application.image.mode.key() == "blend"
        assert not application.image.photo.isVisible()  # it lies on the picture
        assert application.desktop.brightness.is_on
        assert application.desktop.theme.theme == "dark"
        application.desktop.theme.choose("system")


def test_the_layout_is_there_again_and_can_be_reset(start: Start, qtbot: QtBot) -> None:
    with start() as application:
        window = application.window
        first = window.saveState()
        window.resize(1111, 777)
        window.docks["controls"].hide()
        window.addDockWidget(LEFT, window.docks["decode"])
        QApplication.processEvents()
    with start() as application:
        window = application.window
        assert window.docks["controls"].isHidden()
        assert window.dockWidgetArea(window.docks["decode"]) == LEFT
        assert abs(window.height() - 777) < 9
        window.actions_by_name["reset_layout"].trigger()
        QApplication.processEvents()
        assert not window.docks["controls"].isHidden()
        assert window.dockWidgetArea(window.docks["decode"]) != LEFT
        assert window.saveState().size() == first.size()
    with start(fresh=True) as application:
        assert not application.window.docks["controls"].isHidden()


def test_a_layout_of_other_panes_is_left_alone(start: Start, kept: QSettings) -> None:
    with start() as application:
        application.window.docks["controls"].hide()
        application.desktop.layout._version += 1
    with start() as application:
        assert not application.window.docks["controls"].isHidden()


@pytest.mark.parametrize("rubbish", ["", "rubbish", "\x00", "{}", "[1, 2]", "ä" * 5000])
def test_rubbish_in_what_was_kept_is_left_out(
    start: Start, kept: QSettings, small_scene: Scene, rubbish: str
) -> None:
    with start() as application:
        application.store.change(iso=321.0)
    for key in kept.allKeys():
        kept.setValue(key, rubbish)
    with start() as application:
        assert application.store.scene == small_scene
        assert application.settings.settings == SimulationSettings()
        assert application.desktop.theme.theme == "system"


@pytest.mark.parametrize(
    "text",
    [
        '{"tolerance": -1, "observable": "image", "force": {}, "noise": "exact", "seed": 1}',
        '{"tolerance": 1, "observable": "sound", "force": {}, "noise": "exact", "seed": 1}',
        '{"tolerance": 1, "observable": "image", "force": 3, "noise": "exact", "seed": 1}',
        '{"tolerance": 1, "observable": "image", "force": {}, "noise": "exact", "seed": -1}',
        '{"tolerance": 1, "observable": [], "force": {}, "noise": {}, "seed": 1}',
    ],
)
def test_settings_that_cannot_be_are_left_out(kept: QSettings, text: str) -> None:
    kept.setValue("session/settings", text)
    assert recall_session(Memory(kept), NAMES).settings is None


def test_a_settings_file_that_is_no_settings_file_is_left_out(
    tmp_path: Path, small_scene: Scene
) -> None:
    path = tmp_path / "settings.ini"
    path.write_bytes(os.urandom(4000))
    kept = QSettings(str(path), QSettings.Format.IniFormat)
    assert recall_session(Memory(kept), NAMES) == Session()


def test_a_scene_that_is_asked_for_wins(start: Start, small_scene: Scene) -> None:
    with start() as application:
        application.store.change(iso=321.0)
    asked = small_scene.replace(iso=99.0)
    with start(asked=asked) as application:
        assert application.store.scene == asked


def crash(folder: Path, scene: Scene) -> None:
    """Leave behind what a window leaves that does not come to its end."""
    folder.mkdir(exist_ok=True)
    (folder / "scene-1.toml").write_text(scene.to_toml(), encoding="utf-8")


def test_the_scene_of_a_crash_is_restored_as_a_step(
    start: Start, tmp_path: Path, small_scene: Scene
) -> None:
    lost = small_scene.replace(iso=777.0)
    crash(tmp_path / "state", lost)
    with start() as application:
        assert application.store.scene == lost
        assert "is restored" in application.window.statusBar().currentMessage()
        application.store.undo_stack.undo()
        assert application.store.scene == small_scene
    assert not (tmp_path / "state" / "scene-1.toml").exists()


@pytest.mark.parametrize("fresh", [False, True])
def test_the_scene_of_a_crash_is_one_undo_away_from_one_that_was_asked_for(
    start: Start, tmp_path: Path, small_scene: Scene, fresh: bool
) -> None:
    lost, asked = small_scene.replace(iso=777.0), small_scene.replace(iso=99.0)
    crash(tmp_path / "state", lost)
    with start(asked=asked, fresh=fresh) as application:
        assert application.store.scene == asked
        application.store.undo_stack.undo()
        assert application.store.scene == lost


def test_what_cannot_be_read_of_a_crash_is_kept_aside(start: Start, tmp_path: Path) -> None:
    (tmp_path / "state").mkdir()
    (tmp_path / "state" / "scene-1.toml").write_text("format = 99\n", encoding="utf-8")
    with start():
        pass
    assert (tmp_path / "state" / "scene-1.unreadable").read_text() == "format = 99\n"


RUN = """
import sys
from PySide6.QtCore import QTimer
import occ_gui.app.command_line as app

begin = app.start
def start(*arguments):
    qt, application = begin(*arguments)
    QTimer.singleShot(0, lambda: application.store.change(iso=float(sys.argv[1])))
    return qt, application
app.start = start
sys.exit(app.main(["--set", "rows=100"]))
"""

LOOK = """
import sys
from PySide6.QtCore import QTimer
import occ_gui.app.command_line as app

begin = app.start
def start(*arguments):
    qt, application = begin(*arguments)
    def look():
        print(application.store.scene.camera.iso, application.store.scene.camera.rows)
        print(application.window.statusBar().currentMessage(), flush=True)
        application.window.close()
    QTimer.singleShot(300, look)
    return qt, application
app.start = start
sys.exit(app.main([]))
"""


def test_the_work_of_a_killed_window_is_there_at_the_next_start(tmp_path: Path) -> None:
    environment = {
        **os.environ, "QT_QPA_PLATFORM": "offscreen", "OCC_STATE": str(tmp_path / "state"),
    }  # fmt: skip
    command = [sys.executable, "-c"]
    running = subprocess.Popen([*command, RUN, "777"], cwd=PROJECT, env=environment)
    kept = tmp_path / "state" / "scene-1.toml"
    deadline = time.monotonic() + 60
    while not kept.exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    running.send_signal(signal.SIGKILL)
    running.wait()
    assert occ.Scene.from_toml(kept.read_text(encoding="utf-8")).camera.iso == 777.0
    again = subprocess.run(
        [*command, LOOK],
        cwd=PROJECT, env=environment, capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert (again.returncode, again.stderr) == (0, "")
    assert again.stdout.splitlines()[0] == "777.0 100"
    assert "is restored" in again.stdout
    assert not kept.exists()
