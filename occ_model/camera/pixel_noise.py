"""The law of a pixel's grey level: photons, read noise, gain, converter, gamma and rounding.

A pixel with a mean of n electrons collects K of them, a Poisson number. Its gain differs from the
mean by a fraction p z, it is read with normal noise r z, and the converter counts steps q, from 0
to its top code. The code is encoded with the gamma and rounded to a grey level. So the level is at
most g if the electrons read are at most x_g = (c_g + 1/2) q, where c_g is the last code that is
rounded to g (J. R. Janesick, *Photon Transfer*, 2007).
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.normal import normal_fraction

GREYS = 256
GREY_LEVELS: FloatArray = np.arange(float(GREYS))

_MOST_SUMMED = 100.0  # mean electrons up to which the sum over their number is computed
_FINE_LATTICE = 0.7  # read noise in electrons below which single electrons show
_TAIL = 6.5  # standard deviations, which hardly one of 1e10 pixels exceeds
_SMALLEST_DEVIATION = 1e-9  # electrons, in place of none


@dataclass(frozen=True, kw_only=True, slots=True)
class PixelNoise:
    """A sensor's noise and its converter, in electrons.

    Parameters
    ----------
    white
        Mean electrons of a pixel of the value 255.
    gamma
        Exponent of the encoding.
    full
        Electrons at which the converter's codes end; infinite if none do before white.
    is_counted
        Whether electrons are counted one by one (shot noise); otherwise each pixel has its mean.
    read_noise
        Standard deviation of the read noise.
    step
        Electrons for each step of the converter; 0: no steps.
    gain_variation
        Standard deviation of the pixels' gains, as a fraction.
    """

    white: float
    gamma: float
    full: float = np.inf
    is_counted: bool = False
    read_noise: float = 0.0
    step: float = 0.0
    gain_variation: float = 0.0

    @property
    def is_drawn(self) -> bool:
        """Whether two pictures of the same light differ; the pixels' gains are the same in both."""
        return self.is_counted or self.read_noise > 0.0

    def deviation(self, electrons: FloatArray) -> FloatArray:
        """Return the standard deviation of the electrons that are read, for some means."""
        variance = (self.gain_variation * electrons) ** 2 + self.read_noise**2
        return np.asarray(np.sqrt(variance + electrons * self.is_counted))

    @property
    def greys(self) -> IndexArray:
        """The grey levels that pixels can have, shape (greys,)."""
        if self.step == 0.0:
            last = np.rint(255.0 * min(self.full / self.white, 1.0) ** (1.0 / self.gamma))
            return np.arange(int(last) + 1)
        ends = self._last_codes()
        return np.flatnonzero(np.diff(ends, prepend=-1.0) > 0.0)

    def thresholds(self) -> FloatArray:
        """Return the electrons up to which a pixel has each of ``greys`` but the last."""
        if self.step == 0.0:
            return np.asarray(self.white * self._grey_ends()[self.greys[:-1]])
        return np.asarray((self._last_codes()[self.greys[:-1]] + 0.5) * self.step)

    def _grey_ends(self) -> FloatArray:
        """Return the upper end of each grey level, as a fraction of white's electrons."""
        return np.asarray(((np.arange(GREYS) + 0.5) / 255.0) ** self.gamma)

    def _last_codes(self) -> FloatArray:
        """Return the last code of each grey level, shape (256,)."""
        top = np.rint(min(self.full, self.white) / self.step)
        ends = np.minimum(np.floor(self.white / self.step * self._grey_ends()), top)
        ends[-1] = top
        return np.asarray(ends)

    def fractions(self, electrons: FloatArray) -> FloatArray:
        """Return the probability of each grey level but the last, or a lower one.

        Parameters
        ----------
        electrons : ndarray of float64, shape (means,)
            Mean electrons, rising.

        Returns
        -------
        ndarray of float64, shape (means, greys - 1)
            To within 4e-6 for gains that vary by up to a tenth.
        """
        few = int(np.searchsorted(electrons, _MOST_SUMMED)) if self.is_counted else 0
        limits = self.thresholds()
        parts = [self._sum_over_electrons(electrons[:few], limits)] if few else []
        if few < len(electrons):
            parts.append(self._expand(electrons[few:], limits))
        return np.concatenate(parts)

    def _sum_over_electrons(self, means: FloatArray, limits: FloatArray) -> FloatArray:
        gains, weights = _gain_nodes(self.gain_variation, float(means[-1]))
        brightest = float((means[-1] * gains).max())
        count = np.arange(int(brightest + 8.0 * np.sqrt(brightest) + 25.0))
        log_factorial = np.concatenate([[0.0], np.cumsum(np.log(np.maximum(count[1:], 1)))])
        numbers: FloatArray = np.zeros((len(means), len(count)))
        for gain, weight in zip(gains.tolist(), weights.tolist(), strict=True):
            mean = np.maximum(means * gain, 1e-300)[:, None]
            numbers += weight * np.exp(count * np.log(mean) - mean - log_factorial)
        deviation = max(self.read_noise, _SMALLEST_DEVIATION)
        return np.asarray(numbers @ normal_fraction((limits - count[:, None]) / deviation))

    def _expand(self, means: FloatArray, limits: FloatArray) -> FloatArray:
        """Compute the fractions for many electrons near each mean; elsewhere they are 0 or 1."""
        reach = _TAIL * self.deviation(means) + self._is_lattice * 5.0
        first = np.searchsorted(limits, means - reach)
        width = int((np.searchsorted(limits, means + reach) - first).max(initial=0))
        place = np.minimum(first[:, None] + np.arange(width), max(len(limits) - 1, 0))
        found = np.asarray((np.arange(len(limits)) >= first[:, None]), dtype=np.float64)
        if width:
            near = self._lattice_fraction if self._is_lattice else self._series_fraction
            np.put_along_axis(found, place, near(limits[place], means[:, None]), axis=1)
        return found

    @property
    def _is_lattice(self) -> bool:
        return self.is_counted and self.read_noise < _FINE_LATTICE

    def _series_fraction(self, limits: FloatArray, means: FloatArray) -> FloatArray:
        """Return the fraction below limits, by the inverse Cornish-Fisher series.

        The cumulants are those of a Poisson number whose mean has the gain's normal distribution,
        plus normal noise (M. G. Kendall and A. Stuart, *The Advanced Theory of Statistics*).
        """
        return self._fraction_of(limits, means, self.read_noise**2, 0.0)

    def _fraction_of(
        self, limits: FloatArray, means: FloatArray, variance: float, fourth: float
    ) -> FloatArray:
        gain = (self.gain_variation * means) ** 2
        if not self.is_counted:
            deviation = np.maximum(np.sqrt(gain + variance), _SMALLEST_DEVIATION)
            return normal_fraction((limits - means) / deviation)
        spread = np.sqrt(means + gain + variance)
        w = np.clip((limits - means) / spread, -_TAIL, _TAIL)
        c3 = (means + 3.0 * gain) / spread**3
        c4 = (means + 7.0 * gain + fourth) / spread**4
        c5 = (means + 15.0 * gain) / spread**5
        w2 = w * w
        u = w - c3 / 6.0 * (w2 - 1.0) + w * (c3**2 / 36.0 * (4.0 * w2 - 7.0))
        u -= w * (c4 / 24.0 * (w2 - 3.0))
        u -= c5 / 120.0 * ((w2 - 6.0) * w2 + 3.0)
        u += c3 * c4 / 144.0 * ((11.0 * w2 - 42.0) * w2 + 15.0)
        u -= c3**3 / 648.0 * ((69.0 * w2 - 187.0) * w2 + 52.0)
        return normal_fraction(u)

    def _lattice_fraction(self, limits: FloatArray, means: FloatArray) -> FloatArray:
        """Sum over the numbers of electrons near each limit, read with little noise.

        Half-way between two numbers the series holds with Sheppard's corrections.
        """
        deviation = max(self.read_noise, _SMALLEST_DEVIATION)
        total = np.zeros(limits.shape)
        below: FloatArray | float = 1.0
        for offset in range(-5, 6):
            number = np.floor(limits) + offset
            above = normal_fraction((limits - number - 1.0) / deviation)
            counted = self._fraction_of(number + 0.5, means, -1.0 / 12.0, 1.0 / 120.0)
            total += counted * (below - above)
            below = above
        return total


def _gain_nodes(variation: float, most: float) -> tuple[FloatArray, FloatArray]:
    """Return gains and their weights for averaging Poisson numbers of means up to ``most``."""
    if variation == 0.0:
        return np.ones(1), np.ones(1)
    spacing = 1.0 / max(variation * np.sqrt(most), 1e-9)
    if spacing > 4.0:
        nodes, weights = np.array([-1.0, 0.0, 1.0]) * np.sqrt(3.0), np.array([1.0, 4.0, 1.0])
    else:
        count = int(np.ceil(5.0 / min(spacing, 0.7)))
        nodes = np.arange(-count, count + 1) * (5.0 / count)
        weights = np.exp(-0.5 * nodes**2)
    return np.maximum(1.0 + variation * nodes, 0.0), weights / weights.sum()
