"""Compute the spectrum of a profile with the exposure's response, and its level histogram."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.errors import ParameterError
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.results.spectrum import LEVELS, LevelHistogram, Spectrum
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import Scene, Transmitter

_MIN_COLUMNS = 8
_MOST_MULTIPLES = 100


def profile_spectrum(profile: FloatArray, scene: Scene) -> Spectrum:
    """Compute the spectrum of a profile of at least 8 columns.

    The mean is subtracted, and a Hann window fades out both ends, so that a profile without a whole
    number of periods has clean lines too. The response is that of a box as long as the exposure
    (arXiv 2602.08474).
    """
    values = np.asarray(profile, dtype=np.float64)
    if values.ndim != 1 or len(values) < _MIN_COLUMNS:
        raise ParameterError.of(
            "profile", f"shape {values.shape}", f"({_MIN_COLUMNS} or more,)", verb="has"
        )
    if not np.isfinite(values).all():
        raise ParameterError.of("profile", "values that are not finite", "finite ones", verb="has")
    window = np.hanning(len(values))
    amplitudes = 2.0 * np.abs(np.fft.rfft(window * (values - values.mean()))) / window.sum()
    frequencies = np.fft.rfftfreq(len(values), scene.camera.readout_time)
    exposure = scene.camera.exposure_time
    highest = float(frequencies[-1])
    return Spectrum(
        frequencies=np.asarray(frequencies, dtype=np.float64),
        amplitudes=np.asarray(amplitudes, dtype=np.float64),
        response=np.abs(np.sinc(frequencies * exposure)),
        zeros=_multiples(1.0 / exposure, highest),
        harmonics=_harmonics(scene.transmitter, highest),
    )


def _harmonics(transmitter: Transmitter, highest: float) -> tuple[float, ...]:
    if has_chips(transmitter):
        return ()
    light = light_of(transmitter)
    if isinstance(light, Cosine):
        return _multiples(light.frequency, min(light.frequency, highest))
    return _multiples(float(1 / light.period), highest)


def _multiples(frequency: float, highest: float) -> tuple[float, ...]:
    count = min(int(highest / frequency), _MOST_MULTIPLES)
    return tuple(k * frequency for k in range(1, count + 1))


def level_histogram(image: ByteArray) -> LevelHistogram:
    if not image.size:
        return LevelHistogram(np.zeros(LEVELS))
    counts = cv2.calcHist([np.ascontiguousarray(image)], [0], None, [LEVELS], [0, LEVELS])
    return LevelHistogram(counts.ravel().astype(np.float64) / image.size)
