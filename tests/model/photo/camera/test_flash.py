"""A camera is measured by the band of one flash, or it is said why not."""

from dataclasses import replace

import numpy as np
import pytest
from amount import amount
from photo_world.flashes import flash_picture
from simulated_photos import photo_of

import occ_model as occ

READOUT, FLASH = 20e-6, 2e-3
"""Times in seconds: of a line, and of a flash of 100 lines."""


def band(exposure: float, first: float = 120.0, count: int = 400) -> np.ndarray:
    """Return the light of lines that a flash begins to reach at one of them, and gamma 2.2."""
    line = np.arange(count)
    begin = first * READOUT + exposure
    shared = np.minimum(line * READOUT + exposure, begin + FLASH) - np.maximum(
        line * READOUT, begin
    )
    light = 0.02 + 0.6 * np.maximum(shared, 0.0) / min(exposure, FLASH)
    return np.asarray(255.0 * light ** (1 / 2.2))


def photo(levels: np.ndarray, noted: float | None) -> occ.Photo:
    image = np.repeat(np.rint(levels)[None, :], 40, axis=0).astype(np.uint8)
    return replace(photo_of(image), exposure_time=noted)


@pytest.mark.parametrize("exposure", [0.5e-3, 1.3e-3, 2.8e-3])
def test_the_flash_and_the_exposure_have_their_lines(exposure: float) -> None:
    measured = occ.measure_flash(photo(band(exposure), exposure), FLASH)
    assert measured.verdict == "sure"
    assert measured.readout_time == pytest.approx(READOUT, rel=0.01)
    assert measured.exposure_time == pytest.approx(exposure, rel=0.02)
    assert measured.frame_readout_time == 400 * measured.readout_time


def test_without_a_note_both_readings_are_stated_and_doubted() -> None:
    measured = occ.measure_flash(photo(band(0.5e-3), None), FLASH)
    assert measured.verdict == "doubtful"
    assert measured.readout_time == pytest.approx(READOUT, rel=0.01)
    assert measured.other_readout_time == pytest.approx(READOUT * FLASH / 0.5e-3, rel=0.02)


def test_an_exposure_as_long_as_the_flash_is_doubtful() -> None:
    measured = occ.measure_flash(photo(band(1.9e-3), 1.9e-3), FLASH)
    assert "about as long" in " ".join(measured.reasons)


@pytest.mark.parametrize(
    ("levels", "said"),
    [
        (np.full(400, 40.0), "No band of a flash"),
        (np.where(np.arange(400) % 100 < 40, 200.0, 20.0), "4 bright bands"),
        (band(1e-3, first=330.0), "is cut"),
        (np.where(np.arange(400) < 150, 20.0, 200.0), "is cut"),
    ],
    ids=["flat", "lamp", "cut", "step"],
)
def test_what_is_no_flash_is_refused_with_the_reason(levels: np.ndarray, said: str) -> None:
    with pytest.raises(occ.MatchError, match=said):
        occ.measure_flash(photo(levels, 1e-3), FLASH)


def test_a_band_that_fades_is_doubted() -> None:
    levels = np.interp(np.arange(400), [100, 101, 300], [20, 200, 20])
    measured = occ.measure_flash(photo(levels, 1e-3), FLASH)
    assert "The band's shape differs" in measured.reasons[0]


def test_stated_errors_hold_in_pictures_of_another_world() -> None:
    """Walls with texture, unknown tone curves, noise and JPEG."""
    off = []
    for seed in range(9000, 9000 + amount(12, 60)):
        picture = flash_picture(seed)
        turned = photo_of(np.ascontiguousarray(picture.image.T))
        found = occ.measure_flash(replace(turned, exposure_time=picture.exposure), picture.flash)
        error = found.uncertainties["readout_time"]
        off.append(abs(found.readout_time - picture.readout_time) / error)
        assert found.readout_time == pytest.approx(picture.readout_time, rel=0.08)
    assert np.median(off) < 1.5
    assert np.median(off) > 0.2
