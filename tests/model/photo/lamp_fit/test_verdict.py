"""Laws of the sentences on why a lamp's fit is doubted."""

from dataclasses import fields

import pytest

from occ_model.photo.lamp_fit.cues import Cues
from occ_model.photo.lamp_fit.verdict import doubts


@pytest.mark.parametrize(
    ("measured", "said"),
    [
        ({"floor_expected": 1.2, "white": 0.203}, "at most 20.0 % white columns, of which there"),
        ({"misfit": 0.0604}, "by 6.04 % of their height from a lamp's; at most 6.00 %."),
        ({"floor": 6.1}, "Between the stripes there is 610 % of their height"),
    ],
)
def test_a_measure_and_its_limit_are_told_apart_in_plain_numbers(
    measured: dict[str, float], said: str
) -> None:
    known = {"edges": 20, "gamma": 2.2, "period": 40.0, "narrowest": 20.0} | measured
    cues = Cues(**{each.name: known.get(each.name, 0) for each in fields(Cues)})  # type: ignore[arg-type]
    (sentence,) = (text for text in doubts(cues, 99.0, None, is_confirmed=True) if said in text)
    assert sentence
