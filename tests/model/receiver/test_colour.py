"""Reading three colours: raw or demosaiced, unmixed by a known or a measured matrix, and CSK."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.receiver.csk import symbol_fractions
from occ_model.scene.csk import BANDS, PARTS, POINTS, bits_of, symbols_of
from occ_model.scene.parameters.colour import CSK_ORDERS
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import lessons

PHONE_MATRIX = "0.864 0.044 0.091 / 0.129 0.222 0.649 / 0.029 0.045 0.926"


def small(**changes: float | str) -> Scene:
    scene = occ.load_preset("phone-68us-colour")
    return scene.replace(rows=240, panel_height=0.05, **changes)


def codes_of(reading: occ.ColourReading) -> tuple[int | None, ...]:
    return tuple(result.code for result in reading.results)


@pytest.mark.parametrize("decoder", ["threshold", "matched"])
@pytest.mark.parametrize("bayer", ["rggb", "grbg", "gbrg", "bggr"])
@pytest.mark.parametrize("demosaicing", ["bilinear", "vng", "edge-aware", "none"])
def test_three_codes_are_read_from_any_pattern_and_demosaicing(
    demosaicing: str, bayer: str, decoder: str
) -> None:
    scene = small(bayer=bayer, demosaicing=demosaicing)
    reading = occ.decode_colours(occ.render_colour(scene).image, scene, decoder)
    assert codes_of(reading) == (718, 345, 201)
    assert reading.is_read
    assert str(reading) == "red 718, green 345, blue 201"


def test_mixed_codes_need_the_matrix() -> None:
    # Solving this matrix makes green's noise 6.6 times as large: it takes more rows.
    scene = small(mixing=PHONE_MATRIX, demosaicing="none").replace(rows=1152, panel_height=0.15)
    image = occ.render_colour(scene).image
    assert codes_of(occ.decode_colours(image, scene, "matched")) == (718, 345, 201)
    reading = occ.decode_colours(image, scene.replace(mixing="", crosstalk=0.0), "matched")
    assert codes_of(reading)[1] != 345
    assert "green" in str(reading)


@pytest.mark.parametrize("seed", [3, 4])
def test_a_calibration_measures_the_matrix(seed: int) -> None:
    random = np.random.default_rng(seed)
    matrix = np.eye(3) + random.uniform(0.0, 0.4, (3, 3))
    matrix /= matrix.sum(axis=1).max()
    text = " / ".join(" ".join(f"{number:.4f}" for number in row) for row in matrix)
    truth = small(mixing=text, red_gain=1.2, blue_gain=1.5)
    pictures = [calibration_picture(truth, colour) for colour in ("red", "green", "blue", "none")]
    measured = occ.measure_mixing(pictures, truth.replace(mixing=""))
    found = np.array(measured.colours.matrix)
    assert found / found.sum() == pytest.approx(matrix / matrix.sum(), abs=0.004)


def calibration_picture(scene: Scene, colour: str) -> np.ndarray:
    """Take a picture with one LED steadily lit, made by a matrix that sees it alone."""
    matrix = np.array(scene.colours.matrix)
    columns = {"red": 0, "green": 1, "blue": 2}
    alone = np.zeros((3, 3))
    if colour in columns:
        alone[:, columns[colour]] = matrix[:, columns[colour]]
    dark = 290.0 * 0.4 / np.pi
    light = matrix.sum(axis=1) * dark + 3600.0 * alone.sum(axis=1)
    channels = []
    for index, gain in enumerate(scene.colours.gains):
        x = scene.camera.iso * gain * scene.camera.exposure_time * light[index]
        x /= scene.camera.meter_constant * scene.camera.f_number**2
        channels.append(118.0 * x ** (1.0 / scene.camera.gamma))
    outside = np.full((240, 3456, 3), 20, dtype=np.uint8)
    outside[60:180, 800:2600] = np.clip(np.rint(channels), 0, 255).astype(np.uint8)
    return outside


def test_three_pictures_are_no_calibration() -> None:
    with pytest.raises(occ.ParameterError, match="4: red, green, blue and none lit"):
        occ.measure_mixing([np.zeros((4, 4, 3), np.uint8)] * 3, small())


@pytest.mark.parametrize(
    ("other", "reason"),
    [
        (np.zeros((8, 8, 3)), "8-bit pixels"),
        (np.zeros((8, 6, 3), np.uint8), r"same rows and columns, not \(8, 6\), \(8, 8\)"),
    ],
)
def test_a_calibration_of_other_pictures_is_refused(other: np.ndarray, reason: str) -> None:
    lit = np.full((8, 8, 3), 9, np.uint8)
    lit[2:6, 2:6] = 200
    with pytest.raises(occ.DecodeInputError, match=reason):
        occ.measure_mixing([other, lit, lit, lit], small())


@pytest.mark.parametrize("image", [np.zeros((4, 4)), np.zeros((4, 4, 2), np.uint8), np.uint8(1)])
def test_other_arrays_are_refused(image: np.ndarray) -> None:
    with pytest.raises(occ.DecodeInputError, match="8-bit pixels"):
        occ.decode_colours(image, small())


def test_a_picture_without_a_panel_says_so() -> None:
    reading = occ.decode_colours(np.full((64, 64, 3), 9, np.uint8), small())
    assert str(reading) == "red not read, green not read, blue not read"
    assert "No panel" in str(reading.results[0].failure)


@pytest.mark.parametrize("order", CSK_ORDERS)
def test_a_constellation_has_distinct_points_of_equal_power(order: str) -> None:
    points = np.array(POINTS[order])
    assert len(np.unique(points, axis=0)) == CSK_ORDERS[order]
    assert (points.sum(axis=1) == PARTS).all()
    assert (points >= 0).all()


def test_the_average_of_eight_points_is_not_white() -> None:
    # As published: 8-CSK sends more green light than red or blue.
    mean = np.array(POINTS["8-csk"]).mean(axis=0) / PARTS
    assert mean == pytest.approx([0.319, 0.361, 0.319], abs=5e-4)
    for order in ("4-csk", "16-csk"):
        assert np.array(POINTS[order]).mean(axis=0) / PARTS == pytest.approx([1 / 3] * 3)


def test_labels_of_neighbours_differ_in_one_bit_but_for_the_pairs_of_the_claim() -> None:
    points = np.array(POINTS["16-csk"])
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    pairs = np.argwhere(np.triu(np.isclose(distances, distances[distances > 0].min())))
    assert len(pairs) == 18
    unlike = [{*pair} for pair in pairs.tolist() if (pair[0] ^ pair[1]).bit_count() != 1]
    # US patent 9467232, claim 1: S6 and S12, S12 and S13, S13 and S15.
    assert unlike == [{0b0100, 0b0111}, {0b0100, 0b1101}, {0b1000, 0b1101}]


def test_centres_of_the_bands_are_those_of_monochromatic_light() -> None:
    # CIE 1931, 2 degrees: x and y at multiples of 5 nm beside each centre.
    beside = {
        429: ((0.1703, 0.0058), (0.1689, 0.0069)), 509: ((0.0039, 0.6548), (0.0139, 0.7502)),
        564: ((0.3731, 0.6245), (0.4087, 0.5896)), 611: ((0.6658, 0.3340), (0.6801, 0.3197)),
        656: ((0.7283, 0.2717), (0.7300, 0.2700)), 703: ((0.7347, 0.2653), (0.7347, 0.2653)),
        753: ((0.7347, 0.2653), (0.7347, 0.2653)),
    }  # fmt: skip
    for (first, last, *centre), (middle, (below, above)) in zip(BANDS, beside.items(), strict=True):
        assert middle == pytest.approx((first + last) / 2, abs=0.5)
        part = middle % 5 / 5 if middle % 5 else 1.0
        expected = np.array(below) + part * (np.array(above) - np.array(below))
        assert centre == pytest.approx(expected, abs=0.0025)


def test_a_point_has_the_mean_chromaticity_of_its_leds() -> None:
    found = occ.csk_chromaticities("4-csk", "420")
    corners = [(0.729, 0.271), (0.402, 0.597), (0.169, 0.007)]
    assert found[[3, 0, 2]] == pytest.approx(np.array(corners))
    assert found[1] == pytest.approx(np.mean(corners, axis=0))
    with pytest.raises(occ.ParameterError, match="620, 610, 520"):
        occ.csk_chromaticities("4-csk", "420 nm")


@pytest.mark.parametrize("order", CSK_ORDERS)
@pytest.mark.parametrize("count", [1, 7, 10, 12, 16])
def test_symbols_carry_bits(order: str, count: int) -> None:
    bits = np.random.default_rng(count).integers(0, 2, count).tolist()
    assert bits_of(order, symbols_of(order, bits), count) == bits


def test_fractions_of_symbols_are_those_of_dense_sampling() -> None:
    scene = small(exposure_time=136e-6, switching_frequency=11e3)
    table = symbol_fractions(scene, 7, 300, 2.3)
    steps = (np.arange(20_000) + 0.5) / 20_000 * 136e-6
    time = np.arange(300)[:, None] * 8e-6 + steps
    symbol = np.floor(2.3 + time * 11e3).astype(int) % 7
    sampled = np.stack([(symbol == number).mean(axis=1) for number in range(7)], axis=1)
    assert np.abs(table - sampled).max() < 1e-4


@pytest.mark.parametrize("order", CSK_ORDERS)
@pytest.mark.parametrize("frequency", [3e3, 10e3, 20e3])
def test_colour_shift_keying_is_read_by_the_nearest_points(order: str, frequency: float) -> None:
    scene = small(colour_light=order, switching_frequency=frequency, code=613, start_time=1.7e-3)
    reading = occ.decode_colours(occ.render_colour(scene).image, scene)
    assert str(reading) == "colours 613"


def test_colour_shift_keying_without_its_dark_header_is_refused() -> None:
    scene = small(colour_light="16-csk")
    white = scene.replace(colour_light="white", switching_frequency=3.1e3)
    reading = occ.decode_colours(occ.render_colour(white).image, scene)
    assert not reading.is_read


def test_one_code_in_one_colour_leaves_the_others_steady() -> None:
    scene = small(colour_light="green")
    reading = occ.decode_colours(occ.render_colour(scene).image, scene)
    assert reading.results[1].code == 718
    assert [result.code for result in (reading.results[0], reading.results[2])] == [None, None]


@pytest.mark.parametrize(("chroma", "read"), [("subsampled", (718, 345, None)), ("full", None)])
def test_a_file_loses_blue_first_as_the_lesson_says(
    chroma: str, read: tuple[int | None, ...] | None
) -> None:
    lesson = next(lesson for lesson in lessons().lessons if lesson.name.startswith("colour"))
    scene = lesson.steps[-1].scene.replace(chroma=chroma)
    for seed in (1, 7):
        image = occ.render_colour(scene, seed=seed).image
        reading = occ.decode_colours(image, scene, lesson.steps[-1].decoder)
        assert codes_of(reading) == (read or (718, 345, 201))
