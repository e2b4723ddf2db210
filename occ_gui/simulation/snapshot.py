"""Results of one scene: its pictures, and the readings of them or of the profile alone."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, Self, TypeAlias

import cv2
import numpy as np

from occ_gui.values.simulated import SimulationRequest
from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.bands import BandDepth
from occ_model.results.decoding import Cause, DecodeResult, Region
from occ_model.results.frame import Frame, Plan
from occ_model.scene.scene import Scene

Source: TypeAlias = Literal["profile", "draft", "picture"]

SOURCES: tuple[Source, ...] = ("profile", "draft", "picture")


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class ColumnView:
    """The columns of a scene, or of a frame of a film: profile, bands and chips."""

    scene: Scene
    # Shape (columns,): means of the panel's pixels in each column, before the receiver's
    # enhancement and after it
    profile: FloatArray
    signal: FloatArray
    # Shape (4, 2): the panel's corners in the picture, each as (column, row)
    corners: FloatArray
    # The result of each decoder by its name; the first one has located the panel for all
    results: Mapping[str, DecodeResult]
    # The transmitted bits in order of time; empty if a raw pattern is transmitted
    sent: tuple[int, ...]
    period_columns: float  # period of the light in columns; for a code, that of a packet
    has_edges: bool = False  # whether the rise and fall of the light are simulated
    # Shape (columns,): the band model's profile; None if ``band_undefined`` says why there is none
    band: FloatArray | None = None
    # Shape (columns,): the same after the receiver's enhancement; None without it
    enhanced_band: FloatArray | None = None
    band_undefined: str = ""  # a sentence, empty if there is a profile
    # Columns per packet by which that profile runs ahead of the simulated one
    band_drift: float = 0.0
    # Depth of the bars of a light without chips; None until it is known
    bars: BandDepth | None = None

    @property
    def light_period(self) -> float:
        """Seconds after which the light repeats."""
        return self.period_columns * self.scene.camera.readout_time

    @property
    def region(self) -> Region | None:
        """The part of the picture that the decoders have read; None if they found no panel."""
        first = next(iter(self.results.values()), None)
        return None if first is None else first.region

    def levels(self, *, enhanced: bool) -> FloatArray:
        return self.signal if enhanced else self.profile

    def band_levels(self, *, enhanced: bool) -> FloatArray | None:
        return self.enhanced_band if enhanced else self.band

    @property
    def panel_columns(self) -> tuple[float, float]:
        """The panel's first and last column in the picture; the picture's if it is outside."""
        last_column = len(self.profile) - 1
        panel = np.clip(self.corners[:, 0], 0, last_column)
        first, last = float(panel.min()), float(panel.max())
        return (first, last) if last - first >= 1.0 else (0.0, float(last_column))

    @property
    def panel_origin(self) -> tuple[float, float]:
        """The panel's upper left corner as (column, row), moved into the picture if outside."""
        left, top = self.corners.min(axis=0).tolist()
        return max(left, 0.0), max(top, 0.0)


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Reading(ColumnView):
    """The reading of one scene: its profile, the band model, and the decoders' results."""

    request: SimulationRequest
    # What was read: the ``"profile"``, without pixels; a ``"draft"`` of the picture; or finally the
    # exact ``"picture"``
    source: Source
    plan: Plan
    # Labels of the effects that were left out, but are included in studies of the same scene
    missing_effects: tuple[str, ...] = ()
    has_picture: bool = False
    overexposed: float = 0.0  # fraction of the panel's columns
    # Change of the observable by all effects left out, in the unit of the tolerance
    error: float = 0.0
    # Why decoders have not read the scene, by their names; None before it is known
    causes: Mapping[str, Cause] | None = None


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Snapshot(Reading):
    """The results for one scene with its exact picture."""

    frame: Frame
    reading_seconds: float

    @property
    def simulation_seconds(self) -> float:
        return sum(self.frame.timings.values())


@dataclass(frozen=True, eq=False, slots=True)
class PictureView:
    """The pixels of a scene's picture, or of a frame of a film, and their place in it."""

    image: ByteArray  # the pixels, of shape (len(rows), columns)
    rows: range  # their rows in the whole picture, of which a draft has only some
    size: tuple[int, int]
    # Shape (4, 2): the panel's corners in the whole picture, each as (column, row)
    corners: FloatArray

    @property
    def is_whole(self) -> bool:
        """Whether the rows are spread over the whole picture."""
        return (len(self.rows) + 1) * self.rows.step > self.size[0]

    def view_as(self, _picture_kind: str) -> Self:
        return self


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    frame: Frame
    # The scene and the settings from which it was simulated, if known
    request: SimulationRequest | None = None
    # The reading of the same scene to be shown together with the picture, if known already
    reading: Reading | None = None

    def view_as(self, picture_kind: str) -> PictureView:
        """Return the pixels of the camera's picture or of the receiver's."""
        frame, camera = self.frame, self.frame.scene.camera
        image = frame.picture(picture_kind)
        return PictureView(image, frame.rows, (camera.rows, camera.columns), frame.corners)


def mean_of_cells(pixels: ByteArray, columns: int, rows: int) -> ByteArray:
    """Average an image down to a size; an axis that has fewer pixels than asked for keeps them.

    It is halved repeatedly, which is fast, and then reduced by a ratio of less than two. The edge
    that halving leaves out is smaller than a pixel of the screen.
    """
    # Where one axis grows, OpenCV averages along neither.
    rows, columns = min(rows, pixels.shape[0]), min(columns, pixels.shape[1])
    while pixels.shape[0] >= 2 * rows and pixels.shape[1] >= 2 * columns:
        pixels = halve(pixels)
    if pixels.shape == (rows, columns):
        return pixels
    smaller = cv2.resize(pixels, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(smaller, dtype=np.uint8)


def halve(pixels: ByteArray) -> ByteArray:
    """Average squares of four pixels; an odd row or column at the edge is left out.

    For this ratio OpenCV is many times faster than for any other.
    """
    half = (pixels.shape[1] // 2, pixels.shape[0] // 2)
    even = pixels[: 2 * half[1], : 2 * half[0]]
    return np.asarray(cv2.resize(even, half, interpolation=cv2.INTER_AREA), dtype=np.uint8)
