"""Undo the exposure: a moving average of the light, t / t_r columns long.

The exposure is a filter with the response sinc(F t), which has nulls: there the light leaves
nothing but noise. The Wiener filter H* / (|H|^2 + N / S) divides by the response H where the
light's spectrum S is above the noise's N, and gives nothing where it is below: it has the least
mean square error (MMSE). Without the noise it is the inverse 1 / H (zero-forcing), which amplifies
the noise beside a null without limit.
"""

import math

import numpy as np

from occ_model.arrays import FloatArray

MMSE, ZERO_FORCING = "mmse", "zero-forcing"  # the ways to undo an exposure

_ZERO_FORCING_NOISE = 1e-6  # noise-to-light ratio that avoids a division by zero at a null
_NULL_FRACTION = 0.25  # fraction of the spectrum, least passed by the exposure, to measure noise in
_MIN_CHIP_SPECTRUM = 1e-3  # minimum of a chip's spectrum relative to its largest; 0 at its nulls
_TAPER_EXPOSURES = 4.0  # exposures over which either end fades out, before the spectrum repeats it


def box(columns: float) -> FloatArray:
    """Return a moving average over columns, also a part of one, as an impulse response of sum 1."""
    reach = max(0, math.ceil((columns - 1.0) / 2.0))
    covered = np.clip(columns / 2.0 - np.abs(np.arange(-reach, reach + 1)) + 0.5, 0.0, 1.0)
    return np.asarray(covered / covered.sum())


def response(columns: float, length: int) -> FloatArray:
    """Return the real frequency response of :func:`box`, shape (length // 2 + 1,)."""
    taps = box(columns)
    circle = np.zeros(length)
    np.add.at(circle, np.arange(len(taps)) - len(taps) // 2, taps)
    return np.asarray(np.fft.rfft(circle).real)


def undo_exposure(
    light: FloatArray, exposure: float, chip: float, method: str = MMSE
) -> FloatArray:
    """Return the light before it was averaged over ``exposure`` columns, at its middle."""
    from scipy.fft import next_fast_len  # both slow to import, and for this decoder alone
    from skimage.restoration import wiener

    mean = float(light.mean())
    margin = math.ceil(_TAPER_EXPOSURES * exposure)
    # A Fourier transform of a length with large prime factors takes many times as long.
    faded = _faded(light - mean, margin, next_fast_len(len(light) + 2 * margin, real=True))
    passed = response(exposure, len(faded))
    frequency = np.arange(len(passed)) / len(faded)
    if method == ZERO_FORCING:
        noise, spectrum = _ZERO_FORCING_NOISE, np.ones_like(passed)
    else:
        spectrum = np.sinc(frequency * chip) ** 2 + _MIN_CHIP_SPECTRUM
        noise = _noise_over_light(faded, light, passed, spectrum)
    # Complex: scikit-image takes it for a response, not for an impulse response.
    shape = (1.0 / np.sqrt(spectrum)).astype(np.complex128)
    undone = wiener(faded, box(exposure), noise, reg=shape, clip=False)
    return np.asarray(undone[margin : margin + len(light)] + mean, dtype=np.float64)


def _faded(signal: FloatArray, margin: int, length: int) -> FloatArray:
    """Continue a signal beyond both ends, where it fades out: a spectrum repeats it endlessly."""
    fade = 0.5 - 0.5 * np.cos(np.pi * (np.arange(margin) + 0.5) / margin)
    rest = np.zeros(length - len(signal) - 2 * margin)
    return np.concatenate([signal[0] * fade, signal, signal[-1] * fade[::-1], rest])


def _noise_over_light(
    faded: FloatArray, light: FloatArray, passed: FloatArray, spectrum: FloatArray
) -> float:
    """Measure the noise's power beside the nulls, relative to the light's at low frequencies.

    What the signal has there cannot be light of chips: it is noise, rounding, an error of the tone
    curve, and what the ends of the picture cut off.
    """
    power = np.abs(np.fft.rfft(faded)) ** 2 / len(faded)
    count = max(1, int(_NULL_FRACTION * len(power)))
    beside = np.argpartition(np.abs(passed), count - 1)[:count]
    noise = float(power[beside].mean())
    variance = max(float(light.var()) - noise, noise * _MIN_CHIP_SPECTRUM)
    return noise / (variance / float(np.mean(spectrum * passed**2)))
