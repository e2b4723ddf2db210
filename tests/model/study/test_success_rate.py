"""Laws of the success rate and of the two ways to measure it."""

import itertools
from collections.abc import Callable

import numpy as np
import pytest

import occ_model as occ
from occ_model.results.decoding import DecodeResult
from occ_model.results.sweep_request import RateSettings, SignalPath
from occ_model.scene.scene import Scene
from occ_model.study import success_rate as module


@pytest.fixture
def scene() -> Scene:
    """Return a phone whose sensor has few rows, so that whole images are fast."""
    return occ.load_preset("phone-136us").replace(rows=250, panel_height=0.05, distance=1.0)


def test_the_same_seed_gives_the_same_rate_and_another_seed_other_images() -> None:
    # So far away that two headers fit only at some start times.
    far = occ.load_preset("phone-136us").replace(switching_frequency=4e3, distance=1.8)
    found = [occ.success_rate(far, 3, seed=seed) for seed in (1, 1, 2, 3, 4, 5)]
    assert found[0] == found[1]
    assert len(set(found)) > 1


def test_the_rate_is_the_fraction_of_correct_bits_and_only_accepted_payloads_are_whole(
    scene: Scene, offer_decoders: Callable[..., None]
) -> None:
    sent = np.array([1, 0, 1, 1, 0, 0, 1, 1, 1, 0], dtype=np.uint8)
    three_wrong = sent.copy()
    three_wrong[:3] ^= 1
    results = [
        DecodeResult("x", bits=sent, code=718),
        DecodeResult("x", bits=three_wrong, code=int("".join(map(str, three_wrong)), 2)),
        DecodeResult("x", failure="Nothing."),
        DecodeResult("x", bits=sent[:4], failure="It is cut."),
        DecodeResult("x", bits=sent, failure="The chips are not certain enough."),
    ]
    given = itertools.cycle(results)
    offer_decoders(x=lambda *_: next(given))
    sending = scene.replace(code=718)
    assert module.count_right_and_whole(sending, RateSettings(5, ("x",))) == ((17,), (1,))
    assert occ.success_rate(sending, 5, "x") == pytest.approx(100 * 17 / 50)


@pytest.mark.parametrize("changes", [{"roll": 0.02}, {"yaw": 0.3}, {"point_spread": 3.0}])
def test_every_name_of_a_path_without_pixels_measures_the_same(
    scene: Scene, changes: dict[str, float]
) -> None:
    at = scene.replace(switching_frequency=14.3e3, **changes)
    rates = {occ.success_rate(at, 4, path=path) for path in ("auto", "profile", "rows")}
    assert len(rates) == 1
    assert occ.success_rate(scene.replace(**changes), 1) == 100.0


def test_a_panel_outside_the_picture_is_never_read(scene: Scene) -> None:
    assert occ.success_rate(scene.replace(offset_x=50.0), 2) == 0.0


def test_a_scene_with_too_large_a_picture_has_no_success_rate(scene: Scene) -> None:
    large = scene.replace(rows=100_000, columns=1_000_000)
    for study in (occ.success_rate, occ.bit_error_rate):
        with pytest.raises(occ.ProjectionError, match="100000 million pixels; allowed"):
            study(large)


def test_a_raw_pattern_has_no_success_rate(scene: Scene) -> None:
    with pytest.raises(occ.ParameterError, match="raw pattern"):
        occ.success_rate(scene.replace(pattern="0110"))


def test_a_rate_does_not_depend_on_which_of_its_pictures_are_kept_from_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # So far away that two headers fit only at some start times.
    at = occ.load_preset("phone-136us").replace(switching_frequency=4e3, distance=1.8)
    alone = occ.success_rate(at, 10, seed=83)
    assert 0.0 < alone < 100.0
    monkeypatch.setattr(module, "_MOST_KEPT", 12)
    module._observed.clear()
    occ.success_rate(at, 5, seed=83)
    occ.success_rate(at, 7, seed=84)  # now those of the first rate are the oldest
    assert occ.success_rate(at, 10, seed=83) == alone


@pytest.mark.parametrize("path", ["auto", "image"])
def test_a_picture_of_a_few_noisy_pixels_is_read(path: SignalPath) -> None:
    few = occ.load_preset("phone-68us").replace(
        rows=1, columns=3, distance=0.3, yaw=1.0, offset_x=0.5, full_well=100.0, adc_bits=8
    )
    assert occ.success_rate(few, 2, path=path) == 0.0
