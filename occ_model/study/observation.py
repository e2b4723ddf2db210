"""Compute the column means that a decoder reads, without a whole image.

The profile path: all rows of a level panel have the same values, so a column's mean is known
without simulating its pixels. The distribution of the noise is passed through the enhancement, as
each pixel would be, and averaged over the rows. Where rows differ, a sample of them is simulated.
Every decoder's result is thus known within milliseconds, whatever the size of the picture, and is
confirmed later by the picture itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.normal import normal_fraction
from occ_model.camera.projection import check_size, panel_corners, row_spans
from occ_model.effects.effect import PaperView, paper_view_of
from occ_model.effects.plan import signal_plan
from occ_model.errors import ParameterError
from occ_model.receiver.decode import QUICK_DECODERS, decode
from occ_model.receiver.signal import bright_level, column_means, locate
from occ_model.results.decoding import DecodeResult, Region
from occ_model.results.frame import Plan
from occ_model.results.sweep_request import SignalPath
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.columns import Columns, expose_columns
from occ_model.simulation.render import render_plan
from occ_model.simulation.row_sample import SampledPicture, sample_picture
from occ_model.study.drawn_region import BrightFractions
from occ_model.study.noisy_columns import NoisyColumns


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


_LENS_SHIFT_DIVISOR = 50  # a lens shifts the panel by at most the larger side divided by this


_SEEDS = 2**32

# Negligible number of pixels beside the panel that are as bright as its brightest
_MAX_EXPECTED_BRIGHT = 0.01
_SMALLEST_SPREAD = 1e-9  # grey levels, in place of none


@dataclass(frozen=True, eq=False, slots=True)
class Observation:
    """The signal that a decoder reads."""

    signal: FloatArray | ByteArray  # Shape (columns of the region,): mean grey level of each column
    # The rectangle of the image over which the signal is averaged; None if the image shows no panel
    # and the signal is a whole row
    region: Region | None

    def read(self, scene: Scene, decoder: str) -> DecodeResult:
        result = decode(self.signal, scene, decoder)
        return result if self.region is None else replace(result, region=self.region)


def observe(
    view: PaperView,
    span: Region | None,
    plan: Plan,
    random: np.random.Generator,
    path: SignalPath = "auto",
) -> Observation | None:
    """Simulate the signal that a decoder reads from a picture; None if no panel is found in it.

    ``span``: the result of :func:`panel_span`; None if pixels must be simulated in any case.
    """
    if span is not None and "image" not in plan.kinds:
        return observe_profile(view, span, plan, random)
    if path == "profile":
        raise ParameterError(
            "path is 'profile'; a panel that is not level, or an image effect, needs 'image'."
        )
    scene, seed = view.scene, int(random.integers(_SEEDS))
    sample = None if path == "image" else sample_picture(view, plan, seed)
    if sample is not None and is_region_known(sample, view):
        return observe_sample(sample, scene, plan, random)
    picture = render_plan(view, plan, seed=seed).image
    bright_area = locate(picture, scene.receiver.bright_fraction)
    if bright_area is None:
        return None
    return Observation(column_means(picture, bright_area.region), bright_area.region)


def observe_profile(
    view: PaperView, span: Region, plan: Plan, random: np.random.Generator
) -> Observation:
    """Compute the column means that every decoder reads, without the image.

    The region is drawn at random with the distribution of the one found in images: see
    :mod:`occ_model.study.drawn_region`. ``span``: the result of :func:`panel_span`, which is the
    same at any start time.
    """
    columns = expose_columns(view, plan)
    if span.columns == 0:
        return Observation(to_bytes(columns.around), None)
    if columns.law is not None:
        noisy = NoisyColumns(view.scene, columns, columns.law, span)
        region = noisy.draw_region(random)
        return Observation(noisy.means(region, random), region)
    panel, around = columns.enhancement(columns.profile), to_bytes(columns.around)
    return _observe_without_noise(view.scene, span, panel, around)


def _observe_without_noise(
    scene: Scene, span: Region, panel: ByteArray, around: ByteArray
) -> Observation:
    """Return the column means of the rectangle that a receiver finds in a picture without noise."""
    rows, panel_columns = scene.camera.rows, slice(span.first_column, span.last_column)
    counts = np.bincount(around, minlength=256) * rows
    counts += np.bincount(panel[panel_columns], minlength=256) * span.rows
    counts -= np.bincount(around[panel_columns], minlength=256) * span.rows
    level = bright_level(counts.astype(np.int64), scene.receiver.bright_fraction)
    region = span
    if level is not None:
        bright = ((values >= level).astype(np.float64) for values in (panel, around))
        region = BrightFractions(rows, span, *bright).draw_region(np.random.default_rng(0))
    columns = slice(region.first_column, region.last_column)
    panel_rows = max(0, min(region.last_row, span.last_row) - max(region.first_row, span.first_row))
    fractions = np.zeros(len(panel))
    fractions[panel_columns] = panel_rows / region.rows
    fractions = fractions[columns]
    return Observation(fractions * panel[columns] + (1.0 - fractions) * around[columns], region)


def is_region_known(sample: SampledPicture, view: PaperView) -> bool:
    """Return whether the whole picture's region is known from a sample of its rows.

    No pixel beside the panel may be expected to become as bright, by noise, as the panel's
    brightest pixels.
    """
    scene, image = view.scene, sample.image
    bright_area = locate(image, scene.receiver.bright_fraction)
    if bright_area is None:
        return True
    margin = max(scene.camera.rows, scene.camera.columns) // _LENS_SHIFT_DIVISOR
    left = max(0, view.region.first_column - margin)
    for pixels_beside in (image[:, :left], image[:, view.region.last_column + margin :]):
        if not pixels_beside.size:
            continue
        mean, spread = np.array([pixels_beside.mean()]), np.array([pixels_beside.std()])
        limit = (mean - bright_area.bright_level + 0.5) / np.maximum(spread, _SMALLEST_SPREAD)
        (bright,) = normal_fraction(limit)
        if (
            np.any(pixels_beside >= bright_area.bright_level)
            or bright * pixels_beside.size * sample.rows_each > _MAX_EXPECTED_BRIGHT
        ):
            return False
    return True


def observe_sample(
    sample: SampledPicture, scene: Scene, plan: Plan, random: np.random.Generator
) -> Observation | None:
    """Estimate the column means of a whole picture from a sample; None if no panel is found."""
    bright_area = locate(sample.image, scene.receiver.bright_fraction)
    if bright_area is None:
        return None
    signal = column_means(sample.image, bright_area.region)
    if "noise" in plan.kinds:
        # Neighbouring rows differ only by noise.
        pairs = np.diff(bright_area.region.crop(sample.image).astype(np.float32), axis=0)[::2]
        variance = np.mean(pairs**2, axis=0, dtype=np.float64) / 2.0
        rows = max(bright_area.region.rows * sample.rows_each, 1.0)
        signal = signal + np.sqrt(variance / rows) * random.standard_normal(len(signal))
    return Observation(signal, bright_area.region)


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
    scene: Scene,
    settings: SimulationSettings,
    decoders: Sequence[str] = QUICK_DECODERS,
    view: PaperView | None = None,
) -> ProfileReading | None:
    """Read a scene on the profile path, planned for the signal; None if pixels are needed."""
    check_size(scene.camera)
    span = panel_span(scene)
    if span is None:
        return None
    effect_plan = signal_plan([scene], settings, needs_pixels=False)
    if "image" in effect_plan.kinds:
        return None
    view = view or paper_view_of(scene)
    columns = expose_columns(view, effect_plan)
    random = np.random.default_rng(settings.seed)
    profile, signal, observation = _draw_column_means(scene, columns, span, random)
    results = {decoder: observation.read(scene, decoder) for decoder in decoders}
    return ProfileReading(effect_plan, view.corners, profile, signal, results)


def _draw_column_means(
    scene: Scene, columns: Columns, span: Region, random: np.random.Generator
) -> tuple[FloatArray, FloatArray, Observation]:
    """Return the means before and after the enhancement, and the part that a decoder reads."""
    profile = columns.profile.copy()
    enhanced = columns.enhancement(profile)
    signal = enhanced.astype(np.float64)
    if span.columns == 0:
        return profile, signal, Observation(to_bytes(columns.around), None)
    panel_columns = slice(span.first_column, span.last_column)
    if columns.law is None:
        return (
            profile,
            signal,
            _observe_without_noise(scene, span, enhanced, to_bytes(columns.around)),
        )
    noisy = NoisyColumns(scene, columns, columns.law, span)
    region = noisy.draw_region(random)
    profile[panel_columns], signal[panel_columns] = (
        noisy.plain_means(span),
        noisy.means(span, random),
    )
    if (region.first_row, region.last_row) == (span.first_row, span.last_row) and (
        span.first_column <= region.first_column and region.last_column <= span.last_column
    ):  # the region read lies within the panel, so its means are those already drawn
        means = signal[region.first_column : region.last_column]
    else:
        means = noisy.means(region, random)
    return profile, signal, Observation(means, region)
