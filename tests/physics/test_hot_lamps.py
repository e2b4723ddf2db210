"""Lamps as they are found in rooms: what is surely told of them holds."""

import numpy as np
import pytest
from photo_world.hot_lamps import hot_lamps
from photo_world.trials import hot_trial_of


def test_a_picture_shows_what_its_truth_says() -> None:
    """In the lamp's rows a square wave's strongest frequency is one cycle each two chips."""
    for seed in range(100, 110):
        drawn = hot_lamps(seed)
        (sent,), (thing,) = drawn.sent, drawn.lamps
        if sent.chips != "10" or sent.pauses or drawn.exposure > sent.chip:
            continue
        rows = slice(round(thing.row) - 8, round(thing.row) + 8)
        columns = slice(max(0, round(thing.box[2]) + 5), round(thing.box[3]) - 5)
        line = drawn.image[rows, columns].mean(axis=0)
        tone = np.hanning(len(line)) * (line - line.mean())
        cycles = np.fft.rfftfreq(16 * len(line))
        power = np.abs(np.fft.rfft(tone, 16 * len(line)))
        fast = cycles > 3.0 / len(line)
        found = cycles[fast][power[fast].argmax()]
        assert found == pytest.approx(0.5 / sent.chip, abs=1.0 / len(line))


@pytest.mark.parametrize(
    "seeds", [(101,), pytest.param((100, *range(102, 110)), marks=pytest.mark.whole)]
)
def test_no_lamp_is_surely_wrong(seeds: tuple[int, ...]) -> None:
    sure = [one for one in map(hot_trial_of, seeds) if one.is_sure]
    assert sure
    assert [one.seed for one in sure if abs(one.readout) > 0.01] == []
    assert [one.seed for one in sure if one.readout_deviation > 0.03] == []
