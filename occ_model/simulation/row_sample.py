"""A picture's signal from a sample of its rows.

Stripes run along the rows; all else varies slowly from row to row. Some bands of rows, evenly over
the panel, therefore show what the whole picture would. A band has eight rows, those of a block of
a JPEG file: what becomes of a block depends on that block alone.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, IndexArray
from occ_model.effects.effect import PaperView
from occ_model.results.frame import Plan
from occ_model.simulation.columns import expose_columns
from occ_model.simulation.pixel_draw import Numbers
from occ_model.simulation.pixels import PixelExposure
from occ_model.simulation.stage_timer import StageTimer

BAND = 8  # rows of a band
BANDS = 24  # bands across the panel

_SURROUNDING_BANDS = 6  # bands of rows above the panel, and below it: surroundings and stray light
_PAIRS = BANDS // 2  # pairs of neighbouring bands, whose noise is opposite: its mean is nothing

_QUANTILE_STRIDE = 7
"""Quantiles from a pair to the next one: light varies from band to band, the noise not with it.
Without a common divisor with the number of pairs, so that each quantile is used once."""


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
    numbers = SystematicNumbers(view.scene.camera.columns, seed)
    image = exposure.pictures(columns.enhancement, numbers).image
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


class SystematicNumbers:
    """Uniform numbers that are spread evenly at one place of all bands.

    At a row of a band and a column, the bands have numbers in equal steps from a random first one
    (systematic sampling), each also with its complement (antithetic variates). Within a band the
    numbers are independent, as drawn ones are, so that a file changes a block as it would.
    """

    has_pattern = False  # that of few rows would be another one than that of all

    def __init__(self, columns: int, seed: int) -> None:
        random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
        self._first = random.integers(0, 2**32, (BAND, columns), dtype=np.uint32)

    def of(
        self,
        rows: range,  # noqa: ARG002 - bands have their numbers wherever they are
        place: slice,
        height: int,
    ) -> Iterator[Numbers]:
        """Yield the numbers of rows at a place in the sample, ``height`` of them at a time."""
        for start in range(place.start, place.stop, height):
            yield self._numbers(np.arange(start, min(start + height, place.stop)))

    def _numbers(self, at: IndexArray) -> Numbers:
        band = at // BAND
        step = (band // 2 * _QUANTILE_STRIDE % _PAIRS * (2**32 // _PAIRS)).astype(np.uint32)
        numbers: Numbers = self._first[at % BAND] + step[:, None]
        is_second = band % 2 == 1
        numbers[is_second] = ~numbers[is_second]
        return numbers
