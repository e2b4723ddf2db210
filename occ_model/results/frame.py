"""Result of a simulation: one picture."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.plan import Plan
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Scene

PICTURES = ("camera", "receiver")
"""Whose picture a frame's pictures are."""


@dataclass(frozen=True, eq=False)
class Frame:
    """One simulated picture, with its scene, plan and profile.

    The camera's picture and the receiver's are two: the receiver enhances the contrast within the
    panel and decodes the result.

    Parameters
    ----------
    scene
        The scene.
    plan
        The effects simulated, and why.
    image : ndarray of uint8, shape (number of ``rows``, columns)
        The receiver's picture, enhanced as the scene says: the one that is decoded.
    rows
        The rows of the picture that ``image`` shows: all of them, or in a draft every k-th,
        ceil(rows / k) of them. A view draws each of them k rows high.
    profile : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column, in grey levels, before enhancement and rounding;
        of a picture that is kept in a file, as it is read back. With column effects only it is the
        column's value itself, PV_sim; also in columns that do not show the panel.
    signal : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column of the receiver's picture, in grey levels: what a
        decoder reads, over all rows of the panel. With column effects only it is the column's
        enhanced value; also in columns that do not show the panel.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners in the image, each as (column, row), in order round the panel.
    timings
        Seconds of each stage, an effect under its name, in the order of computation.
    make_camera_image
        Returns the camera's picture.
    estimate_errors
        Returns how far the profile and the signal may lie from those of the whole picture, by name;
        None where they are those.
    """

    scene: Scene
    plan: Plan
    image: ByteArray
    rows: range
    profile: FloatArray
    signal: FloatArray
    corners: FloatArray
    timings: Mapping[str, float]
    make_camera_image: Callable[[], ByteArray] = field(repr=False)
    estimate_errors: Callable[[], Mapping[str, float]] | None = field(repr=False, default=None)

    @property
    def rows_step(self) -> int:
        """How many rows of the picture each row of ``image`` stands for: 1, more in a draft."""
        return self.rows.step

    @cached_property
    def camera_image(self) -> ByteArray:
        """The camera's picture, before the receiver's enhancement, shape as ``image``."""
        return self.make_camera_image()

    @cached_property
    def draft_error(self) -> Mapping[str, float]:
        """How far a draft's ``profile`` and ``signal`` may lie from the whole picture's, by name.

        Root mean square over the columns of the panel's bounding rectangle, in grey levels: the
        draft's own sampling error and that of the whole picture, whose noise is another. 0 where
        the picture is no draft, or all its rows are alike.
        """
        return self.estimate_errors() if self.estimate_errors else {"profile": 0.0, "signal": 0.0}

    def picture(self, whose: str) -> ByteArray:
        """Return the picture of the ``"camera"`` or the ``"receiver"``.

        Raises
        ------
        ParameterError
            It is neither.
        """
        check_choice("picture", whose, PICTURES)
        return self.camera_image if whose == "camera" else self.image

    def picture_title(self, whose: str) -> str:
        """Return the title of a picture, which says how the receiver's is enhanced."""
        if whose == "camera":
            return "Camera's picture"
        enhancement = self.scene.model.enhancement
        return "Receiver's picture, " + (
            "not enhanced" if enhancement == "none" else f"enhanced by {enhancement}"
        )
