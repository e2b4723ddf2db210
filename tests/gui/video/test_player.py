"""Player: the film runs at its own speed, and stands at its ends."""

import pytest
from gui.kinds import collect

from occ_gui.video.film_controller import FilmPlayer


class Clock:
    """A clock that is set by hand."""

    def __init__(self) -> None:
        self.now = 0

    def start(self) -> None:
        self.now = 0

    def elapsed(self) -> int:
        return self.now


clock = Clock()


@pytest.fixture
def player(qapp: object, monkeypatch: pytest.MonkeyPatch) -> FilmPlayer:
    player = FilmPlayer()
    monkeypatch.setattr(player, "_clock", clock)
    player.set_film(30, 10.0)
    return player


def pass_time(player: FilmPlayer, milliseconds: int) -> None:
    clock.now += milliseconds
    player.advance()


def test_a_film_runs_at_its_own_speed_and_leaves_late_frames_out(player: FilmPlayer) -> None:
    shown = collect(player.wanted)
    player.play()
    for milliseconds in (50, 60, 10, 500):
        pass_time(player, milliseconds)
    assert shown == [1, 6]
    pass_time(player, 60_000)
    assert player.index == 29
    assert not player.is_playing


def test_it_plays_on_from_the_frame_that_was_sought_and_a_step_stops_it(player: FilmPlayer) -> None:
    player.play()
    pass_time(player, 300)
    player.seek(20)
    pass_time(player, 200)
    assert player.index == 22
    assert player.is_playing
    player.step(1)
    assert not player.is_playing
    assert player.index == 23
    player.seek(1)
    player.step(-5)
    assert player.index == 0
    player.step(100)
    assert player.index == 29


def test_at_the_end_it_begins_anew(player: FilmPlayer) -> None:
    player.seek(29)
    player.play()
    assert player.index == 0
    assert player.is_playing
    player.toggle()
    assert not player.is_playing
    player.seek(29)
    player.set_count(12)
    assert player.index == 11


def test_another_film_does_not_play_by_itself_and_a_single_frame_never(player: FilmPlayer) -> None:
    player.play()
    assert player.is_playing
    player.set_film(10, 5.0)
    assert not player.is_playing
    assert (player.index, player.count) == (0, 10)
    player.set_film(1, None)
    player.play()
    assert not player.is_playing
