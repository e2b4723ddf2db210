"""The equalizer: undo the exposure, then read by the paper's threshold, run lengths and headers.

Beyond the paper, it knows the exposure time, the readout time and roughly the length of a chip. It
needs no list of codes and accepts any data. If the framing does not check the packet, its exposure
is simulated and compared with the light of its columns.

The exposure, a moving average of t / t_r columns, is a filter with the response sinc(F t), which
has nulls at which only noise is left. The Wiener filter H* / (|H|^2 + N / S) divides by the
response H where the light's spectrum S is above the noise's spectrum N, and suppresses frequencies
where it is below; it has the minimum mean square error (MMSE). Without noise it is the inverse 1 /
H (zero-forcing), which amplifies noise near a null without limit.
"""

import math
from collections import Counter
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Self

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.products import row_products
from occ_model.receiver.decoder import Decoder, add_bits
from occ_model.receiver.light import PER_CHIP, convert_to_light, light_of_chips
from occ_model.receiver.signal import MAX_UNEXPLAINED, explain_flat, unexplained_fraction
from occ_model.receiver.threshold import read_stripes as read_by_threshold
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.scheme import scheme_of

_UNKNOWN_CURVE = (
    "The picture is enhanced by {enhancement}, which hides how bright each column was: the light "
    "could only be estimated."
)

_MAX_VOTES = 15  # packets to compare; more take longer and change nothing
_MAX_EXPOSURE_FRACTION = 0.25  # longest exposure that can be undone, over all columns

_LEAST_LIGHT = 1e-9  # least difference of the light of columns, over that of white

_WEAK_CHECK = "this scheme does not detect all wrong chips; the framing raw checks the payload."

_SHIFTS = np.arange(-PER_CHIP, PER_CHIP + 1)  # shifts of a packet's start, up to a chip


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code from the deconvolved light with the threshold decoder's steps."""
    result = DecodeResult(DECODER.name, signal=signal, failure=explain_flat(signal))
    if result.failure is not None:
        return result
    camera = scene.camera
    exposure = camera.exposure_time / camera.readout_time
    if exposure > _MAX_EXPOSURE_FRACTION * len(signal):
        return replace(
            result,
            failure=f"An exposure lasts {exposure:.3g} of the {len(signal)} columns in the panel's "
            "image: they are too few to undo it.",
        )
    light = convert_to_light(signal, scene)
    if np.ptp(light.values) < _LEAST_LIGHT:
        return replace(result, failure="No stripes: no column is brighter than black.")
    chip = scene.transmitter.switching_period / camera.readout_time
    equalized = undo_exposure(light.values, exposure, chip, scene.receiver.equalizer) * WHITE
    result = _take_majority(read_by_threshold(equalized, scene), scene)
    failure = result.failure or _explain_mismatch(result, light.values, exposure, scene)
    result = result if failure is None else replace(result, code=None)
    if failure is not None and light.is_estimated:
        failure += " " + _UNKNOWN_CURVE.format(enhancement=scene.model.enhancement)
    return replace(
        result, decoder=DECODER.name, signal=signal, equalized=equalized, failure=failure
    )


def _take_majority(result: DecodeResult, scene: Scene) -> DecodeResult:
    """Read every packet in the picture, and take the payload that most of them contain.

    The paper reads only the first packet, but the errors of deconvolved light differ between them.
    """
    if scene.transmitter.pattern:
        return result
    scheme = scheme_of(scene.transmitter)
    length = scheme.length + len(HEADER)  # the paper's packet ends at the next header
    starts = result.headers[:_MAX_VOTES]
    packets = Counter(result.chips[start : start + length].tobytes() for start in starts)
    votes: Counter[tuple[int, ...]] = Counter()
    for packet, count in packets.items():
        frame = scheme.decode(np.frombuffer(packet, dtype=np.uint8))
        if frame.failure is None and len(frame.bits) == scheme.bits:
            votes[tuple(frame.bits.tolist())] += count
    if not votes:
        return result
    (bits, vote_count), *others = votes.most_common(2)
    if others and others[0][1] == vote_count:
        return replace(
            result,
            code=None,
            payload="",
            failure="The packets in the picture contradict each other: each of two payloads was "
            f"read from {vote_count} of them.",
        )
    majority = Framed(result.headers, np.array(bits, dtype=np.uint8))
    return add_bits(result, majority, scene)


def _explain_mismatch(
    result: DecodeResult, light: FloatArray, exposure: float, scene: Scene
) -> str | None:
    """Return why the light does not fit the packet; None if it does or a checksum has passed."""
    scheme = scheme_of(scene.transmitter)
    length = result.chip_length
    if scheme.is_papers or scheme.framing.checks or length is None or result.chip_starts is None:
        return None
    chips = scheme.encode(result.bits)
    starts = [start for start in result.headers if _is_packet(result.chips[start:], chips)]
    if not starts and scheme.takes_any_chips:
        return f"No header is followed by all chips of the payload that was read, and {_WEAK_CHECK}"
    if not starts:  # the picture shows the end of a packet before its beginning
        return None
    first = float(result.chip_starts[starts[0]])
    columns = np.arange(max(0.0, first), min(len(light), first + len(chips) * length))
    columns = columns.astype(np.int64)
    # Deconvolved light refers to the middle of each exposure.
    elapsed = (columns - 0.5 * exposure - first) / length  # chips since the packet's start
    phase = np.floor(PER_CHIP * elapsed).astype(np.int64)
    packet_light = light_of_chips(chips, exposure / length)
    unexplained = _least_unexplained(
        light[columns], packet_light[(phase + _SHIFTS[:, None]) % len(packet_light)]
    )
    if unexplained <= MAX_UNEXPLAINED:
        return None
    return (
        "The packet does not explain the columns it was read from: "
        f"{PERCENT.format(unexplained, 2)} of the variance of their light is due neither to its "
        f"chips nor to noise, and {_WEAK_CHECK}"
    )


def _is_packet(received: ByteArray, chips: ByteArray) -> bool:
    return len(received) >= len(chips) and bool(np.array_equal(received[: len(chips)], chips))


def _least_unexplained(light: FloatArray, models: FloatArray) -> float:
    """Return the fraction of the variance that the best model leaves unexplained."""
    centred = light - light.mean()
    models = models - models.mean(axis=1, keepdims=True)
    energies = np.maximum(np.einsum("ij,ij->i", models, models), 1e-12)
    fits = row_products(centred, models)
    best = int(np.argmax(np.maximum(fits, 0.0) ** 2 / energies))
    residual = centred - max(float(fits[best]), 0.0) / energies[best] * models[best]
    return unexplained_fraction(light, residual)


DECODER = Decoder(
    "equalizer",
    "Equalizer: undoes the exposure, then reads as in the paper",
    read_signal,
    is_quick=False,
)


MMSE, ZERO_FORCING = "mmse", "zero-forcing"  # methods to undo an exposure

_ZERO_FORCING_NOISE = 1e-6  # noise-to-light ratio that avoids a division by zero at a null
_NULL_FRACTION = 0.25  # fraction of the frequencies, nearest the nulls, where noise prevails
_MIN_CHIP_SPECTRUM = 1e-3  # minimum of a chip's spectrum, relative to its maximum
_TAPER_EXPOSURES = 4.0  # exposures over which each end fades out, since a spectrum is periodic


def box(columns: float) -> FloatArray:
    """Return a moving average over columns, possibly fractional, as an impulse response."""
    reach = max(0, math.ceil((columns - 1.0) / 2.0))
    covered = np.clip(columns / 2.0 - np.abs(np.arange(-reach, reach + 1)) + 0.5, 0.0, 1.0)
    return np.asarray(covered / covered.sum())


def response(columns: float, length: int) -> FloatArray:
    """Return the real frequency response of :func:`box`, shape (length // 2 + 1,)."""
    from skimage.restoration import uft  # slow to import, and used only by this decoder

    return np.asarray(uft.ir2tf(box(columns), (length,)).real)


def undo_exposure(
    light: FloatArray, exposure: float, chip: float, method: str = MMSE
) -> FloatArray:
    """Return the light before its average over ``exposure`` columns, at the exposure's middle."""
    # Not ``skimage.restoration.wiener``, whose module takes 1.4 s because it imports scipy.signal.
    from scipy.fft import next_fast_len
    from skimage.restoration import uft

    mean = float(light.mean())
    margin = math.ceil(_TAPER_EXPOSURES * exposure)
    # A Fourier transform takes many times as long if its length has large prime factors.
    padded_light = _fade_out(
        light - mean, margin, next_fast_len(len(light) + 2 * margin, real=True)
    )
    spectra = _Spectra.of(exposure, chip, len(padded_light))
    seen = uft.urfftn(padded_light)
    if method == ZERO_FORCING:
        noise = np.asarray(_ZERO_FORCING_NOISE)
    else:
        noise = _noise_to_light_ratio(seen, light, spectra) / spectra.chip
    wiener_filter = spectra.transfer / (spectra.transfer**2 + noise)
    restoration = uft.uirfftn(wiener_filter * seen, shape=padded_light.shape)
    return np.asarray(restoration[margin : margin + len(light)] + mean, dtype=np.float64)


@dataclass(frozen=True, eq=False, slots=True)
class _Spectra:
    """What pictures with one exposure, frequency and length have in common."""

    transfer: FloatArray  # Shape (frequencies,): response of an exposure
    chip: FloatArray  # Shape (frequencies,): power of the chips' light, relative to its maximum
    nulls: IndexArray  # The frequencies nearest the nulls, where noise prevails

    @classmethod
    @lru_cache(maxsize=16)
    def of(cls, exposure: float, chip: float, length: int) -> Self:
        transfer = response(exposure, length)
        frequency = np.arange(len(transfer)) / length
        power = np.sinc(frequency * chip) ** 2 + _MIN_CHIP_SPECTRUM
        count = max(1, int(_NULL_FRACTION * len(transfer)))
        return cls(transfer, power, np.argpartition(np.abs(transfer), count - 1)[:count])


def _fade_out(signal: FloatArray, margin: int, length: int) -> FloatArray:
    """Extend a signal beyond both ends and fade it to zero, because a spectrum is periodic."""
    fade = 0.5 - 0.5 * np.cos(np.pi * (np.arange(margin) + 0.5) / margin)
    padding = np.zeros(length - len(signal) - 2 * margin)
    return np.concatenate([signal[0] * fade, signal, signal[-1] * fade[::-1], padding])


def _noise_to_light_ratio(
    seen: NDArray[np.complex128], light: FloatArray, spectra: _Spectra
) -> float:
    """Measure the noise power near the nulls, relative to the light's power at low frequencies.

    Near the nulls the signal contains no light of chips, only noise, rounding, errors of the tone
    curve, and effects of the picture's ends.
    """
    noise = float((np.abs(seen[spectra.nulls]) ** 2).mean())
    variance = max(float(light.var()) - noise, noise * _MIN_CHIP_SPECTRUM)
    return noise / (variance / float(np.mean(spectra.chip * spectra.transfer**2)))
