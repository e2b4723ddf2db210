"""Laws of the sentences on why a lamp's fit is doubted."""

from dataclasses import fields

import numpy as np
import pytest

from occ_model.photo.lamp_fit.cues import Cues, cues_of
from occ_model.photo.lamp_fit.fit import fit_lamp
from occ_model.photo.lamp_fit.profile import LampProfile
from occ_model.photo.lamp_fit.verdict import doubts


@pytest.mark.parametrize(
    ("measured", "said"),
    [
        ({"floor_expected": 1.2, "white": 0.203}, "at most 20.0 % white columns, of which there"),
        ({"misfit": 0.0604}, "by 6.04 % of their height from a lamp's; at most 6.00 %."),
        ({"blur": 0.903}, "a lamp are blurred over 0.85 at most."),
        ({"unusual_tone": 6.04}, "by 6.04 standard deviations from usual ones; at most 6.00."),
        ({"floor": 6.1}, "Between the stripes there is 610 % of their height"),
    ],
)
def test_a_measure_and_its_limit_are_told_apart_in_plain_numbers(
    measured: dict[str, float], said: str
) -> None:
    known = {"edges": 20, "period": 40.0, "narrowest": 20.0} | measured
    cues = Cues(**{each.name: known.get(each.name, 0) for each in fields(Cues)})  # type: ignore[arg-type]
    (sentence,) = (text for text in doubts(cues, 99.0, None, is_confirmed=True) if said in text)
    assert sentence


def test_a_blur_as_of_things_is_doubted_unless_a_note_or_a_duty_confirms_the_lamp() -> None:
    known = {"edges": 40, "period": 40.0, "narrowest": 20.0, "ramp": 10.0, "blur": 1.5}
    cues = Cues(**{each.name: known.get(each.name, 0) for each in fields(Cues)})  # type: ignore[arg-type]
    assert not doubts(cues, 99.0, None, is_confirmed=True)
    assert "1.50 columns, as a lens blurs" in " ".join(doubts(cues, 99.0, None, is_confirmed=False))


def test_edges_in_the_dark_are_no_evidence_of_a_period() -> None:
    columns = np.arange(70.0)
    lit = sum(np.clip(4.0 - np.abs(columns - at), 0.0, 1.0) for at in (4.0, 66.0))
    profile = LampProfile(np.asarray(0.01 + 0.8 * lit), np.full(70, 1e-6), np.zeros(70, dtype=bool))
    fit = fit_lamp(profile, [15.0])[0]
    assert fit.wave.period < 20.0  # with stripes in the dark between the two
    assert cues_of(fit, profile.values[None]).edges <= 6
