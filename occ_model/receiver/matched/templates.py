"""Make the templates of all codes: their forward models, in a form that is compared all at once.

Templates of the paper's scheme are sums of one response; those of other schemes form a table.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.light.times import Duration, PhasesInPeriod
from occ_model.light.waveform import Waveform
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.scheme import Scheme, bits_of, packet_length, packets_of_codes

BINS_PER_CHIP = 8  # so that an edge is known to a sixteenth of a chip

_TONE_CODES = 256  # codes for the distribution of lit fractions; more do not change it
_ROUNDING = 1e-12  # variance of lit fractions below which it is a rounding error


@dataclass(frozen=True, eq=False, slots=True)
class CodeTemplates:
    """The profile of a packet of each code at an exposure time.

    The profile of code c at bin b is the sum over its lit chips j of ``response[b - j *
    BINS_PER_CHIP]``. Correlating with every code is therefore a single correlation with the
    response, followed by sums over lit chips (:func:`sums_of_halves`).
    """

    bits: int
    # Shape (bins,): lit fraction of an exposure that starts in each bin, if only chip 0 is lit
    response: FloatArray
    # Shape (codes,): sum of squares of each code's profile about its mean; infinite if it is only a
    # rounding error, so that the profile correlates with no signal
    energy: FloatArray
    # Shape (bins,): evenly spaced quantiles of the lit fractions in all codes' profiles
    levels: FloatArray

    def profiles(self, codes: IndexArray) -> FloatArray:
        """Return the lit fractions over a packet for some codes, shape (codes, bins)."""
        return _profiles(codes, self.bits, self.response)


@lru_cache(maxsize=256)  # a search reads the images at each of its values in several batches
def make_code_templates(bits: int, exposure: Fraction) -> CodeTemplates:
    """Make the forward model of every code; ``exposure``: exact length in chips."""
    response = chip_response(packet_length(bits), exposure)
    bins = np.arange(len(response))
    sampled_codes = np.arange(0, 2**bits, max(1, 2**bits // _TONE_CODES))
    fractions = (bins + 0.5) / len(bins)
    # Equals numpy.quantile, which searches each value separately and takes five times as long.
    values = np.sort(_profiles(sampled_codes, bits, response), axis=None)
    levels = np.interp(fractions * (values.size - 1), np.arange(values.size), values)
    templates = CodeTemplates(bits, response, _energies(bits, response), levels)
    for array in (templates.response, templates.energy, templates.levels):
        array.flags.writeable = False  # it is cached and shared
    return templates


def chip_response(period: int, exposure: Fraction) -> FloatArray:
    """Return the lit fraction of an exposure (in chips) from each bin, if only chip 0 is lit."""
    first_chip = np.zeros(period, dtype=np.uint8)
    first_chip[0] = 1
    bins = np.arange(period * BINS_PER_CHIP)
    starts = PhasesInPeriod(bins // BINS_PER_CHIP, (bins % BINS_PER_CHIP) / BINS_PER_CHIP)
    duration = Duration.of(exposure, period)
    return Waveform(first_chip).light_in(starts, duration) / duration.in_units(period)


def sums_of_halves(values: FloatArray, bits: int) -> tuple[FloatArray, FloatArray]:
    """Sum values, shape (chips, n), over the lit chips in each half of every packet.

    A bit lights one of its two chips: the first one if the level after the bit is 0, the second one
    if it is 1. A bit's chips thus depend only on the level after it. The sum over a packet is the
    sum over its first half (header and ``bits // 2`` bits), which has only 2^(bits // 2) variants,
    plus that over its second half. A row's number is the levels, read as a binary number.
    """
    header = np.array(HEADER, dtype=np.float64) @ values[: len(HEADER)]
    pairs = values[len(HEADER) :].reshape(bits, 2, -1)
    half = bits // 2
    return _add_bits(header[None], pairs[:half]), _add_bits(
        np.zeros_like(header[None]), pairs[half:]
    )


def _add_bits(sums: FloatArray, pairs: FloatArray) -> FloatArray:
    """Add the values of either chip to each sum, bit by bit."""
    for pair in pairs:
        sums = (sums[:, None] + pair).reshape(-1, sums.shape[1])
    return sums


@lru_cache(maxsize=4)
def codes_by_levels(bits: int) -> IndexArray:
    """Return the code for each sequence of levels after its bits, read as a binary number."""
    levels = np.arange(2**bits)
    previous_levels = levels >> 1 | HEADER[-1] << (bits - 1)
    codes: IndexArray = levels ^ previous_levels  # a bit is 1 if the level changes
    codes.flags.writeable = False
    return codes


def _profiles(codes: IndexArray, bits: int, response: FloatArray) -> FloatArray:
    impulses = np.zeros((len(codes), len(response)))
    impulses[:, ::BINS_PER_CHIP] = packets_of_codes(codes, bits)
    spectrum = np.fft.rfft(impulses, axis=1) * np.fft.rfft(response)
    return np.asarray(np.fft.irfft(spectrum, len(response), axis=1))


def _energies(bits: int, response: FloatArray) -> FloatArray:
    """Return each profile's sum of squares about its mean, from the response's autocorrelation.

    It is summed over all pairs of lit chips, within and between the halves of a packet.
    """
    period = packet_length(bits)
    spectrum = np.abs(np.fft.rfft(response)) ** 2
    spectrum[0] = 0.0  # about the mean
    autocorrelation = np.fft.irfft(spectrum, len(response))[::BINS_PER_CHIP]
    chips = np.arange(period)
    first, second = sums_of_halves(autocorrelation[(chips[:, None] - chips) % period], bits)
    within_first, across = sums_of_halves(first.T, bits)
    within_second = sums_of_halves(second.T, bits)[1]
    sums = within_first.diagonal()[:, None] + 2.0 * across.T + within_second.diagonal()
    energies = np.empty(2**bits)
    energies[codes_by_levels(bits)] = sums.ravel()
    return np.where(energies > _ROUNDING * len(response), energies, np.inf)


MOST_BITS = 12  # bits up to which all payloads are compared: 4,096
_PAYLOADS_AT_ONCE = 512  # payloads whose correlations are computed at a time

_ROUNDING_OF_SPECTRA = 1e-6  # like _ROUNDING, for payloads' profiles in single precision


@dataclass(frozen=True, eq=False, slots=True)
class PayloadTemplates:
    """The profile of a sent period for each payload at an exposure time."""

    period: int  # Chips of a period
    # Shape (payloads, bins // 2 + 1): spectrum of each payload's profile about its mean
    spectra: NDArray[np.complex64]
    means: FloatArray  # Shape (payloads,): mean of each profile, in lit fractions
    # Shape (payloads,): sum of squares of each profile about its mean; infinite if it is only a
    # rounding error
    energy: FloatArray
    # Shape (payloads, bins): the lit fractions of each profile about its mean, sorted
    levels: Pixels

    def profiles(self, codes: IndexArray) -> FloatArray:
        """Return the lit fractions over a period for some payloads, shape (codes, bins)."""
        centred = np.fft.irfft(self.spectra[codes], self.period * BINS_PER_CHIP, axis=1)
        return np.asarray(centred + self.means[codes, None], dtype=np.float64)

    def find_most_likely(
        self, rank: IndexArray, count: int, certain_score: float
    ) -> tuple[IndexArray, IndexArray]:
        """Return the ``count`` payloads that correlate best with a signal, and their phases.

        The signal is converted to the levels of each payload before they are compared, because a
        payload may light most chips or hardly any. ``rank``, shape (bins,): each bin's rank in the
        folded signal. All payloads with a correlation of at least ``certain_score`` are included.
        """
        scores = np.empty(len(self.spectra))
        phases = np.empty(len(self.spectra), dtype=np.int64)
        for start in range(0, len(scores), _PAYLOADS_AT_ONCE):
            part = slice(start, start + _PAYLOADS_AT_ONCE)
            spectra = np.fft.rfft(self.levels[part][:, rank], axis=1)
            correlations = np.fft.irfft(spectra * self.spectra[part].conj(), len(rank), axis=1)
            phases[part] = correlations.argmax(axis=1)
            scores[part] = correlations.max(axis=1)
        # The signal has the same energy, since it has the same levels in another order.
        scores /= self.energy
        count = min(max(count, int((scores >= certain_score).sum())), len(scores))
        candidates = np.argpartition(scores, -count)[-count:]
        return candidates.astype(np.int64), phases[candidates]


@lru_cache(maxsize=2)
def make_payload_templates(scheme: Scheme, exposure: Fraction) -> PayloadTemplates:
    """Make the forward model of every payload of at most :data:`MOST_BITS` bits."""
    codes = range(2**scheme.bits)
    response = np.fft.rfft(chip_response(scheme.length, exposure))
    spectra = np.empty((len(codes), len(response)), dtype=np.complex64)
    impulses = np.zeros(scheme.length * BINS_PER_CHIP)
    means = np.empty(len(codes))
    for code in codes:
        impulses[::BINS_PER_CHIP] = scheme.encode(bits_of(code, scheme.bits))
        spectrum = np.fft.rfft(impulses) * response
        means[code] = spectrum[0].real / len(impulses)
        spectrum[0] = 0.0
        spectra[code] = spectrum
    # By Parseval's theorem; all frequencies except the ends count twice for a real signal.
    power = np.abs(spectra.astype(np.complex128)) ** 2
    energy = (2.0 * power.sum(axis=1) - power[:, -1]) / len(impulses)
    energy = np.where(energy > _ROUNDING_OF_SPECTRA * len(impulses), energy, np.inf)
    levels = np.empty((len(codes), len(impulses)), dtype=np.float32)
    for start in range(0, len(codes), _PAYLOADS_AT_ONCE):
        part = slice(start, start + _PAYLOADS_AT_ONCE)
        levels[part] = np.sort(np.fft.irfft(spectra[part], len(impulses), axis=1), axis=1)
    for array in (spectra, means, energy, levels):
        array.flags.writeable = False  # it is cached and shared
    return PayloadTemplates(scheme.length, spectra, means, energy, levels)


def find_same_chips(code: int, others: IndexArray, scheme: Scheme) -> int | None:
    """Find another payload whose chips, sent repeatedly, are the same except for their start."""
    twice = np.tile(scheme.encode(bits_of(code, scheme.bits)), 2).tobytes()
    for other in others.tolist():
        if other != code and scheme.encode(bits_of(other, scheme.bits)).tobytes() in twice:
            return int(other)
    return None
