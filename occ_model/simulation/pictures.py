"""The camera's picture, and the receiver's, which is made when it is asked for."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from time import perf_counter

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.picture_rows import PanelPart
from occ_model.simulation.columns import ColumnMeans
from occ_model.simulation.threads import each_in_threads


@dataclass(frozen=True, eq=False)
class PaintedColumns:
    """A picture whose rows are equal on the panel."""

    image: ByteArray  # Shape (rows, columns): the receiver's picture
    # Shape (columns,): the columns' values before and after enhancement
    profile: FloatArray
    signal: FloatArray
    make_camera_image: Callable[[], ByteArray]

    @cached_property
    def camera_image(self) -> ByteArray:
        return self.make_camera_image()


@dataclass(frozen=True, eq=False)
class Pictures:
    """A picture whose rows differ, with its column means before and after enhancement."""

    camera_image: ByteArray  # Shape (rows, columns)
    # Shape (columns,): mean of the panel's pixels in each column of the camera's picture, or the
    # column's value if it has no pixel of the panel
    profile: FloatArray
    panels: Sequence[tuple[slice, PanelPart]]  # Parts of the rows, and where they show the panel
    enhancement: Enhancement  # What the receiver does to the panel's pixels
    values: FloatArray  # Shape (columns,): the columns' values before enhancement
    timings: dict[str, float]  # Seconds of each stage, to which that of the enhancement is added

    @property
    def image(self) -> ByteArray:
        """The receiver's picture: the camera's, enhanced on the panel."""
        return self._received[0]

    @property
    def signal(self) -> FloatArray:
        """The column means of the receiver's picture, as ``profile``."""
        return self._received[1]

    @cached_property
    def _received(self) -> tuple[ByteArray, FloatArray]:
        start = perf_counter()
        image = np.empty_like(self.camera_image)

        def enhance(shown: tuple[slice, PanelPart]) -> ColumnMeans:
            place, panel = shown
            camera, out = self.camera_image[place], image[place]
            out[:] = camera
            for columns in panel.inside:
                self.enhancement.enhance_bytes(camera[:, columns], out[:, columns])
            for columns, inside in panel.rims:
                enhanced = self.enhancement.enhance_bytes(camera[:, columns])
                np.copyto(out[:, columns], enhanced, where=inside)
            means = ColumnMeans(image.shape[1])
            means.add(panel, out)
            return means

        means = ColumnMeans(image.shape[1])
        for of_rows in each_in_threads(enhance, self.panels, "enhance"):
            means.include(of_rows)
        signal = means.means(self.enhancement(self.values).astype(np.float64))
        self.timings["image"] = self.timings.get("image", 0.0) + perf_counter() - start
        return image, signal
