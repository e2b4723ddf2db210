"""The pane of three colours: verdicts in one line, stripes in colour, and what it refuses."""

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.colour.colour_view import ColourStrip, reasons_of, verdict_of
from occ_gui.colour.pane import ColourPane
from occ_model.results.colour import ColourReading
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene, SimulationSettings


def small(**changes: float | str) -> Scene:
    return occ.load_preset("phone-68us-colour").replace(rows=200, panel_height=0.05, **changes)


@pytest.fixture
def pane(qtbot: QtBot) -> ColourPane:
    pane = ColourPane()
    qtbot.addWidget(pane.view)
    return pane


def ask(pane: ColourPane, qtbot: QtBot, scene: Scene) -> None:
    pane.show_part((scene, SimulationSettings(), "threshold"))
    qtbot.waitUntil(lambda: pane.is_idle)


def test_a_scene_of_three_codes_shows_three_verdicts_and_profiles(
    pane: ColourPane, qtbot: QtBot
) -> None:
    ask(pane, qtbot, small())
    view = pane.view
    assert view.verdict.text() == "✓ red 718   ✓ green 345   ✓ blue 201"
    assert view.sentence.isHidden()
    frame = occ.render_colour(small())
    for curve, means in zip(view.curves, frame.profiles, strict=True):
        columns, levels = curve.getData()
        assert levels == pytest.approx(means[columns.astype(int)])
        assert np.ptp(levels) > 20
    pane.stop()


def test_a_raw_mosaic_has_half_the_columns_of_red_and_blue(pane: ColourPane, qtbot: QtBot) -> None:
    ask(pane, qtbot, small(demosaicing="none"))
    red, green, blue = (len(curve.getData()[0]) for curve in pane.view.curves)
    assert abs(green - 2 * red) <= 1
    assert abs(red - blue) <= 1
    pane.stop()


@pytest.mark.parametrize(
    "changes", [{"bayer": "none", "colour_light": "white"}, {"averaging": "pixel-value"}]
)
def test_a_scene_without_colours_says_why(
    pane: ColourPane, qtbot: QtBot, changes: dict[str, str]
) -> None:
    ask(pane, qtbot, small())
    ask(pane, qtbot, small(**changes))
    assert pane.view.verdict.text() == ""
    assert not pane.view.sentence.isHidden()
    assert "monochrome" in pane.view.sentence.text() or "Averaging" in pane.view.sentence.text()
    pane.stop()


def test_each_pixel_of_the_strip_shows_the_mean_of_those_it_covers(qtbot: QtBot) -> None:
    strip = ColourStrip()
    qtbot.addWidget(strip)
    strip.resize(40, strip.height())
    pixels = np.zeros((20, 400, 3), np.uint8)
    pixels[:, ::2, 0] = 200  # finer than the screen
    strip.show_pixels(pixels)
    grabbed = strip.grab().toImage()
    reds = {grabbed.pixelColor(x, 10).red() for x in range(1, 39)}
    assert reds <= {99, 100, 101}


def test_each_reason_is_stated_once() -> None:
    failed = DecodeResult("threshold", failure="No header.")
    right = DecodeResult("threshold", code=5)
    reading = ColourReading((failed, right, failed), None)
    assert verdict_of(reading) == "✗ red not read   ✓ green 5   ✗ blue not read"
    assert reasons_of(reading) == "Red, blue: No header."


def test_a_payload_may_have_commas() -> None:
    reading = ColourReading((DecodeResult("csk", payload="one, two"),), None)
    assert verdict_of(reading) == "✓ colours one, two"
