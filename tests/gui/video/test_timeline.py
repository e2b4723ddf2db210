"""Timeline and player: every frame can be reached, states differ in shape, and time is kept."""

import numpy as np
import pytest
from gui.kinds import add_widget, collect, show_widget
from hypothesis import given, strategies as st
from PySide6.QtCore import QElapsedTimer, QPoint, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter
from pytestqt.qtbot import QtBot

from occ_gui.video.film_controller import FilmPlayer
from occ_gui.video.film_reading import Marks, MarkState, draw_mark, frame_marks
from occ_gui.video.timeline import Timeline, tick_step
from occ_gui.window.theme import palette_of

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def timeline(qtbot: QtBot) -> Timeline:
    timeline = add_widget(qtbot, Timeline())
    timeline.resize(700, timeline.sizeHint().height())
    states = np.array([1, 1, 3, 2, 0, 0, 0, 0, 0, 0, 0, 0], dtype=np.uint8)
    timeline.show_frames(frame_marks(np.arange(12) / 30.0, states, 1 / 30.0))
    timeline.show()
    return timeline


def test_a_click_shows_the_frame_that_it_hits(timeline: Timeline, qtbot: QtBot) -> None:
    frame_chosen = collect(timeline.frame_chosen)
    for index in (5, 11, 0):
        middle = timeline.x_of((index + 0.5) / 30.0)
        qtbot.mouseClick(timeline, LEFT, pos=QPoint(round(middle), 20))
    assert frame_chosen == [5, 11, 0]


def test_keys_step_to_the_ends_and_not_beyond_and_the_space_bar_asks_to_play(
    timeline: Timeline, qtbot: QtBot
) -> None:
    keys = Qt.Key
    for key, index in (
        (keys.Key_Left, 0), (keys.Key_Right, 1), (keys.Key_PageDown, 11), (keys.Key_Right, 11),
        (keys.Key_Left, 10), (keys.Key_PageUp, 0), (keys.Key_End, 11), (keys.Key_Home, 0),
    ):  # fmt: skip
        qtbot.keyClick(timeline, key)
        assert timeline.index == index
    with qtbot.waitSignal(timeline.play_asked):
        qtbot.keyClick(timeline, Qt.Key.Key_Space)


def test_a_screen_reader_hears_frame_time_and_state(timeline: Timeline) -> None:
    timeline.show_index(2)
    assert timeline.accessibleDescription() == "frame 3 of 12, 0.067 s, lost"
    timeline.show_index(3)
    assert timeline.accessibleDescription().endswith("read, not checked")
    timeline.show_frames(Marks())
    assert timeline.accessibleDescription() == "no film"


@pytest.mark.parametrize("width", [3, 12])
def test_states_are_told_apart_without_colour(qapp: object, width: int) -> None:
    shapes = []
    for state in MarkState:
        image = QImage(width, 24, QImage.Format.Format_RGB32)
        image.fill(QColor("white"))
        painter = QPainter(image)
        draw_mark(painter, QRectF(0, 0, width, 24), state, palette_of("light"))
        painter.end()
        grey = np.array(
            [[image.pixelColor(x, y).lightness() < 250 for x in range(width)] for y in range(24)]
        )
        shapes.append(grey)
    for place, one in enumerate(shapes):
        for other in shapes[place + 1 :]:
            assert np.mean(one != other) > 0.1


@pytest.mark.parametrize("jump", [3600.0, -0.7, -3600.0])
def test_frames_whose_times_jump_are_shown_for_their_own_time_only(
    timeline: Timeline, jump: float
) -> None:
    times = np.arange(20) / 30.0
    times[10:] += jump
    marks = frame_marks(times, np.ones(20, dtype=np.uint8), 1 / 30.0)
    assert (marks.ends - marks.starts).tolist() == pytest.approx([1 / 30.0] * 20)
    timeline.show_frames(marks)
    ends = (timeline.frame_at(timeline.x_of(time)) for time in (times.min(), times.max()))
    assert times[list(ends)].tolist() == [times.min(), times.max()]


def test_a_missing_film_causes_no_error(qtbot: QtBot) -> None:
    timeline = show_widget(qtbot, Timeline())
    qtbot.keyClick(timeline, Qt.Key.Key_End)
    qtbot.mouseClick(timeline, LEFT)
    assert timeline.index == 0


@given(st.lists(st.sampled_from(list(MarkState)), min_size=1, max_size=300), st.integers(1, 40))
def test_bins_hold_each_mark_once(states: list[MarkState], bins: int) -> None:
    times = np.arange(len(states)) / 30.0
    marks = frame_marks(times, np.array(states, dtype=np.uint8), 1.0 / 30.0)
    counts = marks.count_states(np.linspace(*marks.extent, bins + 1))
    assert counts.shape == (bins, len(MarkState))
    assert counts.sum(axis=0).tolist() == [states.count(state) for state in MarkState]


def test_each_frame_lasts_until_the_next_one() -> None:
    marks = frame_marks([0.0, 0.03, 0.07], np.zeros(3, dtype=np.uint8), 0.04)
    assert marks.ends.tolist() == pytest.approx([0.03, 0.07, 0.11])
    assert not len(frame_marks([], np.zeros(0, dtype=np.uint8), 0.04))
    assert not len(Marks())
    assert marks.extent == pytest.approx((0.0, 0.11))
    assert Marks().extent == (0.0, 0.0)


@given(st.floats(1e-4, 1e5), st.integers(100, 4000))
def test_ticks_are_apart_and_their_numbers_differ(span: float, width: int) -> None:
    step, digits = tick_step(span, width)
    assert step / span * width >= 79.999
    assert step / span * width <= 250.0
    first, second = f"{step:.{digits}f}", f"{2 * step:.{digits}f}"
    assert float(first) == pytest.approx(step)
    assert first != second


class Clock(QElapsedTimer):
    """A clock that the test sets."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 0

    def start(self) -> None:
        self.now = 0

    def elapsed(self) -> int:
        return self.now


clock = Clock()


@pytest.fixture
def player(qapp: object) -> FilmPlayer:
    player = FilmPlayer(clock=clock)
    player.set_film(30, 10.0)
    return player


def pass_time(player: FilmPlayer, milliseconds: int) -> None:
    clock.now += milliseconds
    player.advance()


def test_a_film_runs_at_its_own_speed_and_leaves_late_frames_out(player: FilmPlayer) -> None:
    shown = collect(player.frame_requested)
    player.play()
    for milliseconds in (50, 60, 10, 500):
        pass_time(player, milliseconds)
    assert shown == [1, 6]
    pass_time(player, 60_000)
    assert player.index == 29
    assert not player.is_playing


def test_a_film_plays_on_from_the_frame_sought_and_a_step_stops_it(player: FilmPlayer) -> None:
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


def test_at_the_end_it_starts_again(player: FilmPlayer) -> None:
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
