"""From which contrast on bars are seen, by how fine they are."""

import math

from occ_model.scene.scene import Scene

_WEBER = 0.01
"""Least relative difference of luminance that is seen, about 1 %. Values from 0.5 to 2 % are used,
by the conditions (C. Poynton, Digital Video and HD, 2012)."""

_VIEW = 40.0
"""Degrees that the picture's scan axis spans where it is looked at: about as wide as far."""

_PEAK = 7.89
"""Cycles per degree to which the eye is most sensitive by the curve below."""


def contrast_threshold(scene: Scene, period: float) -> float:
    """Return the contrast from which bars are seen, peak to peak over the mean.

    1 % for bars that the eye sees best, and for wider ones, as bars have edges; for finer ones it
    rises as the sensitivity falls by J. L. Mannos and D. J. Sakrison, The effects of a visual
    fidelity criterion on the encoding of images, IEEE Trans. Inf. Theory 20 (1974) 525. It is a
    rule of thumb, within a factor of two for one person and one screen: noise, texture and a moving
    picture hide bars, an eye that searches finds fainter ones.

    Parameters
    ----------
    scene
        Its number of columns is used: the picture is seen as a whole.
    period
        Columns from bar to bar.
    """
    cycles = scene.camera.columns / _VIEW / period
    relative = _sensitivity(max(cycles, _PEAK)) / _sensitivity(_PEAK)
    return _WEBER / relative if relative else math.inf


def _sensitivity(cycles: float) -> float:
    """Return the eye's sensitivity to a sine, up to a factor; in cycles per degree."""
    scaled = 0.114 * cycles
    return (0.0192 + scaled) * math.exp(-(scaled**1.1))
