"""What the receiver must read, and what it must say if it cannot."""

from pathlib import Path

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import bits_of


@pytest.fixture(scope="module")
def covering_scene() -> Scene:
    """Place the phone at 10 kHz and 68 us so close that the panel fills the picture."""
    # Fewer rows than the phone has, as all rows of the panel are the same.
    scene = occ.load_preset("phone-68us")
    return scene.replace(distance=0.1, rows=16, switching_frequency=10e3)


@pytest.mark.parametrize(
    ("bits", "frequency", "exposure"),
    [(10, 10e3, 68e-6), (10, 10e3, 136e-6), *((bits, 12e3, 68e-6) for bits in (2, 3, 5, 16))],
)
def test_codes_are_read_from_their_own_picture(
    covering_scene: Scene, bits: int, frequency: float, exposure: float
) -> None:
    """Also with an exposure of 1.4 chips."""
    codes = amount(35, 146) if bits == 10 else amount(8, 32)
    for code in range(0, 2**bits, max(1, 2**bits // codes)):
        scene = covering_scene.replace(
            bits=bits, code=code, switching_frequency=frequency, exposure_time=exposure
        )
        result = occ.decode(occ.render(scene).image, scene)
        assert (result.code, result.failure) == (code, None)
        assert result.bits.tolist() == list(bits_of(code, bits))


@pytest.mark.parametrize("bits", range(2, 10))
def test_other_code_lengths_are_read_beyond_the_period(covering_scene: Scene, bits: int) -> None:
    # These two codes differ only by the place of a single 1. A third of their equalized pictures is
    # white, Otsu's threshold lies just below white, and the single 1 is lost.
    unreadable = {1, 2} if bits == 2 else set()
    codes = {*range(0, 2**bits, max(1, 2**bits // amount(6, 128))), 2**bits - 1}
    for code in sorted(codes - unreadable):
        scene = covering_scene.replace(bits=bits, code=code, exposure_time=136e-6)
        result = occ.decode(occ.render(scene).signal, scene)
        assert (result.code, result.failure) == (code, None)


@pytest.mark.parametrize("bits", [3, 5, 7, 9, 11, 13])
def test_a_packet_without_single_zeros_is_read_from_any_start(
    covering_scene: Scene, bits: int
) -> None:
    all_ones = covering_scene.replace(bits=bits, code=2**bits - 1, exposure_time=136e-6)
    for start in np.linspace(0.0, 3e-3, amount(6, 50)):
        scene = all_ones.replace(start_time=float(start))
        assert occ.decode(occ.render(scene).signal, scene).code == 2**bits - 1


def test_every_step_is_in_the_result(covering_scene: Scene) -> None:
    scene = covering_scene.replace(start_time=0.0)
    result = occ.decode(occ.render(scene).image, scene)
    assert result.signal.shape == (result.region.columns,)
    assert result.runs.lengths.sum() == result.region.columns
    assert result.chip_length == pytest.approx(100 / 8, rel=0.01)
    assert result.chip_starts.shape == result.chips.shape
    assert np.diff(result.headers).tolist() == [24] * (len(result.headers) - 1)


def test_too_few_chips_say_how_many_fit_and_what_helps() -> None:
    scene = occ.load_preset("phone-68us").replace(switching_frequency=4e3, distance=2.0, rows=64)
    # Start after a header, so that only one whole header is in the picture.
    failure = occ.decode(occ.render(scene.replace(start_time=2e-3)).image, scene).failure
    assert "two needed" in failure
    assert "of 48 chips fit" in failure
    assert "come closer" in failure


def failure_of(scene: Scene, columns: int, decoder: str = "threshold") -> str:
    """Read a part of a bright signal, whose stripes no longer show a header."""
    signal = np.where(np.arange(columns) % 40 < 2, 100.0, 255.0)
    return occ.decode(signal, scene, decoder).failure or ""


def test_too_few_chips_are_stated_only_if_true_and_only_helpful_advice_is_given() -> None:
    scene = occ.load_preset("phone-136us")  # 12.5 columns a chip, 48 chips take 600
    assert "chips fit" not in failure_of(scene, 700)
    both = "47 of 48 chips fit the panel's image; come closer or raise the frequency."
    assert failure_of(scene, 590).endswith(both)
    # Coming closer does not help if the panel fills the picture.
    full = scene.replace(columns=590)
    assert failure_of(full, 590).endswith("chips fit the panel's image; raise the frequency.")
    # With 48 chips in the picture, an exposure would be longer than two chips.
    small = scene.replace(columns=250)
    assert failure_of(small, 250).endswith("20 of 48 chips fit the panel's image.")
    # And no decoder reads chips that are narrower than a column.
    narrow = scene.replace(columns=20)
    assert failure_of(narrow, 20, "matched").endswith("1 of 24 chips fit the panel's image.")


def test_the_failure_of_an_overexposed_picture_names_no_other_cause() -> None:
    """The code, its timing and the scene are right, and without clipping it is read."""
    scene = occ.load_preset("phone-136us").replace(rows=300, iso=6400.0)
    for enhancement, decoder in (
        ("none", "equalizer"),
        ("none", "sequence"),
        ("stretch", "sequence"),
    ):
        white = scene.replace(enhancement=enhancement)
        failure = occ.decode(occ.render(white).image, white, decoder).failure
        assert failure is not None
        for said in ("without the enhancement it can", "No such code is sent", "come closer"):
            assert said not in failure
        dark = white.replace(iso=400.0)
        assert occ.decode(occ.render(dark).image, dark, decoder).code == 718


@pytest.mark.parametrize("pattern", ["01", "0011", "0101100", "010100010110001001000"])
@pytest.mark.parametrize("frequency", [2e3, 5e3, 10e3])
def test_the_chips_of_a_raw_pattern_are_read(
    covering_scene: Scene, pattern: str, frequency: float
) -> None:
    scene = covering_scene.replace(
        pattern=pattern, switching_frequency=frequency, enhancement="stretch"
    )
    result = occ.decode(occ.render(scene).image, scene)
    assert result.chip_length == pytest.approx(1 / frequency / 8e-6, rel=0.01)
    whole = "".join(map(str, result.chips[3:-3]))  # the runs at the edges are cut off
    assert len(whole) > 40
    assert result.code is None
    assert "raw chip pattern" in result.failure
    assert whole in pattern * 200


@pytest.mark.photos
def test_the_chips_of_real_photos_are_read(photos: Path) -> None:
    square = Scene().replace(pattern="01", switching_frequency=2e3, readout_time=14.565e-6)
    result = occ.decode(occ.load_photo(photos / "led_1khz_frame.png").image, square)
    assert result.chip_length == pytest.approx(500e-6 / 14.565e-6, rel=0.01)
    assert "".join(map(str, result.chips[1:-1])) in "01" * 50
    pattern = "010100010110001001000"
    # 13.9 columns a chip.
    striped = Scene().replace(pattern=pattern, switching_frequency=1e4, readout_time=1e-4 / 13.9)
    result = occ.decode(occ.load_photo(photos / "vlcdetector_stripes.png").image, striped)
    assert result.chip_length == pytest.approx(13.9, rel=0.01)
    assert "".join(map(str, result.chips[2:-2])) in pattern * 5
