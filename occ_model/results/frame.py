"""Result of a simulation: one picture."""

from collections.abc import Mapping
from dataclasses import dataclass

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.plan import Plan
from occ_model.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Frame:
    """One simulated picture, with its scene, plan and profile.

    Parameters
    ----------
    scene
        The scene.
    image : ndarray of uint8, shape (rows, columns)
        The picture.
    plan
        The effects simulated, and why.
    profile : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column, in grey levels, before enhancement and rounding;
        of a picture that is kept in a file, as it is read back. With column effects only it is the
        column's value itself, PV_sim; also in columns that do not show the panel.
    enhanced : ndarray of uint8, shape (columns,)
        The column values after enhancement; those of the image where it has column effects only.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners in the image, each as (column, row), in order round the panel.
    timings
        Seconds of each stage, an effect under its name, in the order of computation.
    """

    scene: Scene
    plan: Plan
    image: ByteArray
    profile: FloatArray
    enhanced: ByteArray
    corners: FloatArray
    timings: Mapping[str, float]
