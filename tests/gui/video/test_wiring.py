"""The pane of films shows, plays and reads a film, and reads live from a camera."""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from pathlib import Path
from typing import TypeAlias

import pytest
from film_source import FilmSource, ListedSource
from gui.kinds import collect
from gui.stores import store_of
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import ResultsStore
from occ_gui.video.film_reading import MarkState
from occ_gui.video.wiring import VideoWiring
from occ_gui.widgets.outdated_mark import OutdatedMark
from occ_model.results.video import Video, VideoFrame
from occ_model.scene.scene import Scene

Wait: TypeAlias = Callable[[], None]


@pytest.fixture
def scenes(film_scene: Scene) -> SceneStore:
    return store_of(film_scene)


@pytest.fixture
def pane(qtbot: QtBot, scenes: SceneStore) -> Iterator[VideoWiring]:
    wiring = VideoWiring(scenes, ResultsStore())
    wiring.view.form.count.setValue(6)
    qtbot.addWidget(wiring.view)
    wiring.view.resize(640, 600)
    wiring.view.show()
    wiring.set_visible(True)
    qtbot.waitUntil(lambda: wiring.is_idle)
    yield wiring
    wiring.stop()


@pytest.fixture
def wait(qtbot: QtBot, pane: VideoWiring) -> Wait:
    return lambda: qtbot.waitUntil(lambda: pane.is_idle)


def states(pane: VideoWiring) -> list[int]:
    return pane.view.timeline.frames.states.tolist()


def test_the_simulated_film_is_shown_at_once_and_read_when_asked(
    pane: VideoWiring, wait: Wait
) -> None:
    assert pane.view.pictures.are_visible == (False, True)
    assert states(pane) == [MarkState.PENDING] * 6
    pane.view.bar.read.click()
    assert pane.view.bar.read.text() == "Stop reading"
    wait()
    assert MarkState.PENDING not in states(pane)
    assert "718" in pane.view.data.text.toPlainText()


def test_keys_step_and_play_from_anywhere_in_the_pane(
    pane: VideoWiring, wait: Wait, qtbot: QtBot
) -> None:
    pane.view.setFocus()
    qtbot.keyClick(pane.view, Qt.Key.Key_Right)
    wait()
    assert pane.films.player.index == 1
    assert pane.view.transport.place.toolTip() == "frame 2 of 6, 0.0333 s"
    qtbot.keyClick(pane.view.timeline, Qt.Key.Key_Space)
    assert pane.films.player.is_playing
    qtbot.waitUntil(lambda: not pane.films.player.is_playing)
    wait()
    assert pane.films.player.index == 5
    assert pane.view.timeline.index == 5
    assert "draft" not in pane.view.pictures.simulated.caption.toolTip()


def test_the_frame_that_is_sought_is_the_one_that_is_shown(pane: VideoWiring, wait: Wait) -> None:
    for index in (4, 2):
        pane.view.timeline.frame_chosen.emit(index)
        wait()
        shown = pane.view.pictures.simulated.caption.toolTip()
        assert shown == f"Simulated: frame {index + 1}, {index / 30.0:.4f} s"
        assert f"frame {index + 1}" in pane.view.rows.title.text()


def test_a_reading_of_an_earlier_scene_is_marked(
    pane: VideoWiring, scenes: SceneStore, wait: Wait
) -> None:
    mark = pane.view.findChildren(OutdatedMark)[0]
    pane.view.bar.read.click()
    wait()
    assert mark.isHidden()
    scenes.change(code=5)
    wait()
    assert not mark.isHidden()
    assert mark.text == "read for an earlier scene"
    assert pane.view.bar.read.text() == "Read again"
    pane.view.bar.read.click()
    wait()
    assert mark.isHidden()


def test_an_impossible_recording_is_refused_with_a_sentence(pane: VideoWiring, wait: Wait) -> None:
    pane.view.form.fields["frame_rate"].edited.emit(1000.0)
    wait()
    assert pane.view.pictures.are_visible == (False, False)
    assert "Reading out 1600 columns" in pane.view.form.gap.text()


def test_a_camera_that_is_unplugged_leaves_its_last_picture_and_a_sentence(
    pane: VideoWiring, wait: Wait, qtbot: QtBot, film: Video
) -> None:
    source = ListedSource([film.frame(0).image, film.frame(1).image])
    pane.live.start(source)
    qtbot.waitUntil(lambda: not pane.live.is_filming)
    wait()
    assert pane.view.message.text() == (
        "Listed delivers no more pictures: it ended or was unplugged."
    )
    assert pane.view.pictures.are_visible[0]
    assert pane.view.bar.title.toolTip() == "Listed, stopped"
    assert not source.is_open
    pane.close()
    wait()
    assert pane.view.pictures.are_visible == (False, True)


def test_the_last_picture_of_a_camera_is_shown_though_nothing_reads_its_film(
    pane: VideoWiring, wait: Wait, qtbot: QtBot, film: Video
) -> None:
    pane.live.start(ListedSource([film.frame(0).image]))
    pane.readings.cancel()
    qtbot.waitUntil(lambda: not pane.live.is_filming)
    wait()
    assert pane.view.pictures.are_visible[0]


def test_a_camera_is_read_live_and_released_when_the_pane_is_hidden(
    pane: VideoWiring, qtbot: QtBot, film: Video
) -> None:
    pane.live.start(FilmSource([*film] * 200, "Stand-in"))
    qtbot.waitUntil(lambda: pane.view.pictures.are_visible[0] and len(states(pane)) > 0)
    video = pane.live.video
    assert pane.view.bar.axis.key() == "columns"
    assert pane.view.bar.title.toolTip() == "Stand-in, live"
    assert not pane.view.transport.play.isEnabled()
    pane.set_visible(False)
    assert not pane.live.is_filming
    qtbot.waitUntil(lambda: not video.thread.is_alive())


def test_a_camera_that_cannot_hold_its_exposure_says_so(
    pane: VideoWiring, qtbot: QtBot, film: Video
) -> None:
    image = film.frame(0).image
    # Endless, and at a camera's rate: the click may come late on a busy machine.
    source = FilmSource((VideoFrame(n, 0.01 * n, image) for n in count()), "Endless")
    source.knows_exposure = False
    pane.live.start(source)
    pane.view.bar.lock.click()
    qtbot.waitUntil(lambda: not pane.view.bar.lock.isChecked())
    assert pane.view.message.text() == "The exposure of this camera cannot be held."
    assert source.locked == [True]


def test_the_next_camera_is_not_said_to_hold_its_exposure(
    pane: VideoWiring, qtbot: QtBot, film: Video
) -> None:
    for title in ("First", "Second"):
        source = FilmSource((VideoFrame(n, 0.01 * n, film.frame(0).image) for n in count()), title)
        pane.live.start(source)
        assert not pane.view.bar.lock.isChecked()
        pane.view.bar.lock.click()
        qtbot.waitUntil(partial(source.locked.__eq__, [True]))
        assert pane.view.bar.lock.isChecked()


def test_cameras_are_looked_for_when_their_menu_opens(
    pane: VideoWiring, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("occ_gui.video.live_controller.find_cameras", lambda: ())
    pane.view.bar.cameras_asked.emit()
    menu = pane.view.bar.cameras
    assert [action.text() for action in menu.actions()] == ["Looking…"]
    qtbot.waitUntil(lambda: menu.actions()[0].text() == "No camera was found")
    assert not menu.actions()[0].isEnabled()


def test_the_simulated_film_is_saved_or_cancelled(
    pane: VideoWiring, wait: Wait, tmp_path: Path, film_scene: Scene
) -> None:
    said = collect(pane.status_message)
    pane.save(tmp_path / "film.gif")
    wait()
    assert said == ["Saved film.gif"]
    written = occ.load_video(tmp_path / "film.gif")
    assert len(list(written)) == 6
    assert written.scene == film_scene
    pane.save(tmp_path / "film.txt")
    wait()
    assert "film.txt" in said[-1]
    pane.save(tmp_path / "other.gif")
    pane.view.form.saving.cancelled.emit()
    wait()
    assert said[-1] == "The film was cancelled."
    pane.saving.task.stop()
    assert not (tmp_path / "other.gif").exists()
