"""The pixels that a receiver sees of many pictures, in bands and beside them, by a table."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.interpolation import Places
from occ_model.camera.pixel_noise import GREYS
from occ_model.study.signals.bands import Bands
from occ_model.study.signals.exposed import (
    columns_of,
    interpolate_each,
    some_bands,
    some_bands_of,
    weights_of_levels,
)
from occ_model.study.signals.grey_tables import GreyDistribution
from occ_model.study.signals.region import BrightPixels


class BandPlaces(NamedTuple):
    """The places of pixel values in a table of levels."""

    # Shape (images, bands, seen): of pixels on the panel and around it, in the bands
    panel: Places
    around: Places
    beside: Places  # Shape (images, columns or 1): beside the bands

    def some_bands(self) -> "BandPlaces":
        return BandPlaces(some_bands(self.panel), some_bands(self.around), self.beside)


@dataclass(frozen=True, eq=False, slots=True)
class ReceivedPixels:
    """The pixels of some pictures, enhanced on the panel."""

    bands: Bands
    table: GreyDistribution
    curves: FloatArray  # Shape (images, 256): each enhancement's level for a grey level
    places: BandPlaces  # Of some of the bands only

    @property
    def _panel(self) -> Pixels:
        """The fraction of the pixels that show the panel, shape (bands, seen)."""
        return np.asarray(some_bands_of(self.bands.panel[None])[0])

    def expected_histograms(self) -> FloatArray:
        """Return the expected numbers of pixels of each grey level, shape (images, 256)."""
        span, (rows, columns), panel = self.bands.span, self.bands.size, self._panel
        assert span is not None  # noqa: S101 - only called with a panel in view
        each = np.float32(span.rows / len(panel))
        enhanced = self._histograms(self.places.panel, each * panel)
        counts = np.array([
            np.bincount(curve, weights=own, minlength=GREYS)
            for curve, own in zip(self.curves.astype(np.int64), enhanced, strict=True)
        ])  # fmt: skip
        if (panel != 1.0).any():
            counts += self._histograms(self.places.around, each * (np.float32(1.0) - panel))
        outside = np.full(columns, float(rows), dtype=np.float32)
        outside[self.bands.columns] -= span.rows
        return np.asarray(counts + self._histograms(self.places.beside, outside))

    def bright_from(self, levels: IndexArray) -> BrightPixels:
        """Return the probabilities of pixels of each picture's level or above it."""
        bands, panel = self.bands, self._panel
        assert bands.span is not None  # noqa: S101 - only called with a panel in view
        # The enhancement never falls: a pixel is bright after it if it is before.
        before = np.array([
            np.searchsorted(curve, level) for curve, level in zip(self.curves, levels, strict=True)
        ])  # fmt: skip
        bright = interpolate_each(self.table.fractions_from(before), self.places.panel)
        unenhanced = self.table.fractions_from(levels)
        columns = np.flatnonzero((panel != 1.0).any(axis=0))
        if columns.size:
            off = interpolate_each(unenhanced, columns_of(self.places.around, columns))
            bright[:, :, columns] += (1.0 - panel[:, columns]) * (off - bright[:, :, columns])
        beside = interpolate_each(unenhanced, self.places.beside).astype(np.float32)
        shape = len(beside), bands.size[1]
        everywhere = np.empty((shape[0], len(panel), shape[1]), dtype=np.float32)
        everywhere[:] = beside[:, None]
        everywhere[:, :, bands.columns] = bright
        return BrightPixels(
            bands.size, bands.span, everywhere, np.array(np.broadcast_to(beside, shape))
        )

    def _histograms(self, places: Places, weights: Pixels) -> FloatArray:
        if places[0].shape[-1] == 1:
            weights = weights.sum(axis=-1, keepdims=True)
        weights = np.broadcast_to(weights, places[0].shape)
        return self.table.histograms(weights_of_levels(places, weights, self.table))
