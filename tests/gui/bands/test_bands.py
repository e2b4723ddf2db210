"""The pane of the bars shows what the model counts, and sets speeds without bars."""

import numpy as np
import pytest
from gui.user import User
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.bands.bands_view import BandsView
from occ_gui.bands.jobs import EXPOSURES, shown_bands
from occ_model.scene.scene import Scene
from occ_model.study.bands.cure import as_bright, cure_of

_LAMP = occ.load_preset("phone-136us").replace(
    pattern="10", switching_frequency=3840.0, exposure_time=1 / 500
)


@pytest.fixture
def view(qtbot: QtBot) -> BandsView:
    view = BandsView()
    qtbot.addWidget(view)
    view.resize(900, 600)
    view.show()
    return view


def _rows(view: BandsView) -> dict[str, list[str]]:
    table = view.table
    model = table.model()
    cells = [
        [str(model.index(row, column).data()) for column in range(4)]
        for row in range(table.rowCount())
    ]
    return {row[0]: row[1:] for row in cells}


def test_the_pane_shows_the_depth_and_the_speeds_of_the_model(view: BandsView) -> None:
    view.show_bands(shown_bands(_LAMP))
    depth = occ.band_depth(_LAMP)
    assert f"{100 * depth.peak_to_peak:.3g} %" in view.headline.text()
    assert "whole multiples of 520.8 µs" in view.sentences.text()
    rows = _rows(view)
    assert rows["1/60 s"] == ["0 %", "0 %", "none"]
    assert rows["1/125 s"][2] == "none as power of two"
    assert rows["1/500 s"][2] == "yes"
    assert rows["1/1000 s"][2] == "yes"


def test_the_map_is_dark_along_the_valleys() -> None:
    found = shown_bands(_LAMP)
    shape = found.least.shape
    places = np.geomspace(500.0, 100e3, shape[0] + 1)
    for order in (1, 2, 3):
        middles = np.sqrt(places[:-1] * places[1:])
        exposures = order * found.period / middles
        share = np.log(exposures / EXPOSURES[0]) / np.log(EXPOSURES[1] / EXPOSURES[0])
        inside = (share > 0) & (share < 1)
        cells = (share[inside] * shape[1]).astype(int)
        assert found.least[np.flatnonzero(inside), cells].max() < 1e-9
    assert found.least[:, 0].max() > 0.5


def test_a_speed_that_is_taken_becomes_the_exposure_at_the_same_brightness(
    application: Application, user: User, qtbot: QtBot
) -> None:
    application.store.put(_LAMP.replace(exposure_time=136e-6), "lamp")
    application.window.bring_to_front("bands")
    qtbot.waitUntil(lambda: application.shell.made_pane("bands") is not None)
    pane = application.shell.pane("bands")
    qtbot.waitUntil(lambda: pane.is_idle and pane.view.table.rowCount() > 0)
    assert pane.view.headline.text().startswith("Bars of")
    row = list(_rows(pane.view)).index("1/60 s")
    pane.view.table.itemActivated.emit(pane.view.table.item(row, 0))
    assert application.store.scene.camera.exposure_time == pytest.approx(1 / 60)
    qtbot.waitUntil(lambda: pane.view.headline.text().startswith("No bars"))
    user.wait_until_idle()
    application.store.undo_stack.undo()
    assert application.store.scene.camera.exposure_time == pytest.approx(136e-6)


@pytest.mark.parametrize("exposure", [1 / 60, 1 / 8000, 1e-5])
def test_brightness_is_kept_by_speed_and_aperture(exposure: float) -> None:
    def gain(scene: Scene) -> float:
        camera = scene.camera
        return camera.iso * camera.exposure_time / camera.f_number**2

    assert gain(as_bright(_LAMP, exposure)) == pytest.approx(gain(_LAMP))


def test_the_cure_of_a_lamp_of_1920_hz_shows_no_bars() -> None:
    cure = cure_of(_LAMP)
    assert cure.repeats == pytest.approx(1920.0)
    assert [speed.name for speed in cure.speeds] == ["1/640 s", "1/320 s"]
    assert [speed.name for speed in cure.kept] == ["1/240 s", "1/120 s"]
    assert occ.band_depth(cure.scene).peak_to_peak < 1e-9
    assert not occ.band_depth(cure.scene).is_visible
