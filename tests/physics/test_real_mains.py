"""Real pairs of pictures under mains lamps give one camera's readout time; slats give none."""

from pathlib import Path

import pytest
from photo_world.mains_pairs import Truth, measure_truth, pictures

pytestmark = pytest.mark.photos

FRAMES = (0.0295, 0.0305)  # seconds between which one camera's readout of a frame is known to be


@pytest.fixture(scope="module")
def found(photos: Path) -> list[Truth]:
    folder = photos / "mains"
    if not folder.is_dir():
        pytest.skip("the pictures of other people are not here")
    return pictures(folder, 50.0)


def test_all_pairs_are_sure_and_agree(found: list[Truth]) -> None:
    pairs = [measure_truth(truth) for truth in found if len(truth.files) == 2]
    assert len(pairs) >= 3
    for pair in pairs:
        assert pair.verdict == "sure", pair.says
        assert FRAMES[0] < pair.value < FRAMES[1]
        assert pair.error < 0.01 * pair.value


@pytest.mark.whole
def test_rooms_and_slats_in_one_picture_are_not_sure(found: list[Truth]) -> None:
    singles = [truth for truth in found if len(truth.files) == 1]
    rooms = [truth for truth in singles if truth.files[0].suffix == ".png"]
    assert len(rooms) >= 5
    assert "sure" not in {measure_truth(truth).verdict for truth in rooms}


@pytest.mark.whole
def test_of_walls_the_bent_one_is_refused_and_the_other_measured(found: list[Truth]) -> None:
    walls = [truth for truth in found if truth.files[0].suffix == ".jpg"]
    measured = {result.verdict: result for result in map(measure_truth, walls)}
    # In one picture an even wall and level slats with soft edges look the same.
    assert set(measured) == {"doubtful", "refused"}
    assert "lens" in measured["refused"].says
    bars = 2.0 * 60.0 * 0.05081  # published, of light at 120 Hz
    assert measured["doubtful"].value * 100.0 == pytest.approx(bars, rel=0.005)
