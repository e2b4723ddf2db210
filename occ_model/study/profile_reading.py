"""What decoders read of a scene by the profile path: an answer that needs no pixels.

A level panel without image effects shows the same column values in each of its rows. Its column
means, and with them the verdict of every decoder, follow in milliseconds at any size of the
picture; the picture itself confirms them later.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.projection import check_size
from occ_model.effects.paper_view import PaperView, paper_view_of
from occ_model.effects.plan import signal_plan
from occ_model.receiver.decoders import QUICK_DECODERS
from occ_model.results.decoding import DecodeResult, Region
from occ_model.results.plan import Plan
from occ_model.scene.scene import Scene, check_scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.simulation.columns import Columns, expose_columns
from occ_model.study.noisy_columns import NoisyColumns
from occ_model.study.observation import (
    Observation,
    means_without_noise,
    panel_span,
    region_without_noise,
)


@dataclass(frozen=True, eq=False, slots=True)
class ProfileReading:
    """What decoders read of a scene, without its picture."""

    plan: Plan  # The effects that are simulated: those that a decoder's signal calls for
    corners: FloatArray  # Shape (4, 2): the panel's corners in the image, each as (column, row)
    # Shape (columns,): means of the panel's pixels in each column, before the receiver's
    # enhancement and after it, in grey levels; also in columns that do not show the panel
    profile: FloatArray
    signal: FloatArray
    results: tuple[DecodeResult, ...]


def read_profile(
    scene: Scene,
    settings: SimulationSettings,
    decoders: Sequence[str] = QUICK_DECODERS,
    view: PaperView | None = None,
) -> ProfileReading | None:
    """Read a scene by the profile path; None where only pixels show what is read there.

    ``settings``: of its picture; the effects are planned for the signal all the same.
    """
    check_scene(scene)
    check_size(scene.camera)
    span = panel_span(scene)
    if span is None:
        return None
    chosen = signal_plan([scene], settings, needs_pixels=False)
    if "image" in chosen.kinds:
        return None
    view = view or paper_view_of(scene)
    columns = expose_columns(view, chosen)
    random = np.random.default_rng(settings.seed)
    profile, signal, observed = _column_means(scene, columns, chosen, span, random)
    results = tuple(observed.read(scene, decoder) for decoder in decoders)
    return ProfileReading(chosen, view.corners, profile, signal, results)


def _column_means(
    scene: Scene, columns: Columns, chosen: Plan, span: Region, random: np.random.Generator
) -> tuple[FloatArray, FloatArray, Observation]:
    """Return the means before and after enhancement, and what of them a decoder reads."""
    profile = columns.profile.copy()
    enhancement = Enhancement(profile, scene.model.enhancement)
    enhanced = enhancement(profile)
    signal = enhanced.astype(np.float64)
    if span.columns == 0:
        return profile, signal, Observation(to_bytes(columns.around), None)
    seen = slice(span.first_column, span.last_column)
    if "noise" not in chosen.kinds:
        around = to_bytes(columns.around)
        region = region_without_noise(scene, span, enhanced, around)
        means = means_without_noise(region, span, enhanced, around)
        return profile, signal, Observation(means, region)
    noisy = NoisyColumns(scene, columns, chosen, span, enhancement)
    region = noisy.draw_region(random)
    profile[seen], signal[seen] = noisy.plain_means(span), noisy.means(span, random)
    if (region.first_row, region.last_row) == (span.first_row, span.last_row) and (
        span.first_column <= region.first_column and region.last_column <= span.last_column
    ):  # what is drawn is what is read
        means = signal[region.first_column : region.last_column]
    else:
        means = noisy.means(region, random)
    return profile, signal, Observation(means, region)
