"""Simulate the signals that decoders read from many pictures at once.

All rows of a band have the same distribution, see :mod:`occ_model.study.signals.bands`, so that
nothing needs pixels: the histogram of a picture is the sum of its columns' distributions, the
receiver's enhancement follows from it, and a mean over rows is normal. What does not depend on the
light is computed once for all pictures of a scene, whatever their frequency and exposure.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.grey_law import GreyLaw, grey_law
from occ_model.camera.interpolation import Places, interpolate_at
from occ_model.camera.photometry import saturate
from occ_model.camera.pixel_noise import GREYS
from occ_model.camera.projection import check_size
from occ_model.effects.noise import noise_of
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import FullWell, Jpeg, quantization_steps
from occ_model.receiver.decode import decode
from occ_model.receiver.signal import bright_level
from occ_model.results.decoding import DecodeResult, Region
from occ_model.scene.scene import Scene
from occ_model.study.signals.bands import Bands, bands_of, column_gains, without_light
from occ_model.study.signals.exposed import (
    Image,
    PixelLevels,
    as_one_band,
    columns_of,
    even_out,
    expose,
    interpolate_each,
    some_bands,
    some_bands_of,
    weights_of_levels,
)
from occ_model.study.signals.grey_tables import (
    StoredMeans,
    convert_to_file_levels,
    places_of_stored,
    table_of_file,
)
from occ_model.study.signals.received_pixels import BandPlaces, ReceivedPixels

_MOST_VALUES = 2**17  # pixel values of bands that are computed at once, to stay in a cache
_MOST_IMAGES = 64  # images that are simulated at once
_IDENTITY: FloatArray = np.arange(float(GREYS))[None, :]


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


def simulate_images(images: Sequence[Image]) -> list[Observation]:
    """Simulate images, at once those of similar scenes, wherever they are in the sequence."""
    found: dict[int, Observation] = {}
    for numbers, batch in _group_images(images):
        found |= zip(numbers, batch.observe(), strict=True)
    return [found[number] for number in range(len(images))]


def simulate_with_profile(image: Image) -> tuple[FloatArray, FloatArray, Observation]:
    """Simulate an image; return also the means of the panel's pixels before and after enhancement.

    They have the shape (columns,), and are computed for columns that do not show the panel, too.
    """
    ((_, batch),) = _group_images([image])
    (observation,) = batch.observe()
    profile, signal = batch.profiles()
    region, span = observation.region, batch.bands.span
    if region is not None and span is not None and region.rows == span.rows:
        signal[region.first_column : region.last_column] = observation.signal
    return profile, signal, observation


def _group_images(images: Sequence[Image]) -> Iterator[tuple[Sequence[int], "_Batch"]]:
    """Group images by what does not depend on the light; yield their numbers, too."""
    keys: dict[int, Scene] = {}  # scenes without light by identity, as most have many images
    groups: dict[tuple[Scene, frozenset[str]], list[int]] = {}
    for number, image in enumerate(images):
        scene = keys.get(id(image.scene))
        if scene is None:
            scene = keys[id(image.scene)] = without_light(image.scene)
        groups.setdefault((scene, image.included), []).append(number)
    for (scene, included), numbers in groups.items():
        check_size(scene.camera)
        bands = bands_of(scene, included)
        size = max(bands.panel.size, scene.camera.columns)
        count = min(max(_MOST_VALUES // size, 1), _MOST_IMAGES)
        for start in range(0, len(numbers), count):
            part = numbers[start : start + count]
            yield part, _Batch([images[number] for number in part], bands)


class _Batch:
    """Some pictures of scenes that differ only in light."""

    def __init__(self, images: Sequence[Image], bands: Bands) -> None:
        self._images, self.bands = images, bands
        self._scene = scene = images[0].scene
        self._randoms = [image.random for image in images]
        included = images[0].included
        panel, around = expose(images)
        noise, law = noise_of(scene, included), None
        if noise is None:
            for limit in effects_named(included, FullWell):
                panel, around = limit.apply(scene, panel), limit.apply(scene, around)
            panel, around = even_out(saturate(panel)), saturate(around)
        else:
            law = grey_law(noise, max(float(panel.max()), float(around.max())))
        self._panel, self._around = panel, around
        self._pixels = PixelLevels(law)
        self._places = self._pixels.places(panel)
        self._enhancements = self._enhance()
        self._curves = np.array([each.curve for each in self._enhancements], dtype=np.float64)
        quality = scene.camera.jpeg_quality if Jpeg.name in included else 0
        self._steps = quantization_steps(quality) if quality else None
        self._table = self._pixels.table
        if self._steps is not None:
            self._table = table_of_file(law, self._steps.tobytes())

    def _enhance(self) -> list[Enhancement]:
        """Return each picture's enhancement, as :func:`occ_model.effects.noise.enhancement_of`."""
        pixels, panel = self._pixels, self._panel
        ends = np.stack([panel.min(axis=1), panel.max(axis=1)], axis=1)
        if pixels.law is not None:
            ends = interpolate_at(pixels.law.means, pixels.places(ends))
        weights = np.full(panel.shape, float(self._scene.camera.rows), dtype=np.float32)
        counts = pixels.table.histograms(weights_of_levels(self._places, weights, pixels.table))
        method = self._scene.model.enhancement
        return [Enhancement(end, method, own) for end, own in zip(ends, counts, strict=True)]

    def profiles(self) -> tuple[FloatArray, FloatArray]:
        """Return the first picture's expected means of the panel's pixels, (columns,) each.

        Those of columns that do not show it are without noise.
        """
        below, fraction = self._places
        places, law, seen = (below[0], fraction[0]), self._pixels.law, self.bands.columns
        profile = saturate(self._panel[0])
        signal = self._enhancements[0](profile).astype(np.float64)
        if law is not None:
            enhanced = self._pixels.table.means_of(self._curves[:1])[0]
            profile[seen] = interpolate_at(law.means, places)[seen]
            signal[seen] = interpolate_at(enhanced, places)[seen]
        return profile, signal

    def observe(self) -> Iterator[Observation]:
        """Simulate the signals that decoders read."""
        span = self.bands.span
        if span is None:
            for around in np.broadcast_to(saturate(self._around), self._panel.shape):
                yield Observation(to_bytes(around), None)
            return
        places = self._find_places()
        # Drawn before what takes a varying number of random numbers.
        columns = self.bands.size[1]
        noise = [random.standard_normal(columns, dtype=np.float32) for random in self._randoms]
        regions = self._draw_regions(places)
        mean, variance = self._mean_over_bands(places)
        of_beside, variance_beside = self._identity_moments(places.beside)
        if self.bands.weights is not None:
            missing = 1.0 - self.bands.weights.sum(axis=0)
            mean += missing * self._seen(of_beside)
        for index, region in enumerate(regions):
            crossed = min(region.last_row, span.last_row) - max(region.first_row, span.first_row)
            part = max(crossed, 0) / region.rows
            means, spread = (
                self._in_region(region, inner[index], outer[index], part)
                for inner, outer in ((mean, of_beside), (variance, variance_beside))
            )
            if self._pixels.law is not None:
                own = noise[index][region.first_column : region.last_column]
                means += np.sqrt(spread / region.rows) * own
            yield Observation(means, region)

    def _seen(self, values: FloatArray) -> FloatArray:
        """Return values, (images, columns or 1), in the columns of the bands."""
        return values if values.shape[1] == 1 else values[:, self.bands.columns]

    def _in_region(
        self, region: Region, inner: FloatArray, outer: FloatArray, part: float
    ) -> FloatArray:
        """Return a quantity's mean over a rectangle's rows, of which a part is in the bands."""
        seen, columns = self.bands.columns, self.bands.size[1]
        means = np.broadcast_to(outer, (columns,)).astype(np.float64)
        means[seen] = part * inner + (1.0 - part) * means[seen]
        return means[region.first_column : region.last_column]

    def _draw_regions(self, places: BandPlaces) -> list[Region]:
        """Draw the rectangle in which a receiver finds the panel, for each picture."""
        received = ReceivedPixels(self.bands, self._table, self._curves, places.some_bands())
        counts = received.expected_histograms()
        if self._pixels.law is None:
            drawn = list(np.rint(counts).astype(np.int64))
        else:
            drawn = [random.poisson(own) for random, own in zip(self._randoms, counts, strict=True)]
        found = [bright_level(own, self._scene.receiver.bright_fraction) for own in drawn]
        levels = np.array([0 if level is None else level for level in found])
        return received.bright_from(levels).draw_regions(self._randoms)

    def _known_gains(self, panel: Places) -> tuple[FloatArray, FloatArray] | None:
        """Return what the sensor's own gains add to column means, and the variance they explain.

        Both have the shape (images, seen). The law counts a pixel's gain as random, but it is the
        same in all pictures.
        """
        law, span = self._pixels.law, self.bands.span
        if law is None or span is None or not law.noise.gain_variation:
            return None
        tables = self._table.means_of(self._curves)
        slopes = np.gradient(tables, axis=1) * self._levels_per_gain(law)
        slope = interpolate_each(slopes, some_bands(panel))
        camera, variation = self._scene.camera, law.noise.gain_variation
        gains = column_gains(
            variation, self._scene.sensor.sensor_seed, (camera.rows, camera.columns), span
        )[self.bands.columns]
        known = np.square(variation * slope).mean(axis=1)
        added = gains * slope.mean(axis=1)
        return np.asarray(added, dtype=np.float64), np.asarray(known, dtype=np.float64)

    def _levels_per_gain(self, law: GreyLaw) -> FloatArray:
        """Return by how many levels of the table a pixel moves for a change of its gain by 1."""
        own: FloatArray = np.arange(float(len(law.below))) * (law.power / law.noise.gamma)
        if self._steps is None:
            return own
        return convert_to_file_levels(law, np.gradient(law.means) * own)

    def _mean_over_bands(self, places: BandPlaces) -> tuple[FloatArray, FloatArray]:
        """Return the mean of pixels of the receiver's picture, and their variance in a band."""
        part = self.bands.panel
        mean = interpolate_each(self._table.means_of(self._curves), places.panel)
        variance: FloatArray = np.zeros((len(mean), mean.shape[2]))
        if self._pixels.law is not None:
            squares = self._table.means_of(self._curves**2)
            square = interpolate_each(squares, some_bands(places.panel))
            own = some_bands_of(mean)
            variance = np.maximum(square - own**2, 0.0).mean(axis=1, dtype=np.float64)
        known = self._known_gains(places.panel)
        if known is not None:
            mean += known[0][:, None]
            variance = np.maximum(variance - known[1], 0.0)
        columns = np.flatnonzero((part != 1.0).any(axis=0))
        if columns.size:
            off, variance_off = self._identity_moments(columns_of(places.around, columns))
            mean[:, :, columns] += (1.0 - part[:, columns]) * (off - mean[:, :, columns])
            fraction = part[:, columns].mean(axis=0)
            variance[:, columns] *= fraction
            variance[:, columns] += (1.0 - fraction) * variance_off.mean(axis=1)
        if self.bands.weights is None:
            return mean.mean(axis=1, dtype=np.float64), variance
        return np.asarray((mean * self.bands.weights).sum(axis=1, dtype=np.float64)), variance

    def _identity_moments(self, places: Places) -> tuple[FloatArray, FloatArray]:
        """Return mean and variance of pixels that are not enhanced."""
        mean, square = (
            interpolate_at(self._table.means_of(_IDENTITY**power)[0], places) for power in (1, 2)
        )
        return mean, np.maximum(square - mean**2, 0.0)

    def _find_places(self) -> BandPlaces:
        bands, pixels = self.bands, self._pixels
        dimming = 1.0 if bands.dimming_beside is None else bands.dimming_beside
        beside = pixels.places(np.atleast_2d(self._around * dimming))
        if bands.light is None:
            around = pixels.places(self._around)
            seen = bands.columns if around[0].shape[1] > 1 else slice(None)
            panel = as_one_band(self._places, bands.columns)
            return BandPlaces(panel, as_one_band(around, seen), beside)
        values = bands.expose(
            self._panel[:, bands.columns], self._seen(self._around), self._scene.camera
        )
        places = pixels.places(values)
        if self._steps is None:
            return BandPlaces(places, places, beside)
        table, law = pixels.table, pixels.law
        identity = table.means_of(_IDENTITY)[0]
        squares = np.zeros(len(table.below)) if law is None else law.deviations**2
        below, fraction = places
        means, variance = (
            interpolate_at(each, (below, fraction)).astype(np.float32)
            for each in (identity, squares)
        )
        count = means.shape[2]
        numbers = np.array([
            random.integers(0, 2**32, count, dtype=np.uint32) for random in self._randoms
        ])  # fmt: skip
        stored = StoredMeans(self._steps).store(means, variance, numbers)
        places = places_of_stored(stored)
        stored_beside = places_of_stored(interpolate_at(identity, beside))
        return BandPlaces(places, places, stored_beside)
