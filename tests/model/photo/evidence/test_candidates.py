"""Which chips are read from a photo, which are fitted again, and which others explain it best."""

from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from hypotheses import hypothesis
from lit_fractions import light_of
from simulated_photos import take

import occ_model as occ
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.evidence.other_codes import nearest_other
from occ_model.photo.fit.camera_response import camera_responses
from occ_model.photo.fit.chip_runs import canonical
from occ_model.photo.fit.timing import Timing
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import sent_chips

NEAR = occ.load_preset("phone-68us").replace(
    rows=60, columns=1200, distance=0.3, enhancement="none", averaging="light", code=345,
    switching_frequency=12e3,
)  # fmt: skip
"""A panel that is wider than the picture, of 20.8 columns a chip."""


class Case:
    """The hypotheses about the stripes in a photo of ``scene``, for a user who assumes ``told``."""

    def __init__(self, scene: Scene, columns: int = 1200, told: Scene | None = None) -> None:
        self.check = Mock()  # called again and again while chips are read or fitted
        told = told or scene
        stripes = occ.find_stripes(take(scene), (0, 60, 0, columns))
        low, high = float(np.median(stripes.low)), float(np.median(stripes.high))
        cameras = camera_responses(told, ("light",), low, high)
        self.candidates = Candidates(
            stripes, told, cameras,
            fit_gamma=False, estimate="readout_time", noted=None, check=self.check,
        )  # fmt: skip

    def as_sent(self) -> Hypothesis:
        found = self.candidates.as_sent()
        assert found is not None
        self.check.reset_mock()
        return found


def is_of(found: Hypothesis, scene: Scene) -> bool:
    return np.array_equal(canonical(found.chips), canonical(sent_chips(scene.transmitter)))


def test_chips_that_are_explained_well_are_not_fitted_again_however_they_are_rotated() -> None:
    scene = NEAR.replace(switching_frequency=6e3, pattern="110100")
    case = Case(scene, columns=400, told=scene.replace(pattern="001101"))
    sent = case.as_sent()
    assert sent.fit.correlation > 0.99
    assert sent.information < 100.0
    assert case.candidates.read(sent) == []
    case.check.assert_called()
    (read,) = case.candidates.read()
    assert is_of(read, scene)
    assert not np.array_equal(read.chips, sent.chips)


def test_nothing_is_read_where_the_chips_given_are_sure() -> None:
    case = Case(NEAR)
    sent = case.as_sent()
    assert case.candidates.read(sent) == []
    case.check.assert_not_called()


def test_where_nothing_explains_the_stripes_well_chips_are_read_again_in_another_way() -> None:
    bright = {"exposure_time": 0.8 / 12e3, "luminance": 1500.0 * NEAR.transmitter.luminance}
    overexposed = NEAR.replace(pattern="11101000", point_spread=2.0, iso=50.0, **bright)
    found = Case(overexposed, told=NEAR).candidates.read()
    first = [one for one in found if not one.read_again]
    assert max(one.fit.correlation for one in first) < 0.98
    assert len(found) > len(first) > 0
    assert not any(
        one.read_again for one in Case(NEAR, told=NEAR.replace(code=1)).candidates.read()
    )


def test_stripes_that_do_not_repeat_are_not_read() -> None:
    case = Case(NEAR.replace(switching_frequency=6e3, pattern="110100"), columns=200)
    assert case.candidates.stripes.period is None
    assert case.candidates.read() == []


@pytest.mark.parametrize(
    ("changes", "name"),
    [({"code": 345}, "the code 0101011001"), ({"pattern": "110100"}, "a code of 6 chips")],
)
def test_chips_are_named_by_their_code_or_number(changes: dict[str, Any], name: str) -> None:
    found = Case(NEAR.replace(**changes), told=NEAR).candidates.read()
    assert max(found, key=lambda one: one.fit.correlation).sent == f"{name} read from the photo"


TIMING = Timing(0.08, 1.3, 4.2, 2.2)
COLUMNS = 400


@pytest.mark.parametrize("wrong", [[3], [5, 6]])
def test_chips_that_were_misread_are_set_right(wrong: list[int]) -> None:
    """One of them, or two neighbours that are exchanged."""
    chips = np.array([1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 0], dtype=np.uint8)
    profile = 40.0 + 100.0 * light_of(chips, TIMING, COLUMNS)
    read = chips.copy()
    read[wrong] ^= 1
    found = nearest_other(profile, hypothesis(read, TIMING, COLUMNS), occ.Scene().transmitter)
    assert found.tolist() == chips.tolist()


def test_all_codes_of_a_packet_are_compared_however_they_are_rotated() -> None:
    scene = occ.Scene()
    right, wrong = (sent_chips(scene.replace(code=code).transmitter) for code in (345, 718))
    profile = 40.0 + 100.0 * light_of(np.roll(right, 5), TIMING, COLUMNS)
    found = nearest_other(profile, hypothesis(wrong, TIMING, COLUMNS), scene.transmitter)
    assert found.tolist() == np.roll(right, 5).tolist()


def test_neither_the_same_chips_rotated_nor_chips_without_a_change_are_others() -> None:
    chips = np.array([1, 0, 0, 0], dtype=np.uint8)
    rotated = np.roll(chips, 1)
    profile = 40.0 + 100.0 * light_of(rotated, TIMING, COLUMNS)
    found = nearest_other(profile, hypothesis(chips, TIMING, COLUMNS), occ.Scene().transmitter)
    assert 0 < found.sum() < 4
    assert sorted(found.tolist()) != sorted(chips.tolist())
    many = hypothesis(np.zeros(5000, np.uint8), TIMING, COLUMNS)
    assert nearest_other(np.zeros(9), many, occ.Scene().transmitter) is None
