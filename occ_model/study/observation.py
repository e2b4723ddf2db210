"""Read a scene's own picture without simulating its pixels, within milliseconds."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.projection import check_size, panel_corners, row_spans
from occ_model.effects.plan import signal_plan
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.results.decoding import DecodeResult, Region
from occ_model.results.frame import Plan
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.signals.batch import simulate_with_profile
from occ_model.study.signals.pictures import picture_itself


def panel_span(scene: Scene) -> Region | None:
    """Return the panel's rectangle, empty if no panel is in view; None for any other outline."""
    return _span_of(panel_corners(scene).tobytes(), scene.camera.rows, scene.camera.columns)


@lru_cache(maxsize=32)
def _span_of(corners: bytes, rows: int, columns: int) -> Region | None:
    """Return the rectangle, cached because the lines of a map share their poses."""
    first, last = row_spans(np.frombuffer(corners).reshape(-1, 2), rows, columns)
    lit_columns = np.flatnonzero(last > first)
    if lit_columns.size == 0:
        return Region(0, 0, 0, 0)
    if np.ptp(first[lit_columns]) + np.ptp(last[lit_columns]) > 0:
        return None
    left = int(lit_columns[0])
    return Region(left, left + lit_columns.size, int(first[left]), int(last[left]))


@dataclass(frozen=True, eq=False, slots=True)
class ProfileReading:
    """What decoders read from a scene, without its picture."""

    plan: Plan  # The simulated effects: those that a decoder's signal needs
    corners: FloatArray  # Shape (4, 2): the panel's corners in the image as (column, row)
    # Shape (columns,): mean of the panel's pixels in each column in grey levels, before and after
    # the receiver's enhancement; computed also for columns that do not show the panel
    profile: FloatArray
    signal: FloatArray
    results: dict[str, DecodeResult]  # by decoder


def read_profile(
    scene: Scene, settings: SimulationSettings, decoders: Sequence[str] = QUICK_DECODERS
) -> ProfileReading | None:
    """Read a scene's picture from its column means; None if its rows differ by more than noise."""
    check_size(scene.camera)
    if panel_span(scene) is None:
        return None
    plan = signal_plan([scene], settings)
    if "image" in plan.kinds:
        return None
    image = picture_itself(scene, plan, settings.seed)
    profile, signal, observation = simulate_with_profile(image)
    results = {decoder: observation.read(scene, decoder) for decoder in decoders}
    return ProfileReading(plan, panel_corners(scene), profile, signal, results)
