"""A verdict's heading and explanation say the decoder's reason once, in two parts."""

import pytest

from occ_gui.simulation.verdict import Verdict
from occ_gui.widgets.state_look import State


@pytest.mark.parametrize(
    ("state", "reason", "heading", "explanation"),
    [
        (State.BAD, "No header fits: come closer.", "No code: no header fits", "Come closer."),
        (State.BAD, "No header fits.", "No code: no header fits", None),
        (State.BAD, "No code stands out: 1, 2.", "No code stands out", "1, 2."),
        (State.BAD, "", "Title", ""),
        (State.DOUBTFUL, "Half fits: look.", "Title", "Half fits: look."),
    ],
)
def test_the_reason_is_divided_between_heading_and_explanation(
    state: State, reason: str, heading: str, explanation: str | None
) -> None:
    verdict = Verdict(state, "Title", reason)
    assert verdict.heading == heading
    if explanation is not None:
        assert verdict.explanation == explanation
