"""Studies give the success rates of whole pictures, to within counting errors."""

import pytest
from physics.paths import compare_paths, significance

import occ_model as occ

IN_DOUBT = (3, 50, 105, 150, 160, 187, 197)  # scenes where a rate is in doubt
SETTLED = (1, 2, 182)  # others


@pytest.mark.whole
def test_studies_agree_with_pictures_for_every_decoder() -> None:
    pairs = list(compare_paths((*IN_DOUBT, *SETTLED), images=16, seed=2))
    _, _, probability = significance(pairs)
    assert {pair.number for pair in pairs if pair.is_in_doubt} == set(IN_DOUBT)
    assert probability > 0.01
    for pair in pairs:
        if not pair.is_in_doubt:
            assert abs(pair.study.mean() - pair.image.mean()) <= 0.1, pair


def test_noise_left_out_by_hand_makes_the_paths_differ() -> None:
    # The power of the test: it detects noise that an earlier plan left out.
    scene = occ.load_preset("phone-136us").replace(switching_frequency=14.6e3)
    with_noise = occ.success_rate(scene, images=5)
    without = occ.success_rate(
        scene, images=5, force=dict.fromkeys(["sensor-noise", "fixed-pattern"], False)
    )
    assert without - with_noise > 50.0
