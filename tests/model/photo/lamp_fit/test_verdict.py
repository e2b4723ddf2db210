"""Laws of the sentences on why a lamp's fit is doubted."""

from dataclasses import fields

from occ_model.photo.lamp_fit.cues import Cues
from occ_model.photo.lamp_fit.verdict import doubts


def test_a_limit_that_is_hardly_exceeded_is_told_from_the_value_that_exceeds_it() -> None:
    known = {"floor_expected": 1.2, "edges": 20, "white": 0.203, "gamma": 2.2, "period": 40.0}
    cues = Cues(**{each.name: known.get(each.name, 0) for each in fields(Cues)})  # type: ignore[arg-type]
    (sentence,) = (
        text for text in doubts(cues, 99.0, None, is_confirmed=True) if "white columns" in text
    )
    assert "at most 20.0 % white columns, of which there are 20.3 %" in sentence
