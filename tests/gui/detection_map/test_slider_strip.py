"""Behind each main slider lies what a decoder would read along it, in line with its handle."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gui.stores import store_of
from gui.user import User
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QApplication, QSlider, QStyle, QStyleOptionSlider
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.background.signals import WorkQueue
from occ_gui.detection_map import slider_strip_controller as module
from occ_gui.detection_map import wiring
from occ_gui.detection_map.colour_map import RATES, to_colours
from occ_gui.detection_map.rate_map import lattice
from occ_gui.detection_map.slider_strip import IMAGES, SliderStrip
from occ_gui.detection_map.slider_strip_controller import SliderStripController
from occ_gui.detection_map.strip_legend import StripLegend
from occ_gui.files.preferences import Preferences
from occ_gui.scene.control_panel import MAIN
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

POSITIONS = 9
NAMES = ("switching_frequency", "iso")
Shares = tuple[float | None, ...]


class RecordingStrips:
    """Strips that keep what they show."""

    def __init__(self) -> None:
        self.shares: dict[str, Shares] = {}
        self.outdated: dict[str, bool] = {}

    def show_shares(self, name: str, shares: Shares) -> None:
        self.shares[name] = shares

    def show_outdated(self, name: str, outdated: bool) -> None:
        self.outdated[name] = outdated


class Bench:
    """A controller of few positions whose workers need no processes."""

    def __init__(self, qtbot: QtBot, scene: Scene, workers: Any) -> None:
        self._qtbot = qtbot
        self.workers, self.strips = workers, RecordingStrips()
        self.queue = WorkQueue(1, lambda: workers)
        self.scenes = store_of(scene)
        self.controller = SliderStripController(
            self.scenes, self.scenes.settings, self.queue.channels[0], self.strips, NAMES
        )

    def wait_until_idle(self) -> dict[str, Shares]:
        self._qtbot.waitUntil(lambda: self.controller.is_idle)
        return dict(self.strips.shares)

    def measured(self) -> list[str]:
        """Name the sliders along which was measured, and forget it."""
        names = [str(job.arguments[2]) for job in self.workers.jobs]
        self.workers.jobs.clear()
        return names


@pytest.fixture
def bench(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch, inline_workers: Any
) -> Iterator[Bench]:
    monkeypatch.setattr(module, "POSITIONS", POSITIONS)
    bench = Bench(qtbot, small_scene, inline_workers)
    yield bench
    bench.queue.stop()


@pytest.mark.parametrize("decoder", ["threshold", "matched"])
def test_a_strip_is_the_success_rate_along_its_slider(bench: Bench, decoder: str) -> None:
    store = bench.scenes.store
    store.put(replace(store.workspace, decoder=decoder))
    bench.controller.set_seen(True)
    shares = bench.wait_until_idle()
    scene = bench.scenes.scene
    for name in NAMES:
        rates = [
            occ.success_rate(scene.replace(**{name: value}), IMAGES, decoder)
            for value in lattice(name, POSITIONS)
        ]
        assert shares[name] == pytest.approx([rate / 100 for rate in rates])


def test_nothing_is_measured_while_the_strips_are_not_seen(bench: Bench, qtbot: QtBot) -> None:
    bench.scenes.change(exposure_time=136e-6)
    qtbot.wait(30)
    assert bench.measured() == []
    bench.controller.set_seen(True)
    bench.wait_until_idle()
    assert set(bench.measured()) == set(NAMES)
    bench.controller.set_seen(False)
    bench.scenes.change(exposure_time=68e-6)
    qtbot.wait(30)
    assert bench.measured() == []


def test_moving_a_slider_leaves_its_own_strip_as_it_is(bench: Bench) -> None:
    bench.controller.set_seen(True)
    before = bench.wait_until_idle()
    bench.measured()
    bench.scenes.change(switching_frequency=40e3)
    after = bench.wait_until_idle()
    assert set(bench.measured()) == {"iso"}
    assert after["switching_frequency"] == before["switching_frequency"]
    assert after["iso"] != before["iso"]


def test_a_movement_is_measured_once_where_it_ends(bench: Bench) -> None:
    bench.controller.set_seen(True)
    bench.wait_until_idle()
    bench.measured()
    bench.scenes.change(switching_frequency=40e3)
    bench.wait_until_idle()
    of_one = bench.measured()
    for frequency in (20e3, 25e3, 30e3):
        bench.scenes.change(switching_frequency=frequency)
    bench.wait_until_idle()
    assert bench.measured() == of_one != []
    assert bench.strips.outdated == dict.fromkeys(NAMES, False)


def test_a_scene_that_the_model_refuses_is_unknown(bench: Bench) -> None:
    bench.scenes.change(pattern="10")
    bench.controller.set_seen(True)
    assert set(bench.wait_until_idle()["iso"]) == {None}


def handle_middle(slider: QSlider) -> float:
    option = QStyleOptionSlider()
    slider.initStyleOption(option)
    control, part = QStyle.ComplexControl.CC_Slider, QStyle.SubControl.SC_SliderHandle
    handle = slider.style().subControlRect(control, option, part, slider)
    return float(slider.x() + handle.x() + handle.width() / 2)


def test_a_strip_begins_and_ends_where_the_handle_does(application: Application) -> None:
    strips = application.slider_strips.strips
    assert tuple(strips) == MAIN
    for name, row in application.controls.main_rows().items():
        strip = strips[name]
        for end, position in enumerate((row.slider.minimum(), row.slider.maximum())):
            row.slider.blockSignals(True)
            row.slider.setValue(position)
            assert strip.x() + strip.span()[end] == pytest.approx(handle_middle(row.slider), abs=1)
        assert row.slider.geometry().contains(strip.geometry())
        middle = strip.geometry().center().y()
        assert middle == pytest.approx(row.slider.geometry().center().y(), abs=1)
        assert row.children().index(strip) < row.children().index(row.slider)
        assert strip.height() == 6


def test_good_bad_and_unknown_positions_look_different(
    application: Application, grey_picture: Callable[..., Any]
) -> None:
    strip = application.slider_strips.strips["iso"]
    strip.show_shares((0.0, 0.0, None, 1.0, 1.0))
    first, last = strip.span()
    row = grey_picture(strip)[3].astype(int)
    places = [round(first + share * (last - first)) for share in (0.05, 0.5, 0.95)]
    bad, unknown, good = (int(row[place]) for place in places)
    assert len({bad, unknown, good}) == 3
    assert "read at 2 of 4" in strip.accessibleDescription()


def test_every_strip_says_what_it_is(application: Application) -> None:
    for strip in application.slider_strips.strips.values():
        assert strip.accessibleName().startswith("Reading along ")
        assert "grey not known" in strip.toolTip()


def test_the_view_menu_hides_the_strips_and_it_is_remembered(
    qtbot: QtBot, small_scene: Scene, tmp_path: Path
) -> None:
    def settings() -> QSettings:
        return QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)

    kept = settings()
    application = Application(small_scene, preferences=kept)
    application.window.show()
    strips = application.slider_strips.strips.values()
    assert all(strip.isVisible() for strip in strips)
    application.window.actions_by_name["slider_strips"].trigger()
    QApplication.processEvents()
    assert not any(strip.isVisible() for strip in strips)
    assert application.measuring.slider_strips.is_idle
    application.window.close()
    application.window.deleteLater()
    kept.sync()
    assert not Preferences(settings()).slider_strips
    assert Preferences(None).slider_strips


def test_the_colours_of_a_strip_are_the_maps(application: Application) -> None:
    strip = application.slider_strips.strips["iso"]
    strip.show_shares((0.0, 0.5, 1.0))
    strip.show_present(None)
    picture, (first, last) = strip.grab().toImage(), strip.span()
    wanted = to_colours(np.array([[0.0, 50.0, 100.0]]), 0.0, 100.0, RATES)[0, :, :3]
    for share, colour in zip((0.1, 0.5, 0.9), wanted.tolist(), strict=True):
        place = round(first + share * (last - first))
        seen = picture.pixelColor(place, 3)
        assert [seen.red(), seen.green(), seen.blue()] == colour


def colour_at(strip: SliderStrip, place: float) -> list[int]:
    seen = strip.grab().toImage().pixelColor(round(place), 3)
    return [seen.red(), seen.green(), seen.blue()]


@pytest.fixture
def workers(monkeypatch: pytest.MonkeyPatch, inline_workers: Any) -> None:
    """Have workers of the window, whichever of its parts begins to measure first."""
    monkeypatch.setattr(wiring, "new_workers", lambda: inline_workers)


@pytest.mark.own_window
def test_strip_and_banner_state_the_rate_of_the_study(
    workers: None, application: Application, user: User, qtbot: QtBot
) -> None:
    """At the handle as anywhere: the picture shown is another fact, which the banner states."""
    application.store.put(
        application.store.scene.replace(rows=300, switching_frequency=3.4e3), "an edge"
    )
    user.wait_until_idle()
    scene, strips = application.store.scene, application.slider_strips.strips
    own = application.measuring.own_rate
    qtbot.waitUntil(lambda: own.rate is not None)
    rate = occ.success_rate(scene, 20)
    assert 5.0 < rate < 99.0
    assert {round(100.0 * s.present.share, 9) for s in strips.values() if s.present} == {rate}
    shown = {chip.key: chip.text for chip in application.story.verdict.chips.chips}
    assert shown["rate"] == f"of 20 pictures: {rate:.3g} %"
    strip = strips["iso"]
    assert f"{rate:.3g} % of 20 pictures" in strip.toolTip()
    strip.show_shares((0.0,) * POSITIONS)
    wanted = to_colours(np.array([[rate]]), 0.0, 100.0, RATES)[0, 0, :3].tolist()
    assert colour_at(strip, handle_middle(strip._slider) - strip.x() + 9) == wanted
    application.store.change(switching_frequency=14e3)
    assert {s.present for s in strips.values()} == {None}


def test_strips_of_an_earlier_scene_are_marked_until_measured(bench: Bench) -> None:
    bench.controller.set_seen(True)
    bench.wait_until_idle()
    assert bench.strips.outdated == dict.fromkeys(NAMES, False)
    bench.scenes.change(switching_frequency=40e3)
    assert bench.strips.outdated == {"switching_frequency": False, "iso": True}
    bench.wait_until_idle()
    assert bench.strips.outdated == dict.fromkeys(NAMES, False)


def test_an_outdated_strip_says_so_at_once_and_fades_later(qtbot: QtBot) -> None:
    row = QuantityRow(quantity("iso"))
    strip = SliderStrip(row.slider, "ISO speed")
    for widget in (row, strip):
        qtbot.addWidget(widget)
    strip.resize(200, 6)
    strip.show_shares((1.0,) * 5)
    shown = strip.grab().toImage()
    strip.show_outdated(True)
    assert strip.accessibleDescription() == "earlier scene: read at 5 of 5 positions"
    assert "of an earlier scene" in strip.toolTip()
    assert strip.grab().toImage() == shown
    qtbot.waitUntil(lambda: strip.grab().toImage() != shown)
    strip.show_outdated(False)
    assert strip.grab().toImage() == shown
    assert strip.accessibleDescription() == "read at 5 of 5 positions"


def test_the_legend_says_what_the_colours_mean_and_gives_way_to_the_sliders(
    application: Application,
) -> None:
    legend = application.slider_strips.legend
    assert legend.accessibleName() == "Colours of the sliders"
    assert "read correctly" in legend.toolTip()
    assert legend.minimumSizeHint().height() == 0
    assert not legend.isHidden()
    application.window.actions_by_name["slider_strips"].trigger()
    assert legend.isHidden()


def test_new_shares_are_painted_at_once(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    slider = QSlider()
    strip = SliderStrip(slider, "Frequency")
    qtbot.addWidget(strip)
    qtbot.addWidget(slider)
    strip.resize(200, 12)
    strip.show()
    QApplication.processEvents()
    painted: list[int] = []
    monkeypatch.setattr(strip, "paintEvent", lambda _event: painted.append(1))
    strip.setToolTip("")
    QApplication.processEvents()
    assert not painted
    strip.show_shares((0.0, 0.5, 1.0))
    QApplication.processEvents()
    assert painted


def test_the_legend_shows_the_colours_from_misread_to_read(qtbot: QtBot) -> None:
    legend = StripLegend()
    qtbot.addWidget(legend)
    legend.resize(legend.sizeHint())
    picture = legend.grab().toImage()
    middle = [picture.pixelColor(x, picture.height() // 2) for x in range(picture.width())]
    seen = {(colour.red(), colour.green(), colour.blue()) for colour in middle}
    ends = to_colours(np.array([[0.0], [1.0]]), 0.0, 1.0, RATES)[:, 0, :3]
    assert {tuple(end) for end in ends.tolist()} <= seen
