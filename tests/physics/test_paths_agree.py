"""Studies give the success rates of whole pictures, to within counting errors."""

import numpy as np
import pytest
from amount import amount
from physics.paths import compare_paths, significance

import occ_model as occ
from occ_model.results.sweep_request import RateSettings
from occ_model.study.success_rate import count_right_and_whole

IN_DOUBT = (50, 105, 150, 160, 182)  # scenes where a rate of one of the decoders is in doubt
SETTLED = (1, 2, 3)  # others


def every_second_column(preset: str, frequency: float) -> occ.Scene:
    """Return a preset's scene with half the columns, read in the same time, and few rows."""
    scene = occ.load_preset(preset)
    return scene.replace(
        rows=scene.camera.rows // 8,
        columns=scene.camera.columns // 2,
        readout_time=scene.camera.readout_time * 2,
        panel_width=scene.transmitter.panel_width * 1.2,
        switching_frequency=frequency,
    )


@pytest.mark.whole
def test_studies_agree_with_pictures_for_every_decoder() -> None:
    pairs = list(compare_paths((*IN_DOUBT, *SETTLED), images=16, seed=2))
    _, terms, probability = significance(pairs)
    assert terms >= len(IN_DOUBT)  # rates in doubt, by which they can differ
    assert probability > 0.01
    for pair in pairs:
        if not pair.is_in_doubt:
            assert abs(pair.study.mean() - pair.image.mean()) <= 0.1, pair


@pytest.mark.parametrize(
    "frequency",
    [
        pytest.param(14.2e3, marks=pytest.mark.whole),
        14.4e3,
        pytest.param(14.6e3, marks=pytest.mark.whole),
    ],
)
def test_a_study_s_rate_is_that_of_pictures(frequency: float) -> None:
    scene = every_second_column("phone-136us", frequency)
    by_study = occ.success_rate(scene, images=20)
    (read,), _ = count_right_and_whole(scene, RateSettings(20, ("threshold",), 99, path="image"))
    assert abs(by_study - 100.0 * read / (20 * scene.transmitter.bits)) <= 10.0


@pytest.mark.parametrize(
    "frequency",
    [
        pytest.param(10e3, marks=pytest.mark.whole),
        13.4e3,
        pytest.param(14e3, marks=pytest.mark.whole),
    ],
)
def test_a_sample_of_the_rows_has_the_rate_of_whole_pictures(frequency: float) -> None:
    scene = every_second_column("phone-136us-real", frequency)
    rates = {
        path: np.array(
            [
                count_right_and_whole(scene, RateSettings(1, ("threshold",), seed, path=path))[0]
                for seed in range(amount(6, 12))
            ]
        )
        / scene.transmitter.bits
        for path in ("rows", "image")
    }
    a, b = rates["rows"], rates["image"]
    error = np.sqrt((a.var() + b.var()) / len(a))
    assert abs(a.mean() - b.mean()) <= max(3.0 * error, 0.1)


def test_noise_left_out_by_hand_makes_the_paths_differ() -> None:
    # The power of the test: it detects noise that an earlier plan left out.
    scene = occ.load_preset("phone-136us").replace(switching_frequency=14.6e3)
    with_noise = occ.success_rate(scene, images=5)
    without = occ.success_rate(
        scene, images=5, force=dict.fromkeys(["sensor-noise", "fixed-pattern"], False)
    )
    assert without - with_noise > 50.0
    assert np.isfinite(without)
