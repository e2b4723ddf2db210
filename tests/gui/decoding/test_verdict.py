"""A verdict's heading and explanation say the decoder's reason once, in two parts."""

import numpy as np
import pytest

from occ_gui.decoding.verdict import Verdict, share_read
from occ_gui.widgets.state_look import State
from occ_model.results import DecodeResult


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


def test_the_share_that_was_read_is_that_of_the_right_bits() -> None:
    sent = (1, 0, 1, 1)
    for bits, share in (([1, 0, 1, 1], 1.0), ([1, 0, 1, 0], 0.75), ([0, 1, 0, 0], 0.0)):
        read = DecodeResult("threshold", code=1, bits=np.array(bits, dtype=np.uint8))
        assert share_read(read, sent) == share
        assert share_read(read, ()) is None
    assert share_read(DecodeResult("threshold", failure="No header was found."), sent) == 0.0
