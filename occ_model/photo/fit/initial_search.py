"""Search for timings to start a fit from: those at which given chips correlate with a profile.

The chips' profile has a line spectrum, the harmonics of its period. For each number of chips per
column the profile's spectrum is sampled at these harmonics, and one short inverse Fourier transform
gives the correlation with the chips at every phase.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.photo.fit.timing import Timing

_EXPOSURES = (0.15, 0.5, 0.85, 1.3, 1.7, 2.3, 2.7, 3.3, 3.7, 4.3, 4.7, 5.4, 6.3, 7.2)
"""Exposures that are tried, in chips."""

_ROUGH_EXPOSURES = (0.3, 1.4, 2.4, 3.5, 5.4)  # exposures with which all steps are compared
_MOST_STEP = 0.95  # maximum number of chips per column

_PADDING = 4  # length of the Fourier transform over the number of columns
_PHASES_A_CHIP, _ROUGH_PHASES_A_CHIP = 8, 2

_STEPS_PER_CHIP = 3.0  # number of steps tried while the last column moves by one chip
_BEST_STEPS = 24  # number of steps with which all exposures are compared
_AT_ONCE = 2**19  # maximum number of array elements at once, which bounds the memory


@dataclass(frozen=True, slots=True)
class TimingCandidate:
    timing: Timing
    correlation: float


class TimingSearch:
    """Correlates a profile with chips at any timing."""

    def __init__(self, flattened: FloatArray, chips: ByteArray) -> None:
        about = flattened - flattened.mean()
        self._columns, self._period = len(flattened), len(chips)
        size = _PADDING * self._columns
        # Phases refer to the middle of the profile, where a step's error changes them least. For an
        # even number of columns it lies between two of them, and the phase factor repeats after two
        # periods of the spectrum: so the spectrum is tiled twice.
        turn = np.exp(1j * np.pi * (self._columns - 1) / size * np.arange(2 * size))
        self._turned = (np.tile(np.fft.fft(about, size), 2) * turn).astype(np.complex64)
        self._power = float(about @ about)
        self._harmonics = np.arange(1, 2 * self._period + 1)
        lines = np.fft.fft(chips)[self._harmonics % self._period] / self._period
        # A chip is a box of length one: the spectrum of impulses times that of the box.
        self._lines = lines * np.sinc(self._harmonics / self._period)

    def steps(self) -> FloatArray:
        slowest = max(1.5, 0.75 * self._period) / self._columns
        count = int(np.ceil((_MOST_STEP - slowest) * self._columns * _STEPS_PER_CHIP))
        return slowest + np.arange(max(1, count)) / (self._columns * _STEPS_PER_CHIP)

    def candidates(
        self, steps: FloatArray | None, gamma: float, check: Callable[[], object] = lambda: None
    ) -> list[TimingCandidate]:
        """Find each exposure's best timing, best first; what ``check`` raises ends the search.

        ``steps``: chips per column to try, None for all that are possible.
        """
        steps = self.steps() if steps is None else steps
        rough = np.zeros(len(steps))
        together = max(1, _AT_ONCE // (_PHASES_A_CHIP * self._period))
        slow = self._harmonics[: self._period]
        for first in range(0, len(steps), together):
            part = slice(first, first + together)
            seen = self._sample(steps[part], slow)
            for exposure in _ROUGH_EXPOSURES:
                check()
                scores = self._scores(seen, exposure, _ROUGH_PHASES_A_CHIP)[0]
                rough[part] = np.maximum(rough[part], scores)
        best = steps[np.argsort(rough)[-_BEST_STEPS:]]
        seen = self._sample(best, self._harmonics)
        found = []
        for exposure in _EXPOSURES:
            check()
            scores, phases = self._scores(seen, exposure, _PHASES_A_CHIP)
            top = int(scores.argmax())
            timing = Timing(float(best[top]), exposure, float(phases[top]), gamma)
            found.append(TimingCandidate(timing, float(scores[top])))
        return sorted(found, key=lambda candidate: -candidate.correlation)

    def _scores(
        self, seen: NDArray[np.complex64], exposure: float, phases_a_chip: int
    ) -> tuple[FloatArray, FloatArray]:
        """Return the best correlation over all phases, and the phase of the middle that has it."""
        # Imported only when a photo is matched: it is slow.
        from scipy.fft import irfft

        harmonics = self._harmonics[: seen.shape[1]]
        # An exposure is a box too, whose phase refers to its middle.
        lines = self._lines[: len(harmonics)] * np.sinc(harmonics * (exposure / self._period))
        energy = 2.0 * float((np.abs(lines) ** 2).sum()) * self._columns
        phases = phases_a_chip * self._period
        # In single precision, which is far finer than the correlations that are compared.
        products = np.zeros((len(seen), phases // 2 + 1), dtype=np.complex64)
        np.multiply(np.conj(seen), lines.astype(np.complex64), out=products[:, 1 : len(lines) + 1])
        sums = irfft(products, phases, axis=1, overwrite_x=True)
        best = sums.argmax(axis=1)
        heights = sums[np.arange(len(seen)), best].astype(np.float64) * phases
        scores = heights / np.sqrt(max(energy * self._power, 1e-300))
        # A chip's own box is centred half a chip after its start.
        return scores, best / phases_a_chip + 0.5

    def _sample(self, steps: FloatArray, harmonics: IndexArray) -> NDArray[np.complex64]:
        """Sample the spectrum at chip harmonics about the middle, shape (steps, harmonics)."""
        rounds = len(self._turned)
        nearest = np.rint(np.outer(steps, harmonics * (rounds / 2 / self._period)))
        return np.asarray(self._turned[nearest.astype(np.int64) % rounds])
