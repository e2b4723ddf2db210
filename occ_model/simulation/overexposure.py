"""How much of a simulated picture is overexposed."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE, saturation_value
from occ_model.results.plan import Plan
from occ_model.scene.scene import Scene

_ROUNDING = 1.0  # grey levels by which a column whose pixels are full may fall short of that


def overexposed_fraction(
    scene: Scene, plan: Plan, profile: FloatArray, corners: FloatArray
) -> float:
    """Return the fraction of the panel's columns whose pixels are all white, or full.

    Parameters
    ----------
    plan : Plan
        The effects that the profile is simulated with.
    profile : ndarray of float64, shape (columns,)
        Means of the panel's pixels in each column before enhancement, in grey levels.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners, each as (column, row).
    """
    left, right = float(corners[:, 0].min()), float(corners[:, 0].max())
    seen = profile[max(0, round(left)) : max(0, round(right) + 1)]
    limit = saturation_value(scene) if "full-well" in plan else WHITE
    return float(np.mean(seen >= limit - _ROUNDING)) if seen.size else 0.0
