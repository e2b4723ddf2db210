"""Laws of the waveform's running integral."""

import numpy as np

from occ_model.transmitter.waveform import Duration, Phases, Waveform


def test_light_within_a_window_is_the_difference_of_two_running_integrals() -> None:
    waveform = Waveform(np.array([1, 0, 0, 1, 1], dtype=np.uint8))
    starts = Phases(np.array([0, 0, 1, 2, 3]), np.array([0.0, 0.25, 0.5, 0.75, 0.125]))
    ends = Phases(starts.chip + 1, starts.fraction)
    within = waveform.lit_chips(starts, Duration(0, 1, 0.0))
    difference = waveform.running_integral(ends) - waveform.running_integral(starts)
    np.testing.assert_array_equal(within, difference)
    np.testing.assert_array_equal(waveform.running_integral(starts), [0.0, 0.25, 1.0, 1.0, 1.125])
