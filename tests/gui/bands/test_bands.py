"""The pane of the bars shows what the model counts, and sets speeds without bars."""

from functools import cache
from pathlib import Path
from threading import Event

import numpy as np
import pytest
from gui.kinds import show_widget
from gui.pane_bench import PaneBench
from gui.user import PATIENCE_S
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractSpinBox
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.panes import bands
from occ_gui.bands import pane
from occ_gui.bands.bands_view import BandsView
from occ_gui.bands.jobs import SceneBars, compute_bars
from occ_gui.widgets.outdated_mark import DELAY
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import as_bright, cure_of

_LAMP = occ.load_preset("phone-136us").replace(
    pattern="10", switching_frequency=3840.0, exposure_time=1 / 500
)


@cache
def _bars_of(scene: Scene) -> SceneBars:
    return compute_bars(scene)


@pytest.fixture
def view(qtbot: QtBot) -> BandsView:
    return show_widget(qtbot, BandsView(), 900, 600)


def _rows(view: BandsView) -> dict[str, list[str]]:
    table = view.table
    model = table.model()
    cells = [
        [str(model.index(row, column).data()) for column in range(4)]
        for row in range(table.rowCount())
    ]
    return {row[0]: row[1:] for row in cells}


def test_the_pane_shows_the_depth_and_the_speeds_of_the_model(view: BandsView) -> None:
    view.show_bands(_bars_of(_LAMP))
    depth = occ.band_depth(_LAMP)
    assert f"{100 * depth.peak_to_peak:.3g} %" in view.scene_answer.line.text()
    assert depth.is_visible
    assert depth.sentence in view.scene_answer.details.text()
    assert "whole multiples of 520.8 µs" in view.scene_answer.details.text()
    rows = _rows(view)
    assert rows["1/60 s"] == ["0 %", "0 %", "none"]
    assert rows["1/125 s"][2] == "depends"
    assert rows["1/500 s"][2] == "yes"
    assert rows["1/1000 s"][2] == "yes"
    view.show_bands(_bars_of(_LAMP.replace(exposure_time=1 / 1920)))
    assert "Not visible on a display" in view.scene_answer.details.text()


@pytest.mark.parametrize(
    ("changes", "why"),
    [({"exposure_time": 1e-3, "iso": 4e6}, "overexposed"),
     ({"exposure_time": 1e-4, "readout_time": 1 / 1920}, "the same phase")],
)  # fmt: skip
def test_bars_that_the_picture_hides_are_not_headlined_as_seen(
    view: BandsView, changes: dict[str, float], why: str
) -> None:
    view.show_bands(_bars_of(_LAMP.replace(**changes)))
    assert ", not visible: " in view.scene_answer.line.text()
    assert why in view.scene_answer.line.text()
    assert why in view.scene_answer.details.text()


def test_a_lamp_without_light_has_no_valleys(view: BandsView) -> None:
    view.show_bands(_bars_of(_LAMP.replace(luminance=0.0)))
    assert not any(line.isVisible() for line in view.map.valleys)
    assert "Nothing blinks" in view.scene_answer.details.text()
    assert "No exposure of" not in view.scene_answer.details.text()


def test_the_map_is_dark_along_the_valleys_which_are_marked(view: BandsView) -> None:
    found = _bars_of(_LAMP)
    depths = found.map
    view.show_bands(found)
    for order in (1, 2, 3):
        middles = np.sqrt(depths.frequencies[:-1] * depths.frequencies[1:])
        exposures = order * depths.period / middles
        marked = np.interp(np.log10(middles), *view.map.valleys[order - 1].getData())
        assert marked == pytest.approx(np.log10(exposures))
        cells = np.searchsorted(depths.exposures, exposures) - 1
        inside = (cells >= 0) & (cells < depths.least.shape[1])
        assert inside.any()
        assert depths.least[np.flatnonzero(inside), cells[inside]].max() < 1e-9
        assert view.map.image.image[np.flatnonzero(inside), cells[inside]].max() == 0.0
    assert depths.least[:, 0].max() > 0.99
    assert view.map.image.image.max() > 254.0


@pytest.fixture
def bench(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> PaneBench:
    monkeypatch.setattr(pane, "compute_bars", _bars_of)
    return PaneBench(qtbot, _LAMP.replace(exposure_time=136e-6))


def test_a_speed_that_is_taken_becomes_the_exposure_at_the_same_brightness(
    bench: PaneBench, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    was_marked = Event()

    def shown_late(scene: Scene) -> SceneBars:
        assert was_marked.wait(PATIENCE_S)
        return _bars_of(scene)

    view, scenes = bench.add(bands(bench.scenes)).view, bench.scenes
    bench.wait_until_idle()
    assert view.scene_answer.line.text().startswith("Bars of")
    row = list(_rows(view)).index("1/60 s")
    monkeypatch.setattr(pane, "compute_bars", shown_late)
    view.table.itemActivated.emit(view.table.item(row, 0))
    assert scenes.scene.camera.exposure_time == pytest.approx(1 / 60)
    assert view.outdated.isHidden()
    qtbot.waitUntil(view.outdated.isVisible)
    was_marked.set()
    qtbot.waitUntil(lambda: view.scene_answer.line.text().startswith("No bars"))
    assert view.outdated.isHidden()
    scenes.undo_stack.undo()
    assert scenes.scene.camera.exposure_time == pytest.approx(136e-6)
    bench.wait_until_idle()
    scenes.settings.set_tolerance(3.0)  # which the bars do not depend on
    qtbot.wait(round(1e3 * DELAY))
    assert view.outdated.isHidden()


def _type(field: QAbstractSpinBox, text: str) -> None:
    field.lineEdit().selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def test_my_lamp_s_bars_are_answered_in_one_line_and_shown_in_the_scene_if_wanted(
    bench: PaneBench,
) -> None:
    view, scenes, before = bench.add(bands(bench.scenes)).view, bench.scenes, bench.scenes.scene
    form, answer = view.lamp.form, view.lamp.answer
    bench.wait_until_idle()
    assert answer.line.text() == (
        "Use 1/50 or 1/100 s: no bars. At 1/125 s they are 14 % of the mean light from "
        "dark to bright."
    )
    assert not form.fields["lamp_frequency"].isVisible()
    form.lamp.show_key("dimmed")
    form.lamp.chosen.emit("dimmed")
    _type(form.fields["lamp_frequency"], "240 Hz")
    _type(form.fields["duty"], "30")
    _type(form.fields["exposure_time"], "1/100")
    form.knows_readout.click()
    bench.wait_until_idle()
    assert answer.line.text() == (
        "Use 1/48 or 1/120 s: no bars. At 1/100 s they are 41.7 % of the mean light from "
        "dark to bright, 347 lines from bar to bar."
    )
    assert scenes.scene == before
    assert not answer.details.isVisible()
    answer.more.click()
    assert answer.details.isVisible()
    assert "whole multiples of 4.167 ms" in answer.details.text()
    form.show_button.click()
    sent, camera = scenes.scene.transmitter, scenes.scene.camera
    assert (sent.light, sent.lamp_frequency, sent.duty) == ("lamp", 240.0, pytest.approx(0.3))
    assert (camera.exposure_time, camera.readout_time) == (0.01, 12e-6)
    bench.wait_until_idle()
    assert view.scene_answer.line.text().startswith("Bars of")
    scenes.undo_stack.undo()
    assert scenes.scene == before


def test_a_panel_lit_row_by_row_shows_how_many_rows_are_dark(bench: PaneBench) -> None:
    view = bench.add(bands(bench.scenes)).view
    view.lamp.form.lamp.show_key("rows")
    view.lamp.form.lamp.chosen.emit("rows")
    _type(view.lamp.form.fields["exposure_time"], "1/1000 s")
    _type(view.lamp.form.fields["lamp_frequency"], "60")
    bench.wait_until_idle()
    assert "87.7 % of them are dark in one picture" in view.lamp.answer.details.text()
    _type(view.lamp.form.rows, "4")
    bench.wait_until_idle()
    assert "69 % of them are dark" in view.lamp.answer.details.text()


def test_the_chart_shows_each_sine_beside_the_lines(view: BandsView) -> None:
    view.show_bands(compute_bars(_LAMP.replace(pattern="1110", switching_frequency=800.0)))
    at, modulations = view.risk.sines.getData()
    assert 10.0 ** at[0] == pytest.approx(200.0)
    # The first sine of a pulse of duty D has 2 sin(pi D) / (pi D) of its mean.
    assert 10.0 ** modulations[0] == pytest.approx(200.0 * np.sin(0.75 * np.pi) / (0.75 * np.pi))
    places, limits = view.risk.low_risk.getData()
    assert np.interp(np.log10(200.0), places, limits) == pytest.approx(np.log10(16.0))
    assert np.interp(np.log10(50.0), places, limits) == pytest.approx(np.log10(1.25))
    assert "not checked" in view.risk.source.text()


def test_both_figures_are_exported_of_the_scene(bench: PaneBench, tmp_path: Path) -> None:
    bench.shell.add(bands(bench.scenes), bench.window)
    bench.simulate(exposure_time=1 / 500)
    for name in ("bands", "flicker"):
        bench.export(name, tmp_path / f"{name}.csv")
    rows = [
        line.split(",") for line in (tmp_path / "flicker.csv").read_text().splitlines()
        if line[0] != "#"
    ]  # fmt: skip
    part, *numbers, low_risk = rows[1]
    assert (part, low_risk) == ("whole", "")  # which ends at 1250 Hz
    assert [float(number) for number in numbers] == pytest.approx([1920.0, 100.0, 63.936])
    cells = [
        [float(cell) for cell in line.split(",")]
        for line in (tmp_path / "bands.csv").read_text().splitlines() if line[0].isdigit()
    ]  # fmt: skip
    assert len(cells) == 120 * 120
    frequency, low, high, least = max(cells, key=lambda row: row[3] - 1e3 * row[1])
    scene = _LAMP.replace(switching_frequency=2.0 * frequency)
    middle = occ.band_depth(scene.replace(exposure_time=(low * high) ** 0.5)).peak_to_peak
    assert least * (1.0 - 1e-12) <= 100.0 * middle < 1.1 * least


@pytest.mark.parametrize("exposure", [1 / 60, 1 / 8000, 1e-5])
def test_brightness_is_kept_by_speed_and_aperture(exposure: float) -> None:
    def gain(scene: Scene) -> float:
        camera = scene.camera
        return camera.iso * camera.exposure_time / camera.f_number**2

    assert gain(as_bright(_LAMP, exposure)) == pytest.approx(gain(_LAMP))


def test_the_cure_of_a_lamp_of_1920_hz_shows_no_bars() -> None:
    cure = cure_of(_LAMP)
    assert cure.repetition_rate == pytest.approx(1920.0)
    assert [speed.name for speed in cure.speeds] == ["1/640 s", "1/320 s"]
    assert [speed.name for speed in cure.safe_speeds] == ["1/240 s", "1/120 s"]
    assert occ.band_depth(cure.scene).peak_to_peak < 1e-9
    assert not occ.band_depth(cure.scene).is_visible
