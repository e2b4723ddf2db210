"""Each main slider has a strip that shows what a decoder would read along it."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from gui.conftest import RememberingWorkers
from gui.kinds import add_widget
from gui.pane_bench import ControlsBench, handle_middle
from gui.stores import store_of
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.background.signals import WorkQueue
from occ_gui.detection_map import slider_strip_controller as module, wiring
from occ_gui.detection_map.colour_map import RATES, to_colours
from occ_gui.detection_map.rate_map import make_lattice
from occ_gui.detection_map.slider_strip import IMAGES, SliderStrip, SliderStrips
from occ_gui.detection_map.slider_strip_controller import RateRequest, SliderStripController
from occ_gui.detection_map.wiring import BackgroundRates
from occ_gui.detection_map.worker import StripPoints
from occ_gui.scene.control_panel import main_of
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.sweep.sweep import MeasuredPoints

POSITIONS = 5
NAMES = ("switching_frequency", "iso")
Fractions = tuple[float | None, ...]


class Bench:
    """A controller of few positions whose workers need no processes."""

    def __init__(self, qtbot: QtBot, scene: Scene, workers: Any) -> None:
        self._qtbot = qtbot
        self.workers = workers
        rows = {name: add_widget(qtbot, QuantityRow(quantity(name))) for name in NAMES}
        strips = SliderStrips(rows)
        self.strips = strips.strips
        self.queue = WorkQueue(1, lambda: workers)
        self.scenes = store_of(scene)
        self.controller = SliderStripController(self.scenes, self.queue.channels[0], strips)

    def wait_until_idle(self) -> dict[str, Fractions]:
        self._qtbot.waitUntil(lambda: self.controller.is_idle)
        return {name: strip.fractions for name, strip in self.strips.items()}

    def list_outdated(self) -> dict[str, bool]:
        descriptions = {name: each.accessibleDescription() for name, each in self.strips.items()}
        return {name: text.startswith("earlier scene") for name, text in descriptions.items()}

    def list_measured(self) -> list[str]:
        """Return the sliders along which was measured since the last call."""
        names = [str(job.arguments[2]) for job in self.workers.jobs]
        self.workers.jobs.clear()
        return names


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    monkeypatch.setattr(module, "POSITIONS", POSITIONS)
    bench = Bench(qtbot, small_scene, RememberingWorkers())
    yield bench
    bench.queue.stop()


def test_a_strip_is_the_success_rate_along_its_slider(bench: Bench) -> None:
    store, decoder = bench.scenes.store, "matched"
    store.put(replace(store.workspace, decoder=decoder))
    bench.controller.set_visible(True)
    fractions = bench.wait_until_idle()
    scene = bench.scenes.scene
    for name in NAMES:
        rates = [
            occ.success_rate(scene.replace(**{name: value}), IMAGES, decoder)
            for value in make_lattice(name, POSITIONS)
        ]
        assert fractions[name] == pytest.approx([rate / 100 for rate in rates])


def test_nothing_is_measured_while_the_strips_are_hidden(bench: Bench, qtbot: QtBot) -> None:
    bench.scenes.change(exposure_time=136e-6)
    qtbot.wait(30)
    assert bench.list_measured() == []
    bench.controller.set_visible(True)
    bench.wait_until_idle()
    assert set(bench.list_measured()) == set(NAMES)
    bench.controller.set_visible(False)
    bench.scenes.change(exposure_time=68e-6)
    qtbot.wait(30)
    assert bench.list_measured() == []
    bench.scenes.change(pattern="10")
    bench.controller.set_visible(True)
    assert set(bench.wait_until_idle()["iso"]) == {None}


def test_where_a_plug_in_fails_the_rate_is_unknown() -> None:
    failed, read = (SweepPoint(0, 20, (0,), note, (0,)) for note in ("A plug-in failed.", ""))
    assert module.compute_scene_rate(MeasuredPoints((failed,), 2, 0.0)) is None
    assert module.compute_scene_rate(MeasuredPoints((read,), 2, 0.0)).fraction == 0.0
    assert (module.fraction_of(failed), module.fraction_of(read)) == (None, 0.0)


def test_moving_a_slider_does_not_change_its_own_strip(bench: Bench) -> None:
    bench.controller.set_visible(True)
    before = bench.wait_until_idle()
    bench.list_measured()
    bench.scenes.change(switching_frequency=40e3)
    after = bench.wait_until_idle()
    assert set(bench.list_measured()) == {"iso"}
    assert after["switching_frequency"] == before["switching_frequency"]
    assert after["iso"] != before["iso"]


def test_rates_are_measured_once_at_the_end_of_a_movement(bench: Bench) -> None:
    bench.controller.set_visible(True)
    bench.wait_until_idle()
    bench.list_measured()
    assert bench.list_outdated() == dict.fromkeys(NAMES, False)
    scenes = bench.scenes
    decoder = scenes.store.workspace.decoder
    earlier = RateRequest(scenes.scene, scenes.settings.settings, decoder)
    bench.scenes.change(switching_frequency=40e3)
    assert bench.list_outdated() == {"switching_frequency": False, "iso": True}
    # A result for an earlier request.
    bench.queue.channels[0].results_ready.emit(earlier, [StripPoints("iso", ())])
    assert bench.list_outdated()["iso"]
    bench.wait_until_idle()
    of_one = bench.list_measured()
    for frequency in (20e3, 25e3, 30e3):
        bench.scenes.change(switching_frequency=frequency)
    bench.wait_until_idle()
    assert bench.list_measured() == of_one != []
    assert bench.list_outdated() == dict.fromkeys(NAMES, False)


@pytest.fixture
def strips(qtbot: QtBot, small_scene: Scene) -> SliderStrips:
    """Show the strips of the controls."""
    controls = ControlsBench(qtbot, small_scene).controls
    strips = SliderStrips(controls.main_rows(), controls)
    controls.add_foot(strips.legend)
    QApplication.processEvents()
    return strips


def test_a_strip_is_as_long_as_the_path_of_the_handle(strips: SliderStrips) -> None:
    assert tuple(strips.strips) == main_of("code")
    for name, row in strips.rows.items():
        strip = strips.strips[name]
        for end, position in enumerate((row.slider.minimum(), row.slider.maximum())):
            row.slider.blockSignals(True)
            row.slider.setValue(position)
            assert strip.x() + strip.span()[end] == pytest.approx(handle_middle(row.slider), abs=1)
        assert row.slider.geometry().contains(strip.geometry())
        middle = strip.geometry().center().y()
        assert middle == pytest.approx(row.slider.geometry().center().y(), abs=1)
        assert row.children().index(strip) < row.children().index(row.slider)
        assert strip.height() == 6


def test_a_strip_has_the_colours_of_the_map_and_explains_itself(strips: SliderStrips) -> None:
    strip = strips.strips["iso"]
    strip.show_fractions((0.0, 0.5, None, 1.0))
    strip.show_present_rate(None)
    picture, (first, last) = strip.grab().toImage(), strip.span()
    expected = to_colours(np.array([[0.0, 50.0, 100.0]]), 0.0, 100.0, RATES)[0, :, :3].tolist()
    colours = []
    for fraction in (0.1, 0.35, 0.65, 0.9):
        colour = picture.pixelColor(round(first + fraction * (last - first)), 3)
        colours.append([colour.red(), colour.green(), colour.blue()])
    unknown = colours.pop(2)
    assert colours == expected
    assert unknown not in expected
    assert "read at 1 of 3" in strip.accessibleDescription()
    for strip in strips.strips.values():
        assert strip.accessibleName().startswith("Reading along ")
        assert "grey unknown" in strip.toolTip()


def test_an_outdated_strip_is_marked_at_once_and_fades_later(qtbot: QtBot) -> None:
    row = QuantityRow(quantity("iso"))
    strip = SliderStrip(row.slider, "ISO speed")
    for widget in (row, strip):
        qtbot.addWidget(widget)
    strip.resize(200, 6)
    strip.show_fractions((1.0,) * 5)
    before = strip.grab().toImage()
    strip.show_outdated(True)
    assert strip.accessibleDescription() == "earlier scene: read at 5 of 5 positions"
    assert "of an earlier scene" in strip.toolTip()
    assert strip.grab().toImage() == before
    qtbot.waitUntil(lambda: strip.grab().toImage() != before)
    strip.show_outdated(False)
    assert strip.grab().toImage() == before
    assert strip.accessibleDescription() == "read at 5 of 5 positions"


def test_the_legend_explains_the_colours_and_leaves_its_space_to_the_sliders(
    strips: SliderStrips,
) -> None:
    legend = strips.legend
    assert legend.accessibleName() == "Colours of the sliders"
    assert "read correctly" in legend.toolTip()
    assert legend.minimumSizeHint().height() == 0
    assert not legend.isHidden()
    strips.set_visible(False)
    assert legend.isHidden()
    legend.resize(legend.sizeHint())
    picture = legend.grab().toImage()
    middle = [picture.pixelColor(x, picture.height() // 2) for x in range(picture.width())]
    colours = {(colour.red(), colour.green(), colour.blue()) for colour in middle}
    ends = to_colours(np.array([[0.0], [1.0]]), 0.0, 1.0, RATES)[:, 0, :3]
    assert {tuple(end) for end in ends.tolist()} <= colours


def test_the_strips_begin_a_while_after_the_first_picture(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(wiring, "START_MS", 1)
    row = add_widget(qtbot, QuantityRow(quantity("iso")))
    strips, answers = SliderStrips({"iso": row}), list[bool]()

    def has_picture() -> bool:
        answers.append(len(answers) >= 2)
        return answers[-1]

    measuring = BackgroundRates(store_of(), strips, has_picture)
    strips.visibility_changed.emit(True)
    qtbot.waitUntil(lambda: measuring.queue.workers is not None)  # something is measured
    assert answers == [False, False, True, True]
    measuring.stop()
