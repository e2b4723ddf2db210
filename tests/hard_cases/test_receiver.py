"""Degenerate signals and images are read, or refused with a sentence."""

import math
from typing import Any

import numpy as np
import pytest
from amount import amount
from each_case import each_case
from hypothesis import strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import decades
from occ_model.receiver.decode import DECODERS
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene

BOTH = sorted(DECODERS)


@st.composite
def receivers(draw: st.DrawFn) -> Scene:
    """Draw scenes with any parameters that a receiver knows."""
    return Scene().replace(
        code=0,
        bits=draw(st.integers(2, 7)),
        pattern=draw(st.sampled_from(["", "", "01", "0010111", "1"])),
        switching_frequency=draw(st.just(1e4) | decades(1.0, 1e9)),
        exposure_time=draw(st.just(136e-6) | decades(1e-9, 1e6)),
        readout_time=draw(st.just(8e-6) | decades(1e-9, 10.0)),
        bright_fraction=draw(decades(1e-4, 0.5)),
        start_time=draw(st.floats(-1e9, 1e9)),
    )


def check(result: DecodeResult, columns: int) -> None:
    """Check the laws of any result."""
    assert (result.code is None) == (result.failure is not None)
    if result.failure is not None:
        assert result.failure.endswith((".", "header's."))
        assert "nan" not in result.failure
        assert "inf" not in result.failure.split()
    assert result.region is not None or "No panel" in str(result.failure)
    # A chip of a third of a column is the shortest that is tried, before refinement.
    assert len(result.chips) <= 8 * columns
    for number in (result.threshold, result.chip_length, result.correlation, result.confidence):
        assert number is None or math.isfinite(number)
    for array in (result.signal, result.chip_starts, result.folded, result.model):
        assert array is None or np.isfinite(array).all()


def reading_error(image: object, scene: Scene, decoder: str, columns: int) -> float:
    """Return 0 if an array was read or refused with a sentence, and 1 otherwise."""
    try:
        check(occ.decode(image, scene, decoder), columns)  # type: ignore[arg-type]
    except occ.DecodeInputError as refusal:
        return 0.0 if str(refusal).endswith(".") else 1.0
    return 0.0


@st.composite
def garbage_profiles(draw: st.DrawFn) -> np.ndarray:
    """Draw runs of one to thousands of columns, of a few values or of all."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    runs = draw(st.integers(1, 60))
    # Heavy-tailed: most runs are short, some are as long as all the others.
    lengths = np.ceil(draw(decades(1.0, 30.0)) * random.pareto(draw(st.floats(0.6, 5.0)), runs))
    lengths = np.clip(lengths, 1, 5000).astype(np.int64)
    size = draw(decades(0.1, 9e4))
    values = random.choice([random.normal(0, size, runs), np.resize([0, size], runs)])
    signal = np.clip(np.repeat(values, lengths), -1e5, 1e5)
    noise = draw(st.sampled_from([0.0, 0.0, 0.3]))
    return np.clip(signal + random.normal(0, noise * size, len(signal)), -1e5, 1e5)


@cases(profile=garbage_profiles(), scene=receivers(), decoder=st.sampled_from(BOTH))
def test_any_profile_is_read_or_refused_with_a_sentence(
    profile: np.ndarray, scene: Scene, decoder: str
) -> None:
    error = reading_error(profile, scene, decoder, len(profile))
    record("any profile: read, or a sentence", "1 to 1e5 columns, any receiver", error, 0.0)


def test_an_exposure_of_a_billionth_of_a_chip_is_read() -> None:
    scene = Scene().replace(pattern="01", switching_frequency=1.0, exposure_time=1e-9)
    assert reading_error(np.array([6.4, 1.05, 1.05]), scene, "sequence", 3) == 0.0


@st.composite
def garbage_images(draw: st.DrawFn) -> np.ndarray:
    """Draw noise, specks, stripes and constants of every type, also with NaN and infinity."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    rows = draw(st.integers(1, 40) | st.just(1))
    columns = draw(st.integers(1, 600) | st.just(1))
    kind = draw(st.sampled_from(["noise", "specks", "stripes", "constant"]))
    if kind == "noise":
        image = random.normal(128, draw(decades(0.1, 1e3)), (rows, columns))
    elif kind == "specks":
        image = np.where(random.random((rows, columns)) < 0.01, 255.0, 3.0)
    elif kind == "stripes":
        period = draw(st.integers(1, 40))
        image = np.tile(255.0 * (np.arange(columns) // period % 2), (rows, 1))
    else:
        image = np.full((rows, columns), float(random.integers(-5, 300)))
    image = image[:: draw(st.sampled_from([1, -1, 2])), :: draw(st.sampled_from([1, -1, 3]))]
    types = [np.uint8, np.uint16, np.float16, np.float32, np.float64, np.longdouble, np.int32, bool]
    kind_of = draw(st.sampled_from(types))
    if not np.issubdtype(kind_of, np.floating):
        return np.clip(image, 0, 255).astype(kind_of)
    none = draw(st.sampled_from([0.0, 0.0, 0.0, np.nan, np.inf, -np.inf, 1e30]))
    if none != 0.0:
        image = image.copy()
        image[0, -1] = none
    with np.errstate(over="ignore"):
        return image.astype(kind_of)


@cases(image=garbage_images(), scene=receivers(), decoder=st.sampled_from(BOTH))
def test_any_image_is_read_or_refused_with_a_sentence(
    image: np.ndarray, scene: Scene, decoder: str
) -> None:
    error = reading_error(image, scene, decoder, image.shape[1])
    record(
        "any image: read, or a sentence", "any type, shape, stride; NaN and infinity", error, 0.0
    )


@cases(
    code=st.integers(0, 1023),
    start=st.floats(0.0, 0.01),
    size=decades(0.02, 100.0),
    shift=st.floats(-1e3, 1e3),
    decoder=st.sampled_from(BOTH),
)
def test_a_code_is_read_at_any_scale_of_grey_levels(
    code: int, start: float, size: float, shift: float, decoder: str
) -> None:
    scene = Scene().replace(
        code=code, start_time=start, exposure_time=68e-6, columns=1000, enhancement="none"
    )
    profile = occ.column_profile(scene)
    read = occ.decode(profile * size + shift, scene, decoder).code
    record("codes read off scaled profiles: wrong", "gain 0.02 to 100", float(read != code), 0.0)


def profile_of(columns: int, **changes: float | int | str) -> np.ndarray:
    return occ.column_profile(Scene().replace(columns=columns, **changes))


MANY = amount(5_000, 100_000)  # columns of the longest of these signals
LONGEST = amount(100, 200)  # columns of the longest run of a chirp

SIGNALS: dict[str, np.ndarray] = {
    # No swing to divide by.
    "constant": np.full(500, 117.0),
    "constant, but for rounding": 117.0 + 1e-13 * (np.arange(500) % 2),
    # One column: no run, no histogram, no lag.
    "one column": np.array([200.0]),
    # Two columns, each of them a run that the rim cuts off.
    "two columns": np.array([0.0, 255.0]),
    # A single step, and so no whole run.
    "one step": np.repeat([10.0, 200.0], 300),
    # One whole run, of one kind only: the histogram of the other is empty.
    "one whole run": np.repeat([0.0, 255.0, 0.0], [50, 10, 50]),
    # Two whole runs, one of each kind, which is one too few for a chip's length.
    "two whole runs": np.repeat([0.0, 255.0, 0.0, 255.0], [50, 10, 7, 50]),
    # Every run is one column, so that no split of lengths has two classes.
    "alternating columns": np.resize([0.0, 255.0], 2000),
    # The same, with the smallest swing that counts as stripes.
    "one grey level of swing": np.resize([100.0, 101.0], 2000),
    # All runs alike, in many columns.
    "many columns, two values": np.resize(np.repeat([0.0, 255.0], 14), MANY),
    # One long run beside runs of one column, so that all but two bins are empty.
    "one run of nearly all columns": np.concatenate(
        [np.resize([0.0, 255.0], 51), np.zeros(MANY - 100), np.resize([255.0, 0.0], 49)]),
    # Values next to the largest grey level, and -0.
    "the largest values": np.resize([1e5, -1e5, -0.0, 0.0], 400),
    # The swing is one ulp in the histogram's last bin.
    "a ramp": np.linspace(0.0, 255.0, MANY),
    # A chirp, in which each run is a column longer than the one before.
    "runs of all lengths": np.repeat(np.resize([0.0, 255.0], LONGEST), np.arange(1, LONGEST + 1)),
}  # fmt: skip


@pytest.mark.parametrize("decoder", BOTH)
@pytest.mark.parametrize("name", SIGNALS)
def test_a_hard_signal_is_read_or_refused_with_a_reason(name: str, decoder: str) -> None:
    signal = SIGNALS[name]
    scenes: tuple[dict[str, Any], ...] = (
        {},
        {"bits": 2, "code": 0},
        {"pattern": "01"},
        {"readout_time": 10.0},
    )
    for changes in scenes[: amount(2, 4)]:
        result = occ.decode(signal, Scene().replace(**changes), decoder)
        check(result, len(signal))
        # One of the four codes of two bits can look like anything.
        assert result.failure is not None or "bits" in changes


@pytest.mark.parametrize("decoder", BOTH)
def test_codes_of_16_bits_in_100000_columns_are_read(decoder: str) -> None:
    # A table of 65,536 codes at 288 phases would fill 150 GB with the columns.
    scene = Scene().replace(bits=16, code=0xBEEF, exposure_time=68e-6)
    profile = occ.column_profile(scene.replace(columns=100_000))
    assert occ.decode(profile, scene, decoder).code == 0xBEEF


@pytest.mark.parametrize("decoder", BOTH)
def test_images_of_all_types_give_the_same_code(decoder: str) -> None:
    scene = Scene().replace(rows=40, columns=2000, distance=0.1, exposure_time=68e-6)
    image = occ.render(scene).image
    images: dict[str, Any] = {
        "uint8": image,
        # 255 becomes 65535: larger values must be scaled to a byte, not cut off.
        "uint16": image.astype(np.uint16) * 257,
        # Eleven bits hold a byte exactly.
        "float16": image.astype(np.float16),
        "float32": image.astype(np.float32),
        "float64": image.astype(np.float64),
        # A type that OpenCV does not know.
        "longdouble": image.astype(np.longdouble),
        # The other byte order, as in files and networks.
        "big-endian uint16": (image.astype(np.uint16) * 257).astype(">u2"),
        "big-endian float32": image.astype(">f4"),
        # Fractions of white, as of scikit-image.
        "fractions": image / 255.0,
        "fractions of single precision": image.astype(np.float32) / np.float32(255.0),
        # Memory layouts that OpenCV cannot use: columns first, backwards, every other pixel.
        "columns first": np.asfortranarray(image),
        "from the end": image[::-1, ::-1].copy()[::-1, ::-1],
        "every other": np.repeat(np.repeat(image, 2, axis=0), 2, axis=1)[::2, ::2],
    }
    for name, pixels in images.items():
        pixels.flags.writeable = False
        assert occ.decode(pixels, scene, decoder).code == scene.transmitter.code, name


def test_sixteen_bits_tell_more_than_eight() -> None:
    # A profile of 16 bits whose stripes are a third of a grey level: too flat, but not rounded off.
    stripes = np.resize(np.repeat([1000, 1090], 20), 3000).astype(np.uint16)
    failure = occ.decode(stripes, Scene()).failure
    assert "0.35 grey levels" in failure


@pytest.mark.parametrize("decoder", BOTH)
def test_a_profile_in_fractions_is_refused_with_what_to_do(decoder: str) -> None:
    profile = profile_of(1000, exposure_time=68e-6)
    assert "multiply" not in (occ.decode(profile[:200], Scene(), decoder).failure or "")
    failure = occ.decode(profile / 255.0, Scene(), decoder).failure
    assert "grey levels: if this one is in fractions of white, multiply it by 255." in failure


NOT_IMAGES: dict[str, tuple[object, str]] = {
    # NaN is neither below nor above a threshold, and spreads through every sum.
    "NaN": (np.array([[1.0, np.nan], [2.0, 3.0]]), "not numbers"),
    "NaN in a profile": (np.r_[np.zeros(99_999), np.nan], "not numbers"),
    "infinity": (np.array([[1.0, np.inf]]), "not numbers"),
    "minus infinity": (np.array([-np.inf, 1.0]), "not numbers"),
    # Half precision has an infinity of its own, from 65520 on.
    "infinity of half precision": (np.array([1.0, np.inf], np.float16), "not numbers"),
    # Finite, but its square is not.
    "the largest float": (np.array([0.0, np.finfo(float).max]), "1.8e+308"),
    # Either fractions beyond white, or grey levels of a dark picture.
    "beyond fractions": (np.array([[0.0, 1.1]]), "from 0 to 1.1; allowed in floating point"),
    "hardly grey levels": (np.array([[0.0, 2.0]]), "from 0 to 2; allowed in floating point"),
    # Twelve bits, where white is 4095.
    "beyond grey levels": (np.array([[0.0, 4095.0]], np.float32), "from 0 to 4095; allowed"),
    "from -1 to 1": (np.array([[-1.0, 1.0]]), "from -1 to 1; allowed in floating point"),
    "a little too large": (np.array([0.0, -100_001.0]), "1e+05"),
    "no pixels": (np.empty((0, 7)), "empty"),
    "no columns": (np.empty((7, 0), np.uint8), "empty"),
    "nothing": (np.empty(0), "empty"),
    "a colour image": (np.zeros((4, 5, 3), np.uint8), "shape"),
    "a number": (3.0, "shape"),
    "None": (None, "shape"),
    "text": ("0101", "shape"),
    "signed bytes": (np.zeros((4, 5), np.int8), "int8"),
    "truth values": (np.zeros((4, 5), bool), "bool"),
    "complex numbers": (np.zeros((4, 5), complex), "complex"),
    "objects": (np.array([[1, None]], dtype=object), "object"),
    "numbers of any length": ([[10**400, 1]], "object"),
    "dates": (np.zeros(5, "datetime64[s]"), "datetime64"),
    "rows of different lengths": ([[1, 2], [3]], "different lengths"),
    # A view of one byte as a terabyte, which must not be copied.
    "a terabyte in a byte": (np.broadcast_to(np.uint8(3), (2**20, 2**20)), "million pixels"),
    "a profile of a terabyte": (np.broadcast_to(np.float64(3), (2**37,)), "million pixels"),
}  # fmt: skip


@each_case(NOT_IMAGES)
def test_an_array_that_is_no_image_is_refused_with_a_sentence(name: str) -> None:
    image, word = NOT_IMAGES[name]
    for decoder in BOTH:
        with pytest.raises(occ.DecodeInputError) as refusal:
            occ.decode(image, Scene(), decoder)  # type: ignore[arg-type]
        assert word in str(refusal.value)
        assert str(refusal.value).endswith(".")


@pytest.mark.parametrize("exposure", [24 / 8192, 1e3 + 1e-5, 1e6])
def test_an_exposure_that_leaves_only_the_mean_is_refused(exposure: float) -> None:
    # Exactly one packet, or so many that the rest is lost in rounding: all codes look alike.
    scene = Scene().replace(exposure_time=exposure, switching_frequency=8192.0)
    failure = occ.decode(SIGNALS["runs of all lengths"], scene, "matched").failure
    assert failure.startswith("All codes look the same")
