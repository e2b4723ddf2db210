"""The session is restored at the next start: after a normal end, a crash or damage."""

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from gui.user import User
from PySide6.QtCore import QEvent, QSettings, Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from small_rooms import small_room

from occ_gui.app import command_line
from occ_gui.app.application import Application
from occ_gui.app.start import Start
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.files import session as session_module
from occ_gui.files.session import Session, SessionFile, restore_workspace
from occ_gui.files.session_record import SavedSession
from occ_gui.values.choices import RoomChoice
from occ_gui.values.modes import MODES
from occ_model.scene.scene import Scene, SimulationSettings

LEFT = Qt.DockWidgetArea.LeftDockWidgetArea

Starting = Callable[..., Any]


@pytest.fixture
def kept(tmp_path: Path) -> QSettings:
    return QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)


@pytest.fixture
def start(qtbot: QtBot, small_scene: Scene, tmp_path: Path, kept: QSettings) -> Starting:
    """Start a window as the command line does, and end it afterwards."""

    @contextmanager
    def begin(asked: Scene | None = None, fresh: bool = False) -> Iterator[Application]:
        file = SessionFile(tmp_path / "state")
        first, is_asked = Workspace(asked or small_scene), asked is not None
        if not fresh:
            first = restore_workspace(file, first, names_scene=is_asked, has_settings=False)
        begin = Start(first, is_asked, kept, file, fresh)
        application = Application(begin.first_workspace, kept)
        begin.restore(application, with_photo=True)
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


def test_a_room_outlives_a_kill_with_the_steps_of_its_camera(qapp: object, tmp_path: Path) -> None:
    first, file = Workspace(Scene(), frame_rate=24.0), SessionFile(tmp_path)
    store = Store(first)
    session = Session(store, lambda: store.workspace)
    session.begin(file, names_scene=False)
    seen = [store.workspace.room]
    for gesture, x in enumerate((0.1, 0.2, 0.3)):
        room = RoomChoice("my.toml", small_room().replace(x=x))
        for each in (replace(room, photo=tmp_path), room):  # one gesture, one step
            store.put(replace(store.workspace, room=each), "move", gesture)
        seen.append(room)
    scene = first.scene.replace(iso=321.0)
    store.put(replace(store.workspace, scene=scene), "iso")
    session.write()
    file.close()  # as when its process ends: nothing more is written

    again = SessionFile(tmp_path)
    begun = restore_workspace(again, Workspace(Scene()), names_scene=False, has_settings=False)
    assert begun == store.workspace
    later = Store(begun)
    Session(later, lambda: later.workspace).begin(again, names_scene=False)
    assert later.undo_stack.count() == 4
    later.undo_stack.undo()
    assert later.workspace == replace(store.workspace, scene=first.scene)
    found = []
    for _ in range(3):
        found.append(later.workspace.room)
        later.undo_stack.undo()
    assert [*found, later.workspace.room] == seen[::-1]
    later.undo_stack.redo()
    assert later.workspace.room == seen[1]
    again.close()


def test_scene_settings_photo_options_and_layouts_are_there_again_and_layouts_can_be_reset(
    start: Starting, photo_file: Path, qtbot: QtBot
) -> None:
    first_mode = next(iter(MODES))
    with start() as application:
        window = application.window
        first = window.saveState()
        window.resize(1111, 777)
        window.docks["controls"].hide()
        window.addDockWidget(LEFT, window.docks["decode"])
        QApplication.processEvents()
        application.scene_store.change(iso=321.0)
        application.settings.set_tolerance(2.5)
        application.scene_store.force("vignetting", True)
        window.actions_by_name["hold_brightness"].trigger()
        application.options.theme.choose("dark")
        application.options.choose_overlay("blend")
        application.view("picture").choose_picture("receiver")
        application.files.open_photo(photo_file)
        window.modes.switch("photo")
        qtbot.waitUntil(lambda: application.is_idle)
        window.docks["controls"].hide()
        window.modes.switch("limits")
        scene, settings = application.scene_store.scene, application.settings.settings
    with start() as application:
        assert application.scene_store.scene == scene
        assert not application.scene_store.undo_stack.canUndo()
        assert application.settings.settings == settings
        assert application.results_store.results.photo is not None
        picture = application.view("picture")
        assert picture.mode.key() == "blend"
        assert picture.switch.key() == picture.picture_kind == "receiver"
        assert application.options.brightness.is_on
        assert application.options.theme.theme == "dark"
        application.options.theme.choose("system")
        window, modes = application.window, application.window.modes
        assert modes.mode == "limits"
        assert window.toolbar.modes.currentIndex() == [*MODES].index("limits")
        for mode, panes in (
            ("limits", {*modes.panes.places_in("limits")}),
            ("photo", {"photo", "profile", "photos"}),
        ):
            modes.switch(mode)
            assert {name for name, dock in window.docks.items() if not dock.isHidden()} == panes
        modes.switch(first_mode)
        assert not picture.photo.isVisible()  # it lies on the picture
        assert window.docks["controls"].isHidden()
        assert window.dockWidgetArea(window.docks["decode"]) == LEFT
        assert abs(window.height() - 777) < 9
        window.actions_by_name["reset_layout"].trigger()
        QApplication.processEvents()
        assert not window.docks["controls"].isHidden()
        assert window.dockWidgetArea(window.docks["decode"]) != LEFT
        assert window.saveState().size() == first.size()
        window.docks["controls"].hide()
        modes.version += 1  # as if this window had other panes than the next
    with start() as application:
        assert not application.window.docks["controls"].isHidden()
        application.window.docks["controls"].hide()
    with start(fresh=True) as application:
        assert not application.window.docks["controls"].isHidden()


@pytest.mark.whole
def test_a_maximized_window_opens_maximized(start: Starting) -> None:
    for maximized in (True, False):
        with start() as application:
            window = application.window
            window.showMaximized() if maximized else window.showNormal()
        with start() as application:
            assert application.window.isMaximized() == maximized


def test_a_scene_that_is_asked_for_wins(tmp_path: Path, small_scene: Scene) -> None:
    file, asked = SessionFile(tmp_path), Workspace(small_scene.replace(iso=99.0))
    left = Workspace(small_scene.replace(iso=321.0), SimulationSettings(9.0, force={"jpeg": False}))
    file.write(SavedSession(left), in_use=False)
    file.close()
    again = SessionFile(tmp_path)
    begun = restore_workspace(again, asked, names_scene=True, has_settings=False)
    # Nothing is left out of it that was left out of another one.
    assert (begun.scene, begun.settings) == (asked.scene, asked.settings)
    as_left = restore_workspace(again, asked, names_scene=False, has_settings=False)
    assert (as_left.scene, as_left.settings) == (left.scene, left.settings)


@pytest.mark.parametrize(
    ("words", "asks"),
    [([], False), (["--tolerance", "1"], False), (["--preset", "phone-136us"], True),
     (["--set", "iso=200"], True)],
)  # fmt: skip
def test_only_a_command_line_that_names_a_scene_asks_for_one(
    words: list[str], asks: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OCC_STATE", str(tmp_path))
    begun = command_line.read_start(command_line.make_parser().parse_args(words))
    file = begun.session_file
    file.close()
    assert begun.names_scene is asks


def crash(folder: Path, scene: Scene) -> None:
    """Leave the files of a window that crashed."""
    file = SessionFile(folder)
    file.write(SavedSession(Workspace(scene, SimulationSettings(tolerance=7.0))), in_use=True)
    file.close()


def test_the_scene_of_a_crash_is_restored_as_a_step(
    start: Starting, tmp_path: Path, small_scene: Scene
) -> None:
    lost, later = small_scene.replace(iso=777.0), small_scene.replace(iso=99.0)
    other = SessionFile(tmp_path / "state")  # of a window that outlives the other one
    crash(tmp_path / "state", lost)
    other.write(SavedSession(Workspace(later)), in_use=False)
    other.close()
    with start() as application:
        assert application.scene_store.scene == lost
        assert application.settings.settings.tolerance == 7.0
        assert "is restored" in application.window.statusBar().currentMessage()
        application.scene_store.undo_stack.undo()
        assert application.scene_store.scene == later
    assert SessionFile(tmp_path / "state").crashed is None


@pytest.mark.parametrize("is_other", [False, True])
def test_undo_restores_the_crashs_scene_behind_another_that_is_requested(
    start: Starting, tmp_path: Path, small_scene: Scene, is_other: bool
) -> None:
    asked = small_scene.replace(iso=99.0)
    lost = small_scene.replace(iso=777.0) if is_other else asked
    crash(tmp_path / "state", lost)
    with start(asked=asked, fresh=True) as application:
        assert application.scene_store.scene == asked
        said = application.window.statusBar().currentMessage()
        assert ("brings its scene back" in said) == is_other
        assert "is restored" not in said
        application.scene_store.undo_stack.undo()
        assert application.scene_store.scene == lost


def test_the_session_written_last_is_restored_though_the_clock_was_put_back(
    tmp_path: Path, small_scene: Scene
) -> None:
    first, second = SessionFile(tmp_path), SessionFile(tmp_path)
    for file, iso in ((first, 99.0), (second, 101.0), (first, 103.0)):
        file.write(SavedSession(Workspace(small_scene.replace(iso=iso))), in_use=False)
    for file in (first, second):
        file.close()
    in_a_year = time.time() + 365 * 86400
    os.utime(tmp_path / "session-2.json", (in_a_year, in_a_year))
    for iso in (103.0, 104.0):
        file = SessionFile(tmp_path)
        assert file.last == SavedSession(Workspace(small_scene.replace(iso=iso)))
        file.write(SavedSession(Workspace(small_scene.replace(iso=iso + 1.0))), in_use=False)
        file.close()


def kill(
    qtbot: QtBot, application: Application, folder: Path, kept: QSettings
) -> Callable[[], None]:
    """Remember the files that a window has stored; return a function that restores them."""
    qtbot.waitUntil(lambda: application.is_idle and not application.session.is_due)
    files = {path: path.read_bytes() for path in folder.glob("*.json")}
    values = {key: kept.value(key) for key in kept.allKeys()}

    def put_back() -> None:
        for path, content in files.items():
            path.write_bytes(content)
        kept.clear()
        for key, value in values.items():
            kept.setValue(key, value)

    return put_back


def comparison(application: Application) -> list[list[str]]:
    """Read the table of differences between A and B, without computing times."""
    table = application.shell.pane("compare").view.table
    cells = [
        [item.text() if (item := table.item(row, column)) else "" for column in range(3)]
        for row in range(table.rowCount())
    ]
    return [row for row in cells if row[0] != "Simulation time"]


def undo_texts(application: Application) -> list[str]:
    stack = application.scene_store.undo_stack
    return [stack.text(place) for place in range(stack.count())]


def test_nothing_of_a_killed_window_is_lost(
    start: Starting, tmp_path: Path, kept: QSettings, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(session_module, "LONGEST_WAIT_MS", 20)
    with start() as application:
        user, stack = User(qtbot, application), application.scene_store.undo_stack
        application.presets.load("tablet-61us")
        user.change(rows=120, columns=600)
        user.choose("Pin as &A")
        user.enter("iso", "321")
        application.scene_store.force("jpeg", True)
        user.enter("distance", "0.9")
        stack.undo()
        kill(qtbot, application, tmp_path / "state", kept)
        user.choose("Pin as &B")
        qtbot.waitUntil(lambda: len(comparison(application)) > 4)
        scene, differences = application.scene_store.scene, comparison(application)
        steps = undo_texts(application), stack.index()
        put_back = kill(qtbot, application, tmp_path / "state", kept)
    put_back()
    with start() as application:
        assert "is restored" in application.window.statusBar().currentMessage()
        assert application.controls.preset.placeholderText() == "Tablet, 61 µs, changed"
        assert application.window.docks["compare"].isVisible()
        qtbot.waitUntil(lambda: comparison(application) == differences)
        stack = application.scene_store.undo_stack
        assert (undo_texts(application), stack.index()) == steps
        stack.redo()
        assert application.scene_store.scene == scene.replace(distance=0.9)
        for _ in range(3):
            stack.undo()
        assert application.scene_store.scene == scene.replace(iso=100.0)
        assert application.settings.settings.force == {}
        stack.undo()
        assert application.controls.preset.currentData() == "tablet-61us"
