"""Measurements on a picture: the spectrum of its profile and the histogram of its levels."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray

_WHITE = 255

LEVELS = _WHITE + 1  # grey levels of a picture
SATURATED_FROM = 0.01  # fraction of white pixels above which a picture counts as saturated


@dataclass(frozen=True, eq=False, slots=True)
class Spectrum:
    # Shape (n,): in Hz, from 0 to half the column rate, 1 / (2 t_r)
    frequencies: FloatArray
    amplitudes: FloatArray  # Shape (n,): of the sine of each frequency, in grey levels
    # Shape (n,): the fraction of a sine's amplitude after the exposure, |sinc(F t)| for light of
    # the frequency F. Its first zero, F = 1 / t, is the null of an alternating pattern, f = 2 / t.
    response: FloatArray
    # Frequencies k / t in Hz at which the response is 0, up to the last frequency
    zeros: tuple[float, ...]
    # Multiples in Hz of the light's repetition rate, up to the last frequency; empty for packets
    harmonics: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class LevelHistogram:
    fractions: FloatArray  # Shape (256,): fraction of the pixels at each level; they add up to 1

    @property
    def white(self) -> float:
        """Fraction of pixels that are white."""
        return float(self.fractions[_WHITE])

    @property
    def is_saturated(self) -> bool:
        """Whether many pixels are white, so that light is lost."""
        return self.white >= SATURATED_FROM
