"""Templates of all codes: the forward model of each, in a form that compares all at once."""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.packet import packet_length, packets
from occ_model.transmitter.waveform import Duration, Phases, Waveform

BINS_PER_CHIP = 8  # bins of a chip: an edge is known to a sixteenth of a chip

_TONE_CODES = 256  # codes for the distribution of lit fractions; more do not change it
_ROUNDING = 1e-12  # variance in lit fractions squared below which it is rounding error


@dataclass(frozen=True, eq=False, slots=True)
class CodeTemplates:
    """The profile of a packet of each code at an exposure time.

    That of code c at bin b is the sum over its lit chips j of ``response[b - j * BINS_PER_CHIP]``.
    So a correlation with every code is one correlation with the response, and its sums over the lit
    chips (:func:`sums_of_halves`).
    """

    bits: int
    # Shape (bins,): lit fraction of an exposure that starts in each bin, when chip 0 alone is lit
    response: FloatArray
    # Shape (codes,): sum of the squares of each code's profile about its mean; infinite where that
    # is rounding error, so that such a profile correlates with no signal
    energy: FloatArray
    # Shape (bins,): lit fractions in the codes' profiles: evenly spaced quantiles of all of them
    levels: FloatArray

    def profiles(self, codes: IndexArray) -> FloatArray:
        """Return the lit fraction over one packet of some codes, shape (codes, bins)."""
        return _profiles(codes, self.bits, self.response)


@lru_cache(maxsize=16)
def code_templates(bits: int, exposure: Fraction) -> CodeTemplates:
    """Make the forward model of every code; ``exposure`` in chips, exactly."""
    response = chip_response(packet_length(bits), exposure)
    bins = np.arange(len(response))
    some = np.arange(0, 2**bits, max(1, 2**bits // _TONE_CODES))
    shares = (bins + 0.5) / len(bins)
    # As numpy.quantile gives them, which finds each place apart and takes five times as long.
    values = np.sort(_profiles(some, bits, response), axis=None)
    levels = np.interp(shares * (values.size - 1), np.arange(values.size), values)
    templates = CodeTemplates(bits, response, _energies(bits, response), levels)
    for array in (templates.response, templates.energy, templates.levels):
        array.flags.writeable = False  # it is cached and shared
    return templates


def chip_response(period: int, exposure: Fraction) -> FloatArray:
    """Return the lit fraction of an exposure (in chips) from each bin, when chip 0 alone is lit."""
    first_chip = np.zeros(period, dtype=np.uint8)
    first_chip[0] = 1
    bins = np.arange(period * BINS_PER_CHIP)
    starts = Phases(bins // BINS_PER_CHIP, (bins % BINS_PER_CHIP) / BINS_PER_CHIP)
    duration = Duration.of(exposure, period)
    return Waveform(first_chip).lit_chips(starts, duration) / duration.in_chips(period)


def sums_of_halves(values: FloatArray, bits: int) -> tuple[FloatArray, FloatArray]:
    """Sum values, shape (chips, n), over the chips that are lit, in each half of every packet.

    A bit lights one of its two chips: the first where the level after the bit is 0, the second
    where it is 1. So a bit's chips depend on no level but the one after it, and the sum over a
    packet is that over its first half, header and ``bits // 2`` bits, of which there are only
    2^(bits // 2), plus that over its second half. Rows are numbered by the levels, read as a binary
    number.
    """
    header = np.array(HEADER, dtype=np.float64) @ values[: len(HEADER)]
    pairs = values[len(HEADER) :].reshape(bits, 2, -1)
    half = bits // 2
    return _add_bits(header[None], pairs[:half]), _add_bits(
        np.zeros_like(header[None]), pairs[half:]
    )


def _add_bits(sums: FloatArray, pairs: FloatArray) -> FloatArray:
    """Add to each sum, bit after bit, the values of either chip."""
    for pair in pairs:
        sums = (sums[:, None] + pair).reshape(-1, sums.shape[1])
    return sums


@lru_cache(maxsize=4)
def codes_by_levels(bits: int) -> IndexArray:
    """Return the code with these levels after its bits, the levels read as a binary number."""
    after = np.arange(2**bits)
    before = after >> 1 | HEADER[-1] << (bits - 1)
    codes: IndexArray = after ^ before  # a bit is 1 where the level changes
    codes.flags.writeable = False
    return codes


def _profiles(codes: IndexArray, bits: int, response: FloatArray) -> FloatArray:
    impulses = np.zeros((len(codes), len(response)))
    impulses[:, ::BINS_PER_CHIP] = packets(codes, bits)
    spectrum = np.fft.rfft(impulses, axis=1) * np.fft.rfft(response)
    return np.asarray(np.fft.irfft(spectrum, len(response), axis=1))


def _energies(bits: int, response: FloatArray) -> FloatArray:
    """Return each profile's sum of squares about its mean, from the response's autocorrelation.

    It is summed over all pairs of lit chips: within each half of a packet, and across.
    """
    period = packet_length(bits)
    spectrum = np.abs(np.fft.rfft(response)) ** 2
    spectrum[0] = 0.0  # about the mean
    own = np.fft.irfft(spectrum, len(response))[::BINS_PER_CHIP]
    chips = np.arange(period)
    first, second = sums_of_halves(own[(chips[:, None] - chips) % period], bits)
    within_first, across = sums_of_halves(first.T, bits)
    within_second = sums_of_halves(second.T, bits)[1]
    sums = within_first.diagonal()[:, None] + 2.0 * across.T + within_second.diagonal()
    energies = np.empty(2**bits)
    energies[codes_by_levels(bits)] = sums.ravel()
    return np.where(energies > _ROUNDING * len(response), energies, np.inf)
