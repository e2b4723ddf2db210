"""Contrast threshold of bars by their spatial frequency."""

import math

from occ_model.scene.scene import Scene

_WEBER_FRACTION = 0.01
"""Smallest visible relative difference of luminance. Values from 0.5 to 2 % are in use (C. Poynton,
Digital Video and HD, 2012)."""

_VIEWING_ANGLE = 40.0  # degrees that the picture's scan axis spans for the viewer
_PEAK_FREQUENCY = 7.89  # cycles per degree of the maximum of the sensitivity curve below


def contrast_threshold(scene: Scene, period: float) -> float:
    """Return the contrast, peak to peak over the mean, from which bars of a period are visible.

    1 % at the peak of the eye's sensitivity and for wider bars, as these have edges; finer bars
    follow the sensitivity of J. L. Mannos and D. J. Sakrison, The effects of a visual fidelity
    criterion on the encoding of images, IEEE Trans. Inf. Theory 20 (1974) 525. It is a rule of
    thumb, within a factor of two: noise, texture and motion hide bars.
    """
    cycles = scene.camera.columns / _VIEWING_ANGLE / period
    relative = _sensitivity(max(cycles, _PEAK_FREQUENCY)) / _sensitivity(_PEAK_FREQUENCY)
    return _WEBER_FRACTION / relative if relative else math.inf


def _sensitivity(cycles: float) -> float:
    """Return the eye's sensitivity to a sine, up to a factor; in cycles per degree."""
    scaled = 0.114 * cycles
    return (0.0192 + scaled) * math.exp(-(scaled**1.1))
