"""Templates of all payloads of any scheme: the forward model of each, by its spectrum.

The paper's scheme has a form that needs no such table (:mod:`.code_templates`).
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.receiver.matched.code_templates import BINS_PER_CHIP, chip_response
from occ_model.transmitter.packet import bits_of
from occ_model.transmitter.scheme import Scheme

MOST_BITS = 12  # bits up to which all payloads are compared: 4,096 of them
_AT_ONCE = 512  # payloads whose correlations are held at once

_ROUNDING = 1e-6  # variance in lit fractions squared below which it is rounding error


@dataclass(frozen=True, eq=False, slots=True)
class PayloadTemplates:
    """The profile of a period of what is sent, for each payload at an exposure time."""

    period: int  # Int: chips of a period
    # Shape (payloads, bins // 2 + 1): of each payload's profile about its mean
    spectra: NDArray[np.complex64]
    means: FloatArray  # Shape (payloads,): of each profile, in lit fractions
    # Shape (payloads,): sum of the squares of each profile about its mean; infinite where that is
    # rounding error
    energy: FloatArray
    # Shape (payloads, bins): the lit fractions of each profile about its mean, in order
    levels: Pixels

    def profiles(self, codes: IndexArray) -> FloatArray:
        """Return the lit fraction over one period of some payloads, shape (codes, bins)."""
        about_mean = np.fft.irfft(self.spectra[codes], self.period * BINS_PER_CHIP, axis=1)
        return np.asarray(about_mean + self.means[codes, None], dtype=np.float64)

    def most_likely(
        self, rank: IndexArray, count: int, sure: float
    ) -> tuple[IndexArray, IndexArray]:
        """Return the ``count`` payloads, and phases, that correlate best with a signal.

        Each payload is compared with the signal that has its own levels, as it may light most chips
        or hardly any. ``rank``: shape (bins,); the place of each bin of the folded signal in the
        order of its values. All with a correlation of ``sure`` are among them.
        """
        scores = np.empty(len(self.spectra))
        phases = np.empty(len(self.spectra), dtype=np.int64)
        for start in range(0, len(scores), _AT_ONCE):
            part = slice(start, start + _AT_ONCE)
            spectra = np.fft.rfft(self.levels[part][:, rank], axis=1)
            matches = np.fft.irfft(spectra * self.spectra[part].conj(), len(rank), axis=1)
            phases[part] = matches.argmax(axis=1)
            scores[part] = matches.max(axis=1)
        # Of the signal, too: it has the same levels in another order.
        scores /= self.energy
        count = min(max(count, int((scores >= sure).sum())), len(scores))
        likely = np.argpartition(scores, -count)[-count:]
        return likely.astype(np.int64), phases[likely]


@lru_cache(maxsize=2)
def payload_templates(scheme: Scheme, exposure: Fraction) -> PayloadTemplates:
    """Make the forward model of every payload of up to :data:`MOST_BITS` bits."""
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
    # By Parseval's theorem; a real signal's spectrum holds each frequency but the ends twice.
    power = np.abs(spectra.astype(np.complex128)) ** 2
    energy = (2.0 * power.sum(axis=1) - power[:, -1]) / len(impulses)
    energy = np.where(energy > _ROUNDING * len(impulses), energy, np.inf)
    levels = np.empty((len(codes), len(impulses)), dtype=np.float32)
    for start in range(0, len(codes), _AT_ONCE):
        part = slice(start, start + _AT_ONCE)
        levels[part] = np.sort(np.fft.irfft(spectra[part], len(impulses), axis=1), axis=1)
    for array in (spectra, means, energy, levels):
        array.flags.writeable = False  # it is cached and shared
    return PayloadTemplates(scheme.length, spectra, means, energy, levels)


def same_chips(code: int, others: IndexArray, scheme: Scheme) -> int | None:
    """Find another payload whose chips, sent repeatedly, are the same from another start."""
    twice = np.tile(scheme.encode(bits_of(code, scheme.bits)), 2).tobytes()
    for other in others.tolist():
        if other != code and scheme.encode(bits_of(other, scheme.bits)).tobytes() in twice:
            return int(other)
    return None
