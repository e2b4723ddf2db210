"""The mode Video: a film is opened, read, played and closed; a camera is read and released."""

from dataclasses import replace
from pathlib import Path

import pytest
from gui.user import User
from PySide6.QtWidgets import QFileDialog

from occ_gui.app.application import Application
from occ_gui.values.choices import FilmChoice
from occ_gui.video.film_reading import MarkState
from occ_gui.video.wiring import VideoWiring
from occ_model.scene.scene import Scene


@pytest.fixture
def application(application: Application, film_scene: Scene) -> Application:
    """Return the window, which shows the scene of the films."""
    application.scene_store.put(film_scene, "scene of the films")
    return application


def film_in(application: Application) -> Path | None:
    """Return the film that is open, or that will be opened when the pane is first shown."""
    return application.scene_store.store.workspace.film.path


def states(pane: VideoWiring) -> list[int]:
    return pane.view.timeline.frames.states.tolist()


def test_a_film_is_opened_read_seen_along_either_axis_and_closed_and_stays_where_the_next_is_none(
    application: Application, user: User, film_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(film_file), ""))
    close = application.window.actions_by_name["close_film"]
    assert not close.isEnabled()
    user.choose("Open &film")
    pane = application.video.wiring
    user.wait_until_idle()
    assert close.isEnabled()
    assert application.window.modes.mode == "video"
    assert pane.view.pictures.are_visible == (True, True)
    assert pane.view.bar.title.toolTip() == "stripes.avi, 1600 x 60, 6 frames, 30 a second"
    assert len(states(pane)) == 6
    assert MarkState.PENDING not in states(pane)
    assert film_file in application.preferences.files
    assert pane.view.form.recording.frame_rate == 30.0
    axis = pane.view.bar.axis
    assert axis.isVisible()
    assert axis.key() == "columns"
    axis.setCurrentIndex(axis.findData("lines"))
    axis.activated.emit(axis.currentIndex())
    user.wait_until_idle()
    assert pane.view.bar.title.toolTip().startswith("stripes.avi, 60 x 1600")
    assert axis.key() == "lines"
    damaged = film_file.with_name("damaged.mp4")
    damaged.write_bytes(b"no film")
    application.files.open_film(damaged)
    user.wait_until_idle()
    assert "damaged.mp4 is not a film that can be read" in user.message
    assert (film_in(application), close.isEnabled()) == (film_file, True)
    user.choose("C&lose film")
    assert not close.isEnabled()
    assert film_in(application) is None
    assert application.video.wiring.view.pictures.are_visible == (False, True)
    application.window.dropped.emit([film_file])
    assert film_in(application) == film_file


@pytest.mark.own_window
def test_a_film_of_the_last_session_can_be_closed_unseen_and_opens_when_the_mode_is_first_shown(
    application: Application, user: User, film_file: Path
) -> None:
    assert application.shell.is_idle
    store = application.scene_store.store
    store.put(replace(store.workspace, film=FilmChoice(film_file)))
    user.choose("C&lose film")
    assert film_in(application) is None
    assert not application.window.actions_by_name["close_film"].isEnabled()
    store.put(replace(store.workspace, film=FilmChoice(film_file)))
    assert film_in(application) == film_file
    assert application.shell.find_pane("video") is None
    user.switch("video")
    pane = application.video.wiring
    assert pane.path == film_file
    pane.view.bar.read.click()
    pane.films.player.play()
    assert pane.films.player.is_playing
    assert pane.readings.is_running
    application.window.close()
    assert not pane.films.player.is_playing
    assert not pane.readings.is_running
