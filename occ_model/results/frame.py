"""Result of a simulation: one picture."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.plan import Plan
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Scene

PICTURES = ("camera", "receiver")  # as taken by the camera, and as enhanced by the receiver

ENHANCED = "Receiver's picture, enhanced by "
"""The title of an enhanced picture, which is also in its file, before the enhancement's name."""


@dataclass(frozen=True, eq=False)
class Frame:
    """A simulated picture with its scene, plan and profile.

    There are two pictures: the receiver enhances the contrast on the panel in the camera's picture,
    and decodes the result.

    Parameters
    ----------
    plan
        The effects simulated, with reasons.
    image : ndarray of uint8, shape (number of ``rows``, columns)
        The receiver's picture with the scene's enhancement, which is decoded.
    rows
        The rows of the picture that are in ``image``: all, or in a draft every k-th. A view draws
        each row of a draft k rows high.
    profile : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column, in grey levels, before enhancement and rounding,
        but after the file if one is simulated. With column effects only, it is the column's value
        PV_sim, also outside the panel.
    signal : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column of the receiver's picture, in grey levels; this is
        the decoder's input. With column effects only, it is the enhanced value, also outside the
        panel.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners in order, each as (column, row).
    timings
        Seconds of each stage in the order of computation; effects are stages with their names.
    make_camera_image
        Returns the camera's picture.
    estimate_errors
        Returns the errors of a draft's profile and signal, by name; None if there are none.
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
        """Rows of the picture for each row of ``image``; more than 1 in a draft."""
        return self.rows.step

    @cached_property
    def camera_image(self) -> ByteArray:
        """The camera's picture, before the receiver's enhancement, shape as ``image``."""
        return self.make_camera_image()

    @cached_property
    def draft_error(self) -> Mapping[str, float]:
        """Error of a draft's ``profile`` and ``signal`` against the whole picture's, by name.

        RMS over the columns of the panel's bounding rectangle, in grey levels, from the sampling
        errors of both pictures. 0 if the picture is not a draft, or all its rows are alike.
        """
        return self.estimate_errors() if self.estimate_errors else {"profile": 0.0, "signal": 0.0}

    def picture(self, picture_kind: str) -> ByteArray:
        """Return the picture of the ``"camera"`` or the ``"receiver"``.

        Raises
        ------
        ParameterError
            There is no such picture.
        """
        check_choice("picture", picture_kind, PICTURES)
        return self.camera_image if picture_kind == "camera" else self.image

    def picture_title(self, picture_kind: str) -> str:
        """Return the title of a picture, with the receiver's enhancement."""
        if picture_kind == "camera":
            return "Camera's picture"
        enhancement = self.scene.model.enhancement
        is_enhanced = enhancement != "none"
        return ENHANCED + enhancement if is_enhanced else "Receiver's picture, not enhanced"
