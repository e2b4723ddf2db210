"""Results of one scene: what is read of it, early or from its picture."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from occ_gui.values.simulated import SimulationRequest
from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.results.frame import Frame
from occ_model.results.plan import Plan
from occ_model.scene.scene import Scene

Source: TypeAlias = Literal["profile", "draft", "picture"]

SOURCES: tuple[Source, ...] = ("profile", "draft", "picture")


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class ColumnView:
    """What rows of columns show, of a scene or of a frame of a film: profile, bands and chips."""

    scene: Scene
    # Shape (columns,): means of the panel's pixels in each column, before the receiver's
    # enhancement and after it
    profile: FloatArray
    signal: FloatArray
    # Shape (4, 2): the panel's corners in the picture, each as (column, row)
    corners: FloatArray
    decoded: DecodeResult
    others: tuple[DecodeResult, ...] = ()
    # The transmitted bits in order of time; empty where a raw pattern is transmitted
    sent: tuple[int, ...]
    packet_columns: float
    has_edges: bool = False  # whether the light rises and falls in a time that is seen
    # Shape (columns,), or None: the band model's profile, None where ``band_undefined``
    # says why there is none
    band: FloatArray | None = None
    # Shape (columns,), or None: the same as a receiver would enhance it
    enhanced_band: FloatArray | None = None
    band_undefined: str = ""  # a sentence, empty where there is a profile
    # Columns by which that profile is ahead of the simulated one after each packet
    band_drift: float = 0.0

    @property
    def results(self) -> tuple[DecodeResult, ...]:
        return (self.decoded, *self.others)

    def result_of(self, decoder: str) -> DecodeResult | None:
        return next((result for result in self.results if result.decoder == decoder), None)

    def levels(self, *, enhanced: bool) -> FloatArray:
        return self.signal if enhanced else self.profile

    def band_levels(self, *, enhanced: bool) -> FloatArray | None:
        return self.enhanced_band if enhanced else self.band

    @property
    def panel_columns(self) -> tuple[float, float]:
        """The panel's first and last column in the picture; the picture's where it is outside."""
        last_column = len(self.profile) - 1
        panel = np.clip(self.corners[:, 0], 0, last_column)
        first, last = float(panel.min()), float(panel.max())
        return (first, last) if last - first >= 1.0 else (0.0, float(last_column))

    @property
    def panel_origin(self) -> tuple[float, float]:
        """Column and row of the panel's upper left corner in the picture.

        Those of the picture's corner where the panel reaches beyond it.
        """
        left, top = self.corners.min(axis=0).tolist()
        return max(left, 0.0), max(top, 0.0)


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Reading(ColumnView):
    """What is read of one scene: its profile, the band model beside it, and the results."""

    request: SimulationRequest
    # What it was read from: ``"profile"``, without pixels; a ``"draft"`` of the picture; or the
    # exact ``"picture"``, which has the last word
    source: Source
    plan: Plan
    # Effects that were left out and the studies of the same scene take in, by label
    called_for: tuple[str, ...] = ()
    has_picture: bool = False


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Snapshot(Reading):
    """The results for one scene with its exact picture."""

    frame: Frame
    reading_seconds: float

    @property
    def simulation_seconds(self) -> float:
        return sum(self.frame.timings.values())
