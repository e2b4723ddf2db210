"""Films of a colour camera: their frames, their files, and the codes of three LEDs."""

from pathlib import Path

import numpy as np
import pytest

import occ_model as occ
from occ_model.scene.scene import Scene

CODES = {"red": "718", "green": "345", "blue": "201"}


def small(**changes: float | str) -> Scene:
    """Return a scene whose frames hold two packets, with crosstalk of 10 %."""
    scene = occ.load_preset("phone-68us-colour")
    return scene.replace(rows=240, panel_height=0.05, **changes)


@pytest.mark.parametrize("demosaicing", ["none", "bilinear"])
def test_a_film_keeps_its_colours_and_shows_three_codes(tmp_path: Path, demosaicing: str) -> None:
    scene = small(demosaicing=demosaicing)
    film = occ.render_video(scene, 3, settings=occ.SimulationSettings(seed=4))
    occ.write_video(film, tmp_path / "x.mkv")
    stored = occ.load_video(tmp_path / "x.mkv", channel="colours")
    assert stored.scene == scene
    assert stored.shape == (240, 3456)
    for frame, made in zip(stored, film, strict=True):
        assert np.array_equal(frame.image, made.image)
        assert made.scene is not None
        seen = occ.render_colour(made.scene, seed=film.seed_of(made.index))
        assert np.array_equal(made.image, seen.image)
    readings = occ.decode_colour_video(stored, scene, frequency_tolerance=1e-4)
    assert {colour: reading.payload for colour, reading in readings.items()} == CODES
    for colour, reading in readings.items():
        assert reading.clock is not None
        readout = reading.clock.readout_time
        step = 8e-6 if colour == "green" else 16e-6  # red and blue see every second column
        assert abs(readout.value - step) < 4.0 * readout.error < 1e-3 * step


def test_a_film_scanned_along_its_other_axis_is_turned_with_its_colours(tmp_path: Path) -> None:
    film = occ.render_video(small(columns=1200, panel_width=0.05), 1)
    image = film.frame(0).image

    class Turned(occ.Video):
        title, shape, frame_rate, frame_count = "Turned", image.shape[1::-1], 30.0, 1

        def frames(self, first: int = 0):  # type: ignore[no-untyped-def]
            yield self.frame(first)

        def frame(self, index: int) -> occ.VideoFrame:
            return occ.VideoFrame(index, 0.0, image.swapaxes(0, 1))

    for ending in (".mkv", ".png"):
        occ.write_video(Turned(), tmp_path / f"x{ending}")
        read = occ.load_video(tmp_path / f"x{ending}", channel="colours").frame(0).image
        assert np.array_equal(read, image)


@pytest.mark.parametrize("colour", ["red", "green", "blue"])
def test_a_film_of_one_led_keeps_the_phase_of_its_code_and_has_no_other_code(colour: str) -> None:
    scene = small(colour_light=colour)
    film = occ.render_video(scene, 400)
    late = film.frame(399)
    assert late.scene is not None
    assert late.start is not None
    lit = occ.on_time(scene.replace(start_time=float(late.start)).colour(colour))
    assert occ.on_time(late.scene.colour(colour)) == pytest.approx(lit, abs=1e-9)
    few = occ.render_video(scene, 3, settings=occ.SimulationSettings(seed=4))
    readings = occ.decode_colour_video(few, scene, frequency_tolerance=1e-4)
    assert {name: reading.payload for name, reading in readings.items()} == {colour: CODES["red"]}


def test_what_no_film_shows_in_three_colours_is_refused() -> None:
    with pytest.raises(occ.ParameterError, match="for a film"):
        occ.decode_colour_video(occ.render_video(small(), 1), small(colour_light="4-csk"))
    with pytest.raises(occ.ParameterError, match="a pattern such as rggb"):
        occ.decode_colour_video(occ.render_video(small(), 1), occ.load_preset("phone-68us"))
    with pytest.raises(occ.ParameterError, match="rows_step"):
        occ.render_video(small(), 1, rows_step=2)
    with pytest.raises(occ.ParameterError, match="monochrome camera"):
        occ.render_video(small(bayer="none"), 1)
