"""The forward model of every code, in a form that all of them can be compared with at once."""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.scene import Transmitter
from occ_model.transmitter.packet import packet_length, sent_chips
from occ_model.transmitter.waveform import Duration, Phases, Waveform

BINS_PER_CHIP = 8
"""How finely a packet is divided: an edge is known to a sixteenth of a chip."""

_TONE_CODES = 256
"""Codes that the distribution of lit fractions is taken from; more of them do not change it."""

_ROUNDING = 1e-12
"""Variance of a profile, in lit fractions squared, that is nothing but rounding."""


@dataclass(frozen=True, eq=False, slots=True)
class CodeBook:
    """What a packet of each code looks like through an exposure.

    A profile is a sum of the chips' responses: that of code c at bin b is the sum over j of
    ``chips[c, j] * response[b - j * BINS_PER_CHIP]``, so that a correlation with every code at
    every phase is one correlation with the response and one product with the chips.

    Parameters
    ----------
    chips : ndarray of float64, shape (codes, chips)
        The packets.
    response : ndarray of float64, shape (bins,)
        Lit fraction of an exposure that starts in each bin, when chip 0 alone is lit.
    energy : ndarray of float64, shape (codes,)
        Sum of the squares of each code's profile about its mean; infinite where that is nothing
        but rounding, so that such a profile correlates with none.
    levels : ndarray of float64, shape (bins,)
        Lit fractions that the codes' profiles take: evenly spaced quantiles of all of them.
    """

    chips: FloatArray
    response: FloatArray
    energy: FloatArray
    levels: FloatArray

    def profiles(self, codes: IndexArray) -> FloatArray:
        """Give the lit fraction over one packet of some codes, shape (codes, bins)."""
        return _profiles(self.chips[codes], self.response)


@lru_cache(maxsize=16)
def code_book(bits: int, exposure: Fraction) -> CodeBook:
    """Make the forward model of every code.

    Parameters
    ----------
    bits
        Bits of a code.
    exposure
        The exposure time in chips, exactly.
    """
    period = packet_length(bits)
    packets = _packets(bits)
    first_chip = np.zeros(period, dtype=np.uint8)
    first_chip[0] = 1
    bins = np.arange(period * BINS_PER_CHIP)
    starts = Phases(bins // BINS_PER_CHIP, (bins % BINS_PER_CHIP) / BINS_PER_CHIP)
    duration = Duration.of(exposure, period)
    lit = Waveform(first_chip).lit_chips(starts, duration)
    response = lit / duration.in_chips(period)
    some = packets[:: max(1, len(packets) // _TONE_CODES)]
    shares = (bins + 0.5) / len(bins)
    levels = np.quantile(_profiles(some, response), shares)
    book = CodeBook(packets, response, _energies(packets, response), levels)
    for array in (book.chips, book.response, book.energy, book.levels):
        array.flags.writeable = False  # it is kept, and given to everyone
    return book


@lru_cache(maxsize=4)
def _packets(bits: int) -> FloatArray:
    """Give the chips of every code's packet, shape (codes, chips); they need no exposure."""
    codes = range(2**bits)
    return np.stack([sent_chips(Transmitter(code=code, bits=bits)) for code in codes]).astype(
        np.float64
    )


def _profiles(packets: FloatArray, response: FloatArray) -> FloatArray:
    """Give the profiles of some codes, shape (codes, bins)."""
    impulses = np.zeros((len(packets), len(response)))
    impulses[:, ::BINS_PER_CHIP] = packets
    spectrum = np.fft.rfft(impulses, axis=1) * np.fft.rfft(response)
    return np.asarray(np.fft.irfft(spectrum, len(response), axis=1))


def _energies(packets: FloatArray, response: FloatArray) -> FloatArray:
    """Give each profile's sum of squares about its mean, from autocorrelations alone."""
    bins = len(response)
    own = np.fft.irfft(np.abs(np.fft.rfft(response)) ** 2, bins)[::BINS_PER_CHIP]
    spectrum = np.abs(np.fft.rfft(packets, axis=1)) ** 2
    lags = np.fft.irfft(spectrum, packets.shape[1], axis=1)
    sums = packets.sum(axis=1) * response.sum()
    energies = lags @ own - sums**2 / bins
    return np.where(energies > _ROUNDING * bins, energies, np.inf)
