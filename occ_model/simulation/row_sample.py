"""A picture's signal from a sample of its rows.

Stripes run along the rows; all else varies slowly from row to row. Some bands of rows, evenly over
the panel, therefore show what the whole picture would. A band has eight rows, those of a block of
a JPEG file: what becomes of a block depends on that block alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from statistics import NormalDist

import numpy as np

from occ_model.arrays import ByteArray, IndexArray, Pixels
from occ_model.camera.enhancement import Enhancement
from occ_model.effects.effect import NoiseEffect, PaperView
from occ_model.results.frame import Plan
from occ_model.scene.scene import Scene
from occ_model.simulation.columns import expose_columns
from occ_model.simulation.noise import Drawn
from occ_model.simulation.pixels import PixelExposure
from occ_model.simulation.stage_timer import StageTimer

BAND = 8  # rows of a band
BANDS = 24  # bands across the panel

_SURROUNDING_BANDS = 6  # bands of rows above the panel, and below it: surroundings and stray light
_PAIRS = BANDS // 2  # pairs of neighbouring bands, whose noise is opposite: its mean is nothing

_QUANTILE_STRIDE = 7
"""Quantiles from a pair to the next one: light varies from band to band, the noise not with it.
Without a common divisor with the number of pairs, so that each quantile is used once."""

_TABLE_ENTRIES = 4096  # entries of the table of normal deviates


@dataclass(frozen=True, eq=False, slots=True)
class SampledPicture:
    # Shape (rows, columns): the rows one below the other, those beside the panel repeated until
    # each part has as many as its fraction of the whole picture
    image: ByteArray
    rows_each: float  # Rows of the whole picture that each row across the panel stands for


@dataclass(frozen=True, slots=True)
class _Part:
    """Bands that sample a part of the picture, and how often each is repeated in the sample."""

    bands: tuple[range, ...]
    repeats: int


def sample_picture(view: PaperView, plan: Plan, seed: int) -> SampledPicture | None:
    """Simulate the receiver's picture of some rows; None where it would save little.

    Its noise is spread evenly over the bands, so that a column's mean over the panel has hardly any
    sampling error; that of the whole picture has to be added.
    """
    across = _span(view)
    rows_each = len(across) / (BANDS * BAND)
    if rows_each < 2.0:
        return None
    parts = (
        _sample_beside(range(across.start), rows_each),
        _Part(_spread(across, BANDS), 1),
        _sample_beside(range(across.stop, view.scene.camera.rows), rows_each),
    )
    columns, timer = expose_columns(view, plan), StageTimer()
    bands = [band for part in parts for band in part.bands]
    exposure = PixelExposure(view, plan, columns, timer, bands)
    enhancement = Enhancement(columns.profile, view.scene.model.enhancement)
    image = exposure.pictures(enhancement, seed, SystematicNoise).image
    return SampledPicture(_repeated(image, parts), rows_each)


def _span(view: PaperView) -> range:
    """Return the rows that the panel spans, to whole bands; the whole picture if none is seen."""
    rows = view.scene.camera.rows
    first, last = (view.region.first_row, view.region.last_row) if view.is_visible else (0, rows)
    return range(first // BAND * BAND, min(-(-last // BAND) * BAND, rows // BAND * BAND))


def _sample_beside(rows: range, rows_each: float) -> _Part:
    """Sample rows beside the panel by few bands, repeated in proportion to their number."""
    height = len(rows)
    if height < BAND:
        return _Part((), 0)
    count = min(_SURROUNDING_BANDS, height // BAND)
    return _Part(_spread(rows, count), max(1, round(height / (rows_each * BAND * count))))


def _spread(rows: range, count: int) -> tuple[range, ...]:
    """Return bands evenly over some rows, each the one in the middle of its part."""
    blocks = len(rows) // BAND
    places = ((np.arange(count) + 0.5) * (blocks / count)).astype(int)
    starts = (rows.start // BAND + places) * BAND
    return tuple(range(int(start), int(start) + BAND) for start in starts)


def _repeated(image: ByteArray, parts: tuple[_Part, ...]) -> ByteArray:
    pieces, first = [], 0
    for part in parts:
        last = first + BAND * len(part.bands)
        pieces += [image[first:last]] * part.repeats
        first = last
    return np.concatenate(pieces)


class SystematicNoise:
    """Noise whose values at one place of all bands are spread evenly over its distribution.

    At a row of a band and a column, the bands have quantiles in equal steps from a random first one
    (systematic sampling), each also with the opposite sign (antithetic variates). Within a band the
    numbers are independent, as drawn ones are, so that a file changes a block as it would.
    Effects use the same numbers, scaled to their total deviation.
    """

    def __init__(self, effects: Sequence[NoiseEffect], scene: Scene, seed: int) -> None:
        self._effects = effects
        random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
        self._first = random.random((BAND, scene.camera.columns), dtype=np.float32)
        self._row = 0

    def draw(self, rows: int) -> Drawn:
        """Choose the quantiles of the next rows."""
        place = self._row + np.arange(rows)
        self._row += rows
        return lambda: [(self._effects, self._normal(place))]

    def _normal(self, place: IndexArray) -> Pixels:
        band = place // BAND
        step = (band // 2 * _QUANTILE_STRIDE % _PAIRS / _PAIRS).astype(np.float32)
        quantile = self._first[place % BAND] + step[:, None]
        entry = (quantile * _TABLE_ENTRIES).astype(np.int32) % _TABLE_ENTRIES
        normal: Pixels = _deviates()[entry]
        normal[band % 2 == 1] *= np.float32(-1.0)
        return normal


@lru_cache(maxsize=1)
def _deviates() -> Pixels:
    """Return the normal deviates of evenly spaced quantiles."""
    normal = NormalDist()
    found = [normal.inv_cdf((place + 0.5) / _TABLE_ENTRIES) for place in range(_TABLE_ENTRIES)]
    return np.array(found, dtype=np.float32)
