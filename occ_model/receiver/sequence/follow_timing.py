"""Follow the chips from the middle of the picture outwards, where their timing is not exact.

A readout time that is 1 % off is half a chip at the ends of 96 chips, and several chips over a
picture. What is detected in the middle gives the timing there, which holds for a part twice as
large; and so on to the whole picture.
"""

from dataclasses import replace

from occ_model.receiver.sequence.exposures import Timing
from occ_model.receiver.sequence.fit import (
    TRIED_CHIPS,
    Brightness,
    Rows,
    detect,
    improve,
)
from occ_model.receiver.sequence.trellis import Word

_MAX_TURNS = 8  # iterations of a part's timing; each moves its ends by at most 0.1 chips
_CONVERGED_CHIPS = 0.01  # motion of a part's ends in chips below which the fit has converged


def follow_timing(
    rows: Rows, timing: Timing, brightness: Brightness, words: tuple[Word, ...]
) -> Timing:
    """Improve a timing that fits the middle, and may be some percent off from row to row."""
    count = len(rows.light)
    size = round((TRIED_CHIPS + timing.exposure) / timing.step)
    while True:
        size = min(size, count)
        timing = _in_part(rows, timing, brightness, words, size)
        if size == count:
            return timing
        size *= 2


def _in_part(
    rows: Rows, timing: Timing, brightness: Brightness, words: tuple[Word, ...], size: int
) -> Timing:
    first = (len(rows.light) - size) // 2
    part = slice(first, first + size)
    seen = replace(rows, light=rows.light[part])
    bright = Brightness(brightness.dark[part], brightness.swing[part])
    here = replace(timing, phase=timing.phase + timing.step * first)
    for _ in range(_MAX_TURNS):
        before = here
        here, _bright = improve(seen, detect(seen, here, bright, words))
        if abs(here.step - before.step) * size < _CONVERGED_CHIPS:
            break
    return replace(here, phase=here.phase - here.step * first)
