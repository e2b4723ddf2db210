"""Laws of the waveform's running integral."""

import numpy as np

from occ_model.transmitter.waveform import Duration, Phases, Waveform

CHIPS = np.array([1, 0, 0, 1, 1], dtype=np.uint8)


def running_integral(phases: Phases) -> np.ndarray:
    """Light from the period's start up to each phase, in lit chips."""
    lit_before = np.concatenate([[0.0], np.cumsum(CHIPS)])
    return lit_before[phases.chip] + CHIPS[phases.chip % len(CHIPS)] * phases.fraction


def test_a_windows_light_is_the_difference_of_two_integrals() -> None:
    waveform = Waveform(CHIPS)
    starts = Phases(np.array([0, 0, 1, 2, 3]), np.array([0.0, 0.25, 0.5, 0.75, 0.125]))
    ends = Phases(starts.chip + 1, starts.fraction)
    within = waveform.lit_chips(starts, Duration(0, 1, 0.0))
    difference = running_integral(ends) - running_integral(starts)
    np.testing.assert_array_equal(within, difference)
    np.testing.assert_array_equal(running_integral(starts), [0.0, 0.25, 1.0, 1.0, 1.125])
