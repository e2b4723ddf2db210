"""The mode Video: a film is opened, read, played and closed; a camera is read and released."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from gui.user import User
from gui.video.conftest import ListedSource
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.files.session import Session, SessionFile
from occ_gui.video.frame_source import FilmSource
from occ_gui.video.marks import MarkState
from occ_gui.video.wiring import VideoWiring
from occ_model.results.video import Video
from occ_model.scene.scene import Scene


@pytest.fixture
def small_scene(film_scene: Scene) -> Scene:
    """Give the application the scene of the films."""
    return film_scene


@pytest.fixture
def pane(application: Application, user: User) -> Iterator[VideoWiring]:
    """Show the mode with a simulated film of six frames."""
    application.window.modes.switch("video")
    user.wait_until_idle()
    wiring = application.video.wiring
    wiring.view.form.count.setValue(6)
    user.wait_until_idle()
    yield wiring
    wiring.live.stop_filming()


def states(pane: VideoWiring) -> list[int]:
    return pane.view.timeline.frames.states.tolist()


def test_nothing_of_films_is_loaded_before_the_mode_is_shown(application: Application) -> None:
    assert "wiring" not in vars(application.video)
    assert application.video.is_idle


def test_the_simulated_film_is_shown_at_once_and_read_when_asked(
    pane: VideoWiring, user: User
) -> None:
    assert pane.view.pictures.shown == (False, True)
    assert states(pane) == [MarkState.PENDING] * 6
    pane.view.bar.read.click()
    assert pane.view.bar.read.text() == "Stop reading"
    user.wait_until_idle()
    assert MarkState.PENDING not in states(pane)
    assert "718" in pane.view.data.text.toPlainText()


def test_a_film_is_opened_read_and_seen_beside_the_simulation(
    application: Application, user: User, film_file: Path
) -> None:
    application.files.open_file(film_file)
    user.wait_until_idle()
    pane = application.video.wiring
    user.wait_until_idle()
    assert application.window.modes.mode == "video"
    assert pane.view.pictures.shown == (True, True)
    assert pane.view.bar.title.toolTip() == "stripes.avi, 1600 x 60, 6 frames, 30 a second"
    assert len(states(pane)) == 6
    assert MarkState.PENDING not in states(pane)
    assert film_file in application.preferences.files
    assert pane.view.form.recording.frame_rate == 30.0


def test_a_film_that_is_dropped_is_opened(
    application: Application, user: User, film_file: Path
) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(film_file))])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    event = QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, buttons, keys)
    application.window.dropEvent(event)
    user.wait_until_idle()
    assert application.video.path == film_file


def test_the_menu_opens_and_closes_a_film(
    application: Application, user: User, film_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(film_file), ""))
    close = application.window.actions_by_name["close_film"]
    assert not close.isEnabled()
    user.choose("Open &film")
    user.wait_until_idle()
    assert close.isEnabled()
    user.choose("C&lose film")
    assert not close.isEnabled()
    assert application.video.path is None
    assert application.video.wiring.view.pictures.shown == (False, True)


def test_what_is_no_film_is_a_sentence_and_the_film_stays(
    pane: VideoWiring, application: Application, user: User, film_file: Path, tmp_path: Path
) -> None:
    application.video.open(film_file)
    user.wait_until_idle()
    damaged = tmp_path / "damaged.mp4"
    damaged.write_bytes(b"no film")
    application.files.open_film(damaged)
    user.wait_until_idle()
    assert "damaged.mp4 is no film that can be read" in user.message
    assert application.video.path == film_file


def test_keys_step_and_play_from_anywhere_in_the_pane(
    pane: VideoWiring, user: User, qtbot: QtBot
) -> None:
    pane.view.setFocus()
    qtbot.keyClick(pane.view, Qt.Key.Key_Right)
    user.wait_until_idle()
    assert pane.films.player.index == 1
    assert pane.view.transport.place.toolTip() == "frame 2 of 6, 0.0333 s"
    qtbot.keyClick(pane.view.timeline, Qt.Key.Key_Space)
    assert pane.films.player.is_playing
    qtbot.waitUntil(lambda: not pane.films.player.is_playing)
    user.wait_until_idle()
    assert pane.films.player.index == 5
    assert pane.view.timeline.index == 5
    assert "draft" not in pane.view.pictures.simulated.caption.toolTip()


def test_the_frame_that_is_sought_is_the_one_that_is_shown(pane: VideoWiring, user: User) -> None:
    for index in (4, 2):
        pane.view.timeline.sought.emit(index)
        user.wait_until_idle()
        shown = pane.view.pictures.simulated.caption.toolTip()
        assert shown == f"Simulated: frame {index + 1}, {index / 30.0:.4f} s"
        assert f"frame {index + 1}" in pane.view.rows.title.toolTip()


def test_a_reading_of_an_earlier_scene_is_marked(
    pane: VideoWiring, application: Application, user: User
) -> None:
    mark = pane.view._outdated[0]
    pane.view.bar.read.click()
    user.wait_until_idle()
    assert mark.isHidden()
    application.store.change(code=5)
    user.wait_until_idle()
    assert not mark.isHidden()
    assert mark.text == "read for an earlier scene"
    assert pane.view.bar.read.text() == "Read again"
    pane.view.bar.read.click()
    user.wait_until_idle()
    assert mark.isHidden()


def test_a_recording_that_the_scene_cannot_have_is_a_sentence(
    pane: VideoWiring, user: User
) -> None:
    pane.view.form.fields["frame_rate"].edited.emit(1000.0)
    user.wait_until_idle()
    assert pane.view.pictures.shown == (False, False)
    assert "Reading out 1600 columns" in pane.view.form.gap.text()


def test_the_session_keeps_the_film(
    application: Application, user: User, film_file: Path, tmp_path: Path
) -> None:
    file = SessionFile(tmp_path / "state", ())
    application.desktop.autosave.resume(file, Session(), scene_wins=True)
    application.video.open(film_file)
    user.wait_until_idle()
    application.desktop.autosave.write()
    record = json.loads((tmp_path / "state" / "session-1.json").read_text())
    assert record["film"] == str(film_file)
    application.desktop.autosave.end()
    assert SessionFile(tmp_path / "state", ()).last.film == film_file


def test_a_kept_film_is_opened_when_the_mode_is_first_shown(
    application: Application, user: User, film_file: Path
) -> None:
    application.video.keep(film_file)
    assert application.video.path == film_file
    assert "wiring" not in vars(application.video)
    application.window.modes.switch("video")
    user.wait_until_idle()
    assert application.video.wiring.path == film_file


def test_the_window_closes_while_a_film_plays_and_is_read(
    pane: VideoWiring, application: Application
) -> None:
    pane.view.bar.read.click()
    pane.films.player.play()
    application.window.close()
    assert not pane.films.player.is_playing
    assert not pane.readings.is_running


def test_a_camera_is_read_live_and_released_with_the_mode(
    pane: VideoWiring, application: Application, qtbot: QtBot, film: Video
) -> None:
    source = FilmSource([*film] * 200, "Stand-in")
    pane.live.start(source)
    qtbot.waitUntil(lambda: pane.view.pictures.shown[0] and len(states(pane)) > 0)
    video = pane.live.video
    assert video is not None
    assert pane.view.bar.axis.key() == "columns"
    assert pane.view.bar.title.toolTip() == "Stand-in, live"
    assert not pane.view.transport.play.isEnabled()
    application.window.modes.switch("explore")
    assert not pane.live.is_filming
    qtbot.waitUntil(lambda: not video._thread.is_alive())


def test_a_camera_that_is_unplugged_leaves_its_last_picture_and_a_sentence(
    pane: VideoWiring, user: User, qtbot: QtBot, film: Video
) -> None:
    source = ListedSource([film.frame(0).image, film.frame(1).image])
    pane.live.start(source)
    qtbot.waitUntil(lambda: not pane.live.is_filming)
    user.wait_until_idle()
    assert pane.view.message.text() == (
        "Listed gives no more pictures: it has ended or is unplugged."
    )
    assert pane.view.pictures.shown[0]
    assert pane.view.bar.title.toolTip() == "Listed, stopped"
    assert not source.is_open
    pane.close()
    user.wait_until_idle()
    assert pane.view.pictures.shown == (False, True)


def test_a_camera_that_cannot_hold_its_exposure_says_so(
    pane: VideoWiring, qtbot: QtBot, film: Video
) -> None:
    source = ListedSource([film.frame(0).image] * 100_000)
    source.knows_exposure = False
    pane.live.start(source)
    pane.view.bar.lock.click()
    qtbot.waitUntil(lambda: not pane.view.bar.lock.isChecked())
    assert pane.view.message.text() == "This camera does not let its exposure be held."
    assert source.locked == [True]


def test_cameras_are_looked_for_when_their_menu_opens(
    pane: VideoWiring, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("occ_gui.video.live_controller.find_cameras", lambda: ())
    pane.view.bar.cameras_asked.emit()
    menu = pane.view.bar.cameras
    assert [action.text() for action in menu.actions()] == ["Looking…"]
    qtbot.waitUntil(lambda: menu.actions()[0].text() == "No camera was found")
    assert not menu.actions()[0].isEnabled()


def test_every_control_has_a_name(pane: VideoWiring) -> None:
    from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QWidget

    controls: list[QWidget] = []
    for kind in (QAbstractButton, QAbstractSpinBox, QComboBox):
        controls += pane.view.findChildren(kind)
    nameless = [
        control
        for control in controls
        if not control.accessibleName() and not getattr(control, "text", lambda: "")()
    ]
    assert nameless == []
