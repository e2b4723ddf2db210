"""A match in one sentence: what is known, what was measured, and how sure that is."""

import pytest
from matches import match_of_lamp, match_with

from occ_model.results.match_sentence import describe_match

TIMES = {"readout_time": 2.7e-10, "exposure_time": 2.1e-7}


def test_a_camera_is_measured_by_a_lamp_or_a_code_of_known_frequency() -> None:
    camera = "your camera reads a line in 14.57770 ± 0.00027 µs; "
    rest = camera + "exposed for 62.50 ± 0.21 µs; sure."
    assert describe_match(match_with()) == f"Code of 2 kHz: {rest}"
    assert describe_match(match_of_lamp()) == f"Lamp of 1 kHz: {rest}"
    assert describe_match(match_of_lamp(), "if it is a lamp of 1 kHz: ") == (
        f"If it is a lamp of 1 kHz: {rest}"
    )
    dimmed = match_of_lamp(0.6, uncertainties={**TIMES, "duty": 0.01})
    assert f"{camera}lit for 60.0 ± 1.0 % of the time; exposed for" in describe_match(dimmed)


def test_a_frequency_is_measured_by_a_known_camera() -> None:
    measured = match_of_lamp(uncertainties={"lamp_frequency": 0.3, "exposure_time": 2.1e-7})
    start = "Lines read in 14.5777 µs: lamp of 1.00000 ± 0.00030 kHz; exposed for "
    assert describe_match(measured).startswith(start)


@pytest.mark.parametrize(
    ("reasons", "exposure_reasons", "end"),
    [
        ((), (), "; exposed for 62.50 ± 0.21 µs; sure."),
        (("Why.",), (), "; exposed for 62.50 ± 0.21 µs; doubtful."),
        (("Why.",), ("How.",), "; exposed for 62.50 ± 0.21 µs; doubtful."),
        ((), ("How.",), "; exposed for 62.50 ± 0.21 µs (doubtful); sure otherwise."),
    ],
)
def test_what_is_doubtful_is_called_so_once(
    reasons: tuple[str, ...], exposure_reasons: tuple[str, ...], end: str
) -> None:
    match = match_with(reasons=reasons, exposure_reasons=exposure_reasons)
    assert describe_match(match).endswith(end)


def test_duty_and_exposure_are_doubtful_together() -> None:
    match = match_of_lamp(
        0.6, uncertainties={**TIMES, "duty": 0.01}, exposure_reasons=("Two readings.",)
    )
    end = "; lit for 60.0 ± 1.0 % of the time and exposed for 62.50 ± 0.21 µs (both doubtful); "
    assert f"{end}sure otherwise." in describe_match(match)


def test_a_limit_of_the_exposure_is_stated_as_one() -> None:
    spreads = {**TIMES, "exposure_time": 15e-6}
    sentence = describe_match(match_with(exposure_time=6e-6, uncertainties=spreads))
    assert "; exposed below 36 µs (6 ± 15 µs); sure." in sentence
