"""Rows of a draft: as many as the screen shows, and fewer where that takes too long."""

from collections import deque

from occ_gui.values.simulated import LEAST_DRAFT_STEP

LONGEST = 0.016
"""Seconds that a draft and its reading may take: the window needs as long to show them."""

THINNEST = 4  # rows of the screen that a row of a draft fills at most

LEAST_ROWS = 64
"""Rows of a draft below which it is not thinned: fewer save no time, and show too little."""

_AMPLE = 3.0
"""How many times faster than allowed a thinned draft is before the next one has twice its rows.

More than 2: what is thinned because it took too long takes at least half of that time, and is not
made finer and thinner in turn.
"""


class DraftRows:
    """Chooses which rows of a picture its draft has.

    Each row of a draft fills one row of the screen, or 2 or 4 where drafts are late. A single late
    one changes nothing: the machine may have been busy with other things.
    """

    def __init__(self) -> None:
        self._thinned = 1
        self._seconds: deque[float] = deque(maxlen=2)

    def step(self, rows: int, rows_per_pixel: float) -> int:
        """Return of how many rows of the picture the draft has one.

        ``rows_per_pixel``: rows of the picture that share a pixel of the screen.
        """
        shown = max(LEAST_DRAFT_STEP, int(rows_per_pixel))
        wanted = shown * self._thinned
        return min(max(shown, min(wanted, rows // LEAST_ROWS)), rows)

    def took(self, seconds: float) -> None:
        """Learn how long the last draft and its reading have taken."""
        self._seconds.append(seconds)
        if len(self._seconds) < 2:
            return
        if min(self._seconds) > LONGEST and self._thinned < THINNEST:
            self._change(2 * self._thinned)
        elif max(self._seconds) < LONGEST / _AMPLE and self._thinned > 1:
            self._change(self._thinned // 2)

    def _change(self, thinned: int) -> None:
        self._thinned = thinned
        self._seconds.clear()
