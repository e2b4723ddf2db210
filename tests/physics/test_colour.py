"""Laws of a colour camera, against closed forms and dense sampling of the light."""

import itertools

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.camera.mosaic import demosaic, light_of_greys, mosaic_of, store_as_jpeg
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.results.colour import ColourFrame
from occ_model.scene.scene import Scene
from occ_model.simulation.colour import render_colour

PATTERNS = ("rggb", "grbg", "gbrg", "bggr")
QUIET = {"sensor-noise": False, "fixed-pattern": False}
PHONE_MATRIX = ".864 .044 .091 / .129 .222 .649 / .029 .045 .926"


def colour_phone(**changes: float | str) -> Scene:
    scene = occ.load_preset("phone-68us").replace(averaging="light", bayer="rggb")
    return scene.replace(rows=64, columns=2400, panel_width=20.0, panel_height=20.0, **changes)


def picture(scene: Scene) -> ColourFrame:
    return render_colour(scene, force=QUIET)


def sampled_light(scene: Scene, samples: int = 20_000) -> FloatArray:
    """Sample each LED's chips during each column's exposure, shape (3, columns)."""
    chips = [
        occ.packet(scene.replace(code=code))
        for code in (scene.transmitter.code, *scene.colours.codes.values())
    ]
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    steps = (np.arange(samples) + 0.5) / samples * camera.exposure_time
    starts = scene.model.start_time + camera.readout_time * np.arange(camera.columns)
    chip = ((starts[:, None] + steps) * frequency).astype(np.int64)
    return np.array([packet[chip % len(packet)].mean(axis=1) for packet in chips])


@pytest.mark.parametrize("mixing", ["1 0 0 / 0 1 0 / 0 0 1", PHONE_MATRIX])
@pytest.mark.parametrize("pattern", PATTERNS)
def test_each_pixel_has_the_mixed_light_of_three_sampled_codes(pattern: str, mixing: str) -> None:
    scene = colour_phone(
        bayer=pattern, mixing=mixing, colour_light="three-codes", demosaicing="none",
        switching_frequency=7e3, red_gain=1.3, blue_gain=1.7,
    ).replace(columns=301)  # fmt: skip
    lit = sampled_light(scene)
    dark = 290.0 * 0.4 / np.pi
    image = picture(scene).image
    for row, column in itertools.product(range(2), range(2)):
        letter = pattern[2 * row + column]
        channel = "rgb".index(letter)
        weights = np.array(scene.colours.matrix[channel])
        light = weights.sum() * dark + 3600.0 * weights @ lit[:, column::2]
        gain = (1.3, 1.0, 1.7)[channel]
        expected = np.minimum(pixel_value(gain * light, scene.camera), 255.0)
        seen = image[row::2, column::2]
        assert (seen == seen[0]).all()
        assert np.abs(seen[0] - expected).max() < 0.5 + 0.02  # rounding, and the sampling's error


def amplitude(values: FloatArray, cycles_a_column: float) -> complex:
    """Return the amplitude of a wave, with the mean taken out."""
    place = np.arange(len(values))
    table = np.stack(
        [np.ones(len(values)), *(f(2 * np.pi * cycles_a_column * place) for f in (np.cos, np.sin))]
    ).T
    _, real, imaginary = np.linalg.lstsq(table, values, rcond=None)[0]
    return complex(real, -imaginary)


def swinging(frequency: float, columns: int = 2000) -> FloatArray:
    return np.asarray(0.4 + 0.3 * np.cos(2 * np.pi * frequency * np.arange(columns) + 0.7))


def demosaiced_light(light: FloatArray, pattern: str) -> FloatArray:
    """Demosaic white stripes, and return the mean light of each channel, shape (3, columns)."""
    scene = colour_phone(bayer=pattern)
    # In a single gamma of 1 a grey level is a step of light; dithering makes means exact.
    scene = scene.replace(gamma=1.0)
    threshold = (np.arange(256) + 0.5)[:, None, None] / 256
    levels = np.floor(255.0 * light + threshold).astype(np.uint8)
    mosaic = np.repeat(levels.reshape(256, -1), 2, axis=0)
    rgb = demosaic(np.ascontiguousarray(mosaic), scene)[2:-2].astype(np.float64)
    return np.asarray(rgb.mean(axis=0).T / 255.0)


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("frequency", [0.03, 0.11, 0.22, 0.31, 0.37, 0.44, 0.487])
def test_bilinear_demosaicing_damps_and_mirrors_stripes_as_its_closed_form(
    frequency: float, pattern: str
) -> None:
    light = swinging(frequency)
    red, green, blue = demosaiced_light(light, pattern)[:, 8:-8]
    whole = amplitude(light[8:-8], frequency)
    kept = np.cos(np.pi * frequency) ** 2
    image = abs(0.5 - frequency)
    mirrored = []
    for colour in (red, blue):
        rest = np.abs(amplitude(colour, frequency))
        assert rest == pytest.approx(0.3 * kept, abs=6e-4)
        mirrored.append(amplitude(colour, image))
        assert abs(mirrored[-1]) == pytest.approx(0.3 * np.sin(np.pi * frequency) ** 2, abs=6e-4)
    assert mirrored[0] == pytest.approx(-mirrored[1], abs=1e-3)
    expected = (0.75 + 0.25 * np.cos(2 * np.pi * frequency)) * whole
    assert amplitude(green, frequency) == pytest.approx(expected, abs=6e-4)


@pytest.mark.parametrize("pattern", PATTERNS)
def test_the_pixels_of_a_colour_are_a_monochrome_camera(pattern: str) -> None:
    scene = colour_phone(bayer=pattern, colour_light="three-codes", demosaicing="none")
    image = picture(scene).image
    for colour in ("red", "green", "blue"):
        row, column = scene.colours.first_pixel(colour)
        own = image[row] if colour == "green" else image[row, column::2]
        expected = occ.column_profile(scene.colour(colour))
        if colour == "green":  # every second column's green pixels are in the other rows
            own = np.where(np.arange(own.size) % 2 == column, own, image[1 - row])
        assert np.array_equal(own, np.rint(expected))


@pytest.mark.parametrize("method", ["bilinear", "vng", "edge-aware"])
@pytest.mark.parametrize("pattern", PATTERNS)
def test_demosaicing_keeps_what_each_pixel_saw(pattern: str, method: str) -> None:
    scene = colour_phone(bayer=pattern, demosaicing=method)
    raw = np.random.default_rng(3).integers(0, 256, (40, 60), dtype=np.uint8)
    kept = mosaic_of(demosaic(raw, scene), scene)[3:-3, 3:-3]
    assert np.array_equal(kept, raw[3:-3, 3:-3])


def test_stripes_of_a_column_keep_only_luma_in_a_file_of_half_chroma() -> None:
    row = np.tile([90, 150], 64).astype(np.uint8)
    for channel, weight in enumerate((0.299, 0.587, 0.114)):
        image = np.full((32, 128, 3), 120, dtype=np.uint8)
        image[:, :, channel] = row
        read = store_as_jpeg(image, 100, "subsampled").astype(np.float64)[8:-8, 16:-16]
        swing = read[:, 1::2].mean(axis=(0, 1)) - read[:, ::2].mean(axis=(0, 1))
        assert swing == pytest.approx(np.full(3, 60.0 * weight), abs=1.0)
        full = store_as_jpeg(image, 100, "full").astype(np.float64)[8:-8, 16:-16]
        swing = full[:, 1::2].mean(axis=(0, 1)) - full[:, ::2].mean(axis=(0, 1))
        # Luma, chroma times up to 1.772, and the result are rounded, on both sides.
        assert swing[channel] == pytest.approx(60.0, abs=2 * (0.5 + 1.772 / 2 + 0.5))


def test_the_light_of_greys_is_that_of_the_tone_curve() -> None:
    camera = Scene().camera
    light = luminance_of(np.arange(256.0), camera)
    assert light_of_greys(camera.gamma) == pytest.approx(light / light[-1])
