"""Several profiles are read together exactly as one at a time."""

from dataclasses import fields

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.receiver.decode import DECODERS, decode_profiles
from occ_model.results.decoding import DecodeResult

SCHEMES: tuple[dict[str, float | str], ...] = (
    {},
    {"enhancement": "none"},
    {"enhancement": "stretch", "bits": 6, "code": 3},
    {"line_code": "manchester", "framing": "raw", "payload": "text:H", "enhancement": "none"},
    {"line_code": "4b6b", "framing": "preamble", "bits": 8, "code": 3, "enhancement": "none"},
    {"line_code": "nrz", "framing": "paper", "bits": 5, "code": 3},
    {"pattern": "1101001"},
)


def random_scene(random: np.random.Generator) -> occ.Scene:
    """Draw a scheme, a frequency of 0.1 to 7 chips in an exposure, and a number of columns."""
    exposure = 10.0 ** random.uniform(-5.0, -3.3)
    chips = 10.0 ** random.uniform(-1.0, 0.85)
    return occ.load_preset("phone-136us").replace(
        **SCHEMES[random.integers(len(SCHEMES))],
        exposure_time=float(exposure),
        switching_frequency=float(np.clip(chips / exposure, 100.0, 90e3)),
        columns=int(random.choice([150, 700, 1700])),
    )


def draw(random: np.random.Generator) -> tuple[np.ndarray, occ.Scene]:
    """Draw a scene, and the profile of random chips with noise, or a flat or a saturated one."""
    scene = random_scene(random)
    if not scene.transmitter.pattern and not scene.transmitter.payload:
        scene = scene.replace(code=int(random.integers(2**scene.transmitter.payload_length)))
    start = float(random.uniform(0.0, 0.01))
    lit = occ.on_time(scene.replace(start_time=start)) / scene.camera.exposure_time
    levels = 30.0 + random.choice([0.0, 20.0, 190.0, 400.0]) * lit
    levels += random.normal(0.0, random.choice([0.1, 1.0, 8.0]), len(levels))
    return np.clip(levels, 0.0, 255.0), scene


def assert_same(first: object, second: object, name: str = "result") -> None:
    """Compare two results part by part, bit for bit."""
    if isinstance(first, np.ndarray):
        np.testing.assert_array_equal(first, second, err_msg=name)
    elif hasattr(first, "__dataclass_fields__"):
        for part in fields(first):  # type: ignore[arg-type]
            assert_same(getattr(first, part.name), getattr(second, part.name), part.name)
    elif isinstance(first, tuple):
        for one, other in zip(first, second, strict=True):  # type: ignore[call-overload]
            assert_same(one, other, name)
    else:
        assert first == second or first != first, name  # NaN equals NaN


@pytest.mark.parametrize("decoder", DECODERS)
@pytest.mark.parametrize("seed", range(amount(2, 10)))
def test_profiles_of_many_scenes_are_read_together_bit_for_bit_as_alone(
    decoder: str, seed: int
) -> None:
    random = np.random.default_rng((31, seed))
    profiles, scenes = zip(*(draw(random) for _ in range(60)), strict=True)
    together: list[DecodeResult] = decode_profiles(profiles, scenes, decoder)
    for profile, scene, result in zip(profiles, scenes, together, strict=True):
        assert_same(result, occ.decode(profile, scene, decoder))
    read = [result.failure is None for result in together]
    assert 5 < sum(read) < len(read)  # the draw has signals that are read, and others


def test_a_light_without_code_is_refused_among_others_and_none_of_none_are_read() -> None:
    random = np.random.default_rng(5)
    profile, scene = draw(random)
    lamp = scene.replace(light="mains")
    results = decode_profiles([profile] * 3, [scene, lamp, scene], "sequence")
    assert [result.failure == occ.decode(profile, lamp).failure for result in results] == [
        False,
        True,
        False,
    ]
    assert decode_profiles([], [], "sequence") == []


@pytest.mark.parametrize("decoder", DECODERS)
@pytest.mark.parametrize(
    ("exposure", "frequency"),
    [(1e-9, 1e3), (1e-9, 1.0), (1.0, 1e6), (136e-6, 4e3), (136e-6, 124.9e3), (1e-3, 33e3)],
)
def test_no_profile_gives_a_warning_a_number_that_is_none_or_a_code_of_nothing(
    decoder: str, exposure: float, frequency: float
) -> None:
    random = np.random.default_rng(8)
    scene = occ.load_preset("phone-136us").replace(
        exposure_time=exposure, switching_frequency=frequency, enhancement="none", averaging="light"
    )
    for columns in (1, 2, 300):
        stripes = np.where(np.arange(columns) // 20 % 2, 200.0, 20.0)
        flat = [np.full(columns, 255.0), np.zeros(columns), 1e-300 * random.random(columns)]
        others = [-stripes, np.clip(9.0 * stripes, 0.0, 255.0), 1e5 * np.sign(stripes - 100.0)]
        others += [np.eye(columns)[columns // 2] * 255.0, random.normal(100.0, 30.0, columns)]
        results = decode_profiles([*flat, *others], [scene] * 8, decoder)
        assert all(result.failure is not None for result in results[:3])
        for result in results:
            for part in fields(result):
                value = getattr(result, part.name)
                if isinstance(value, float) or (
                    isinstance(value, np.ndarray) and value.dtype.kind == "f"
                ):
                    assert np.isfinite(value).all(), part.name
