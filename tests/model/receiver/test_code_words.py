"""The words of a scheme lead from states of its encoder to others, and runs have their limit."""

from itertools import groupby, product

import pytest

from occ_model.receiver.sequence.code_words import _of_runs, code_words
from occ_model.receiver.sequence.trellis import places_of
from occ_model.scene.scene import Scene


@pytest.mark.parametrize("line_code", ["nrz", "differential-manchester", "8b10b"])
def test_headers_lead_between_the_states_of_the_encoder_only(line_code: str) -> None:
    found = code_words(
        Scene().replace(line_code=line_code, framing="preamble").transmitter, memory=6
    )
    headers = [word for word in found.words if word.chips == found.header]
    blocks = [word for word in found.words if word.chips != found.header]
    states = {word.before for word in blocks}
    assert found.header
    assert {word.after for word in blocks} <= states
    # After a header the encoder may be in any state, as its frame may go on from any.
    assert {(word.before, word.after) for word in headers} == set(product(states, states))


@pytest.mark.parametrize("longest", [1, 2, 3])
def test_chips_with_limited_runs_are_all_those_without_a_longer_run(longest: int) -> None:
    steps = places_of(_of_runs(longest))

    def can_be_sent(chips: tuple[int, ...]) -> bool:
        places = set(range(len(steps)))
        for chip in chips:
            places = {to for place in places for sent, to in steps[place] if sent == chip}
        return bool(places)

    for chips in product((0, 1), repeat=6):
        runs = [len(list(run)) for _, run in groupby(chips)]
        assert can_be_sent(chips) == (max(runs) <= longest), chips
