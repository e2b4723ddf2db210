"""The timing of the columns' exposures over the chips, and the light that they gather."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, FloatArray

SHORTEST_EXPOSURE = 1e-3  # shortest exposure in chips: shorter ones make the same stripes


@dataclass(frozen=True, slots=True)
class Timing:
    """The timing of the columns' exposures, in chips."""

    step: float  # chips from one column's start to the next one's: t_r / t_LED
    exposure: float  # chips that an exposure lasts: t / t_LED
    # Position in the period of the chips of the middle of the middle column's exposure. Unlike the
    # first column's start it hardly correlates with the other two.
    middle: float
    gamma: float  # the exponent of the camera's response

    def start(self, columns: int) -> float:
        """Return the position in the chips at which the first column's exposure starts."""
        return self.middle - 0.5 * self.step * (columns - 1) - 0.5 * self.exposure


@dataclass(frozen=True, eq=False, slots=True)
class ExposedColumns:
    """What the columns' exposures contain, each of shape (columns and those beside,)."""

    lit: FloatArray  # the fraction of the time in which the LED is on
    levels: tuple[FloatArray, FloatArray]  # whether it is on where an exposure starts and ends
    edges: FloatArray  # how often it turns on or off meanwhile
    exposure: float

    def slopes(self) -> FloatArray:
        """Return the lit fractions' slopes over step, exposure and middle, shape (3, columns).

        A later exposure gains the light at its end and loses that at its start.
        """
        first, last = self.levels
        later = (last - first) / self.exposure
        longer = (0.5 * (last + first) - self.lit) / self.exposure
        from_middle = np.arange(len(self.lit)) - 0.5 * (len(self.lit) - 1)
        return np.stack([later * from_middle, longer, later])


class ChipLight:
    """The light of chips that are sent repeatedly.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        One period, neither all on nor all off.
    columns
        Of the picture.
    beside
        Columns beyond either end that are exposed, too.
    """

    def __init__(self, chips: ByteArray, columns: int, beside: int = 0) -> None:
        self._period, self._columns = len(chips), columns
        self._places = np.arange(-beside, columns + beside)
        change = chips.astype(np.int64) - np.roll(chips, 1)
        places = np.flatnonzero(change)
        turns = np.concatenate([places - self._period, places, places + self._period])
        self._edges = turns.astype(np.float64)
        self._changes = np.tile(change[places], 3).astype(np.float64)
        # After each edge; the level before it is that of the edge before.
        self._levels = np.tile(chips[places], 3).astype(np.float64)
        self._a_period = len(places)
        # Slopes are needed where the light has just been computed.
        self.expose = lru_cache(maxsize=1)(self._integrate)

    def _integrate(self, timing: Timing, longer: float = 0.0) -> ExposedColumns:
        """Integrate the light over the exposures of all columns.

        ``longer``: chips by which each time on is longer than the chips say.
        """
        edges = self._edges - 0.5 * longer * self._changes
        # The running integral has corners at the edges; it is 0 at the first of them.
        integral = np.concatenate([[0.0], np.cumsum(self._levels[:-1] * np.diff(edges))])
        light = integral[self._a_period] - integral[0]
        start = timing.start(self._columns) + timing.step * self._places
        ends = np.stack([start, start + timing.exposure])
        turns = np.floor(ends / self._period)
        ends -= turns * self._period
        passed = np.searchsorted(edges, ends.ravel()).reshape(ends.shape) - 1
        level = self._levels.take(passed)
        until = turns * light + integral.take(passed) + level * (ends - edges.take(passed))
        number = passed + turns * self._a_period
        return ExposedColumns(
            (until[1] - until[0]) / timing.exposure,
            (level[0], level[1]),
            number[1] - number[0],
            timing.exposure,
        )
