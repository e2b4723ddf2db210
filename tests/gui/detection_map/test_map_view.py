"""The pane of the map: its drawing, clicks on it, and its end."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from gui.detection_map.conftest import MapBench
from gui.kinds import add_widget, collect
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from occ_gui.detection_map.axis_ticks import make_ticks, write_axis_title
from occ_gui.detection_map.colour_map import DIFFERENCES, RATES, to_colours
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.rate_map import (
    MAP_PARAMETERS,
    PointFacts,
    RateMap,
    TheoryFields,
    make_lattice,
)
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

Picture = Callable[[QWidget], Any]
DECODERS = ("threshold", "matched")
SHAPE = (13, 7)
FREQUENCY, DISTANCE = "switching_frequency", "distance"


def rates_of(right: dict[int, tuple[int, int]], refused: tuple[int, ...] = ()) -> RateMap:
    """Return a map in which some points are known."""
    x_values, y_values = make_lattice(FREQUENCY, SHAPE[0]), make_lattice(DISTANCE, SHAPE[1])
    rates = RateMap(FREQUENCY, DISTANCE, x_values, y_values, DECODERS)
    read = [
        SweepPoint(index, 10, counts, "", tuple(int(count == 10) for count in counts))
        for index, counts in right.items()
    ]
    rates.enter(read, 1)
    rates.enter([SweepPoint(index, 0, (0, 0), "It cannot be.", (0, 0)) for index in refused], 1)
    return rates


def test_the_status_shows_rate_bits_and_interval_or_why_not(view: MapView) -> None:
    every = tuple(range(SHAPE[0] * SHAPE[1]))
    view.show_map(rates_of({}, refused=every))
    view.show_progress(len(every), len(every), 1, 5)
    assert view.status.toolTip() == "It cannot be."
    view.show_map(full_map((10, 10), refused=(45,)))
    view.show_progress(len(every), len(every), 1, 5)
    assert "points" in view.status.toolTip()
    counts = (("threshold", 45, 78.6, 95.7),)
    view.show_facts(PointFacts(10e3, 1.2, counts, 50, 5, ""))
    assert view.status.toolTip() == "10 kHz, 1.2 m: threshold 90 %, 45 of 50 bits (79 to 96 %)"
    view.show_facts(PointFacts(10e3, 1.2, (("threshold", 0, 0.0, 0.0),), 0, 1, "It cannot be."))
    assert view.status.toolTip() == "10 kHz, 1.2 m: It cannot be."
    view.show_progress(7, 91, 0, 5)
    view.show_facts(None)
    assert view.status.toolTip() == "7 of 91 points measured"


def test_a_plug_in_that_fails_is_named_for_a_point_and_for_the_map(view: MapView) -> None:
    fault = "With the own decoder a plug-in failed in 2 of 2 readings; first: It cannot."
    rates = full_map((10, 10), refused=(45,))
    rates.enter([SweepPoint(3, 10, (0, 0), fault, (0, 0))], 2, first=1)
    view.show_map(rates)
    view.show_progress(91, 91, 1, 5)
    assert view.status.toolTip() == fault
    view.show_facts(PointFacts(10e3, 1.2, (("own", 0, 0.0, 79.3),), 10, 1, fault))
    assert view.status.toolTip() == f"10 kHz, 1.2 m: own 0 %, 0 of 10 bits (0 to 79 %); {fault}"


def full_map(count: tuple[int, int], refused: tuple[int, ...] = ()) -> RateMap:
    """Return a map whose points all have this number of right bits of each decoder."""
    points = SHAPE[0] * SHAPE[1]
    return rates_of({i: count for i in range(points) if i not in refused}, refused)


@pytest.fixture
def view(qtbot: QtBot, small_scene: Scene) -> MapView:
    view = add_widget(qtbot, MapView(DECODERS))
    view.resize(700, 300)
    view.show_scene(small_scene)
    view.show()
    return view


def test_a_known_point_fills_cells_until_finer_ones_come() -> None:
    rates = rates_of({0: (10, 10)})
    x, _ = rates.find_rate_sources()
    assert (x[:3, :3] == 0).all()
    assert (x[4:] == -1).all()
    rates.enter([SweepPoint(SHAPE[1] + 1, 10, (0, 0), "", (0, 0))], 1)
    x, y = rates.find_rate_sources()
    assert (x[1, 1], y[1, 1]) == (1, 1)
    assert (x[2, 2], y[2, 2]) == (0, 0)


def test_a_click_or_arrow_keys_and_enter_choose_a_cell(qtbot: QtBot, view: MapView) -> None:
    view.show_map(full_map((10, 10)))
    plot = view.plots.plots[0]
    picks = collect(view.plots.picked)
    for cell in ((0, 0), (12, 6), (5, 3)):
        place = plot.place_of((cell[0] / 12, cell[1] / 6)).toPoint()
        qtbot.mouseClick(plot, Qt.MouseButton.LeftButton, pos=place)
        assert picks[-1] == cell
    qtbot.mouseClick(plot, Qt.MouseButton.LeftButton, pos=QPoint(1, 1))
    assert len(picks) == 3
    places = collect(view.plots.pointed)
    qtbot.keyClick(plot, Qt.Key.Key_Right)
    qtbot.keyClick(plot, Qt.Key.Key_Up)
    qtbot.keyClick(plot, Qt.Key.Key_Return)
    assert places[1] == (places[0][0], places[0][1] + 1)
    assert picks[3:] == [places[-1]]


def test_refused_points_are_hatched_and_look_like_no_rate(
    view: MapView, grey_picture: Picture
) -> None:
    view.show_map(full_map((10, 10), refused=(45,)))
    plot = view.plots.plots[0]
    plot.setting = None
    plot.update()
    picture = grey_picture(plot).astype(int)

    def cell(x: int, y: int) -> Any:
        at = plot.place_of((x / 12, y / 6)).toPoint()
        return picture[at.y() - 8 : at.y() + 8, at.x() - 6 : at.x() + 6]

    assert np.ptp(cell(*divmod(45, 7))) > 40  # stripes
    assert np.ptp(cell(2, 2)) == 0


def test_both_decoders_one_or_their_difference_are_shown(view: MapView) -> None:
    view.show_map(full_map((2, 10)))
    for what, titles in (
        ("both", list(DECODERS)),
        ("matched", ["matched"]),
        ("difference", ["matched minus threshold"]),
    ):
        view.decoder_choice.show_key(what)
        view.decoder_choice.chosen.emit(what)
        visible = [plot for plot in view.plots.plots if plot.isVisible()]
        assert [plot.title for plot in visible] == titles
        assert all(plot.accessibleName().endswith(plot.title) for plot in visible)
    assert view.plots.bar.accessibleName().startswith("Difference")


def test_a_rate_has_its_own_colour_and_each_visible_limit_a_line(view: MapView) -> None:
    rates = full_map((5, 10))
    view.show_map(rates)
    plot = view.plots.plots[0]
    plot.setting = None
    image = plot.grab().toImage()
    at = plot.place_of((2 / 12, 2 / 6)).toPoint()
    expected = to_colours(np.full((1, 1), 50.0), 0.0, 100.0, RATES)[0, 0, :3].tolist()
    colour = image.pixelColor(at)
    assert [colour.red(), colour.green(), colour.blue()] == pytest.approx(expected, abs=2)
    line = [np.array([[0.1, 0.1], [0.9, 0.9]])]
    theory = Mock(spec=TheoryFields)
    theory.lines.return_value = {"band": line, "null": line}
    rates.theory = theory
    view.show_map(rates)
    view.plots.show_limit("band", False)
    assert list(plot.lines) == ["null"]
    view.plots.show_limit("band", True)
    assert list(plot.lines) == ["band", "null"]


def test_images_of_a_point_are_counted_once_and_few_are_pale(view: MapView) -> None:
    rates = rates_of({0: (10, 3), 1: (10, 10)})
    rates.enough_images = 5
    more = [SweepPoint(0, 40, (38, 4), "", (3, 0))]
    for _ in range(2):  # as when a request comes back whose results are still on their way
        rates.enter(more, 5, first=1)
    assert rates.rates(DECODERS[0])[0, 0] == 100.0 * 48 / 50
    assert rates.rates(DECODERS[1])[0, 0] == 100.0 * 7 / 50
    assert rates.whole[0, 0].tolist() == [4, 0]
    assert rates.find_doubtful()[0, :2].tolist() == [False, True]
    assert rates.least_images == 0
    view.show_map(rates)
    image = view.plots.plots[0].image
    opacities = [image.pixelColor(0, SHAPE[1] - 1 - y).alpha() for y in range(SHAPE[1])]
    assert opacities[0] == 255 > opacities[1] > 0 == opacities[-1]


def test_colours_of_rates_become_lighter_and_the_middle_of_differences_is_grey() -> None:
    steps = to_colours(np.linspace(0.0, 100.0, 9)[None], 0.0, 100.0, RATES)[0, :, :3]
    light = steps.astype(float) @ np.array([0.2126, 0.7152, 0.0722])
    assert (np.diff(light) > 0).all()
    middle = to_colours(np.zeros((1, 1)), -100.0, 100.0, DIFFERENCES)[0, 0, :3]
    assert np.ptp(middle.astype(int)) < 12
    assert to_colours(np.full((1, 1), np.nan), 0.0, 1.0, RATES)[0, 0, 3] == 0


def test_a_line_lies_where_the_value_is_zero_and_ends_where_it_is_unknown() -> None:
    places = (np.linspace(0.0, 1.0, 8), np.linspace(0.0, 1.0, 5))
    sides = places[0][:, None] + places[1] - 0.9
    (line,) = TheoryFields(places, {"band": sides}).lines()["band"]
    assert all(x + y == pytest.approx(0.9) for x, y in line)
    assert abs(line[0][0] - line[-1][0]) == pytest.approx(0.9)
    sides[3] = np.nan
    assert len(TheoryFields(places, {"band": sides}).lines()["band"]) == 2
    sides[:] = np.nan
    assert TheoryFields(places, {"null": sides}).lines() == {"null": []}


@pytest.mark.parametrize("name", MAP_PARAMETERS)
@pytest.mark.parametrize("most", [3, 8])
def test_the_numbers_of_an_axis_are_round_and_as_dense_as_allowed(name: str, most: int) -> None:
    """Steps of a linear axis are 1, 2 or 5 times a power of ten, and finer ones would be too many.

    A logarithmic axis has one, two and five of each power of ten; or one and three; or one.
    """
    parameter = quantity(name)
    numbers = make_ticks(parameter, most)
    places = [tick.place for tick in numbers]
    assert 1 <= len(numbers) <= most + 1
    assert places == sorted(places)
    assert all(0.0 <= place <= 1.0 for place in places)
    assert write_axis_title(parameter)
    if parameter.scale == "linear":
        step = np.diff(places).max()
        assert np.diff(places) == pytest.approx(step)
        assert step < 2.5 / most * (1.0 + 1e-6)
    else:
        digits = {f"{float(tick.text):e}"[0] for tick in numbers}
        assert digits <= {"1", "2", "5"} or digits <= {"1", "3"}


def test_a_click_on_the_map_is_undone_as_one_step(map_bench: MapBench) -> None:
    controller, scenes = map_bench.pane.map, map_bench.scenes
    controller.map = full_map((10, 10))
    before = scenes.scene
    map_bench.view.plots.picked.emit((2, 3))
    assert scenes.scene.value(FREQUENCY) == controller.map.x_values[2]
    assert scenes.scene.value(DISTANCE) == controller.map.y_values[3]
    scenes.undo_stack.undo()
    assert scenes.scene == before


def test_stopping_ends_the_workers(qtbot: QtBot, map_bench: MapBench) -> None:
    map_bench.see("map")
    qtbot.waitUntil(lambda: map_bench.background_rates.queue.workers is not None)
    map_bench.stop()
    assert map_bench.workers.closed == 1


def test_a_pane_made_later_shows_the_frame_rate_chosen_before(map_bench: MapBench) -> None:
    map_bench.store.put(replace(map_bench.store.workspace, frame_rate=24.0, shown="bits"))
    assert (map_bench.view.frame_rate.value(), map_bench.view.quantity.key()) == (24.0, "bits")


def test_a_map_of_an_earlier_scene_is_marked_at_once_and_dimmed_later(view: MapView) -> None:
    text = "91 points of at least 2 pictures each; pale: under 5"
    view.show_map(full_map((5, 10)))
    view.show_progress(91, 91, 2, 5)
    view.show_age(0.01)
    assert view.status.toolTip() == f"Earlier scene: {text}"
    assert view.outdated.isHidden()
    view.show_age(1.0)
    assert view.outdated.isVisible()
    view.show_age(0.0)
    assert view.outdated.isHidden()
    assert view.status.toolTip() == text


@pytest.fixture
def rates(view: MapView) -> RateMap:
    """Show the bits a second of a point at which one decoder reads the whole payload."""
    rates = rates_of({0: (10, 9)})
    view.show_axes(FREQUENCY, DISTANCE)
    view.show_map(rates)
    view.show_quantity("bits", 25.0)
    return rates


def test_bits_a_second_count_only_whole_payloads(view: MapView, rates: RateMap) -> None:
    # Nine of ten bits are a success rate of 90 %, and no payload.
    assert rates.bits_a_second(DECODERS[0], 25.0)[0, 0] == pytest.approx(250.0)
    assert rates.bits_a_second(DECODERS[1], 25.0)[0, 0] == 0.0
    assert not view.frame_rate.isHidden()
    facts = PointFacts(1e3, 1.0, ((DECODERS[0], 10, 70, 100), (DECODERS[1], 9, 60, 98)), 10, 1, "",
                       (1, 0), 250.0)  # fmt: skip
    view.show_facts(facts)
    assert (
        f"{DECODERS[0]} 250 bits a second, 1 of 1 pictures read without an error"
        in view.status.toolTip()
    )
    assert f"{DECODERS[1]} 0 bits a second" in view.status.toolTip()
    view.show_quantity("rate", 25.0)
    assert f"{DECODERS[0]} 100 %, 10 of 10 bits" in view.status.toolTip()
    rates.picture_times = 0.1  # limits the number of pictures a second
    assert rates.bits_a_second(DECODERS[0], 30.0)[0, 0] == pytest.approx(100.0)


def bar_numbers(view: MapView) -> list[str]:
    return [text for _, text in view.plots.bar.numbers]


def test_the_bar_of_bits_goes_from_zero_to_the_most_possible(view: MapView, rates: RateMap) -> None:
    most = float(rates.most_bits(25.0).max())
    assert most > float(rates.most_bits(25.0).min())
    assert bar_numbers(view)[0] == "0"
    assert bar_numbers(view)[-1] == f"{most:,.0f}"
    assert not any(text.startswith(("+", "-")) for text in bar_numbers(view))
    # A difference has a sign, except for zero.
    view.decoder_choice.show_key("difference")
    view.plots.show_choice("difference")
    assert bar_numbers(view)[-1] == f"{most:+,.0f}"
    assert bar_numbers(view)[0] == f"{-most:+,.0f}"
    assert bar_numbers(view)[2] == "0"
