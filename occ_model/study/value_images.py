"""The images of a scene at values of one of its parameters, each read once and on demand."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.results.limits import Trial
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study.confidence import count_until_refuted, trial_of
from occ_model.study.range_end import EndSearch
from occ_model.study.success_rate import ImageSeries, read_ahead, right_bits_of_images

FEW_IMAGES = 5  # images that suffice to accept a value, unless it is reported
GAP_IMAGES = 60  # most images at a value that is not read between others that are, or reversely


class ValueImages:
    """What a decoder reads correctly in images at values of a parameter.

    The images of ``ends`` have other seeds than those of the scan, so that they were not used to
    choose the ends.
    """

    def __init__(
        self, scene: Scene, name: str, rate: float, settings: RateSettings, heartbeat: Heartbeat
    ) -> None:
        self._scene, self._name, self._rate = scene, name, rate
        self._settings, self._heartbeat = settings, heartbeat
        self._bits = scene.transmitter.payload_length
        self._right_bits: dict[float, list[int]] = {}  # in the images read so far, by value
        self._further: dict[float, Iterator[tuple[int, ...]]] = {}  # the right bits of the others
        self._refuted: dict[float, bool] = {}
        self.ends = EndSearch(self._measure_lost, rate, settings.images)

    def scan(self, values: Sequence[float]) -> None:
        """Read the first image of all values at once, and the next few where it is read."""
        if self._settings.path == "image":  # takes as long for each image
            return
        self._read_ahead(values, range(1))
        read = [value for value in values if self._right_bits[value] == [self._bits]]
        self._read_ahead(read, range(1, min(FEW_IMAGES, self._settings.images)))

    def try_first(self, values: Sequence[float]) -> list[Trial]:
        """Return a trial of one image at each value."""
        self._read_ahead(values, range(1))
        return [trial_of(value, self._right_bits[value], self._bits) for value in values]

    def try_few(self, value: float) -> Trial:
        """Count correct bits until enough images reach the rate or it can no longer be reached."""
        images, bits = self._settings.images, self._bits
        counts: list[int] = []
        for right in self._take(value, images):
            counts.append(right)
            image_count, right_bits = len(counts), sum(counts)
            if 100.0 * (right_bits + (images - image_count) * bits) < self._rate * images * bits:
                break
            if image_count >= FEW_IMAGES and 100.0 * right_bits >= self._rate * image_count * bits:
                break
        return trial_of(value, counts, bits)

    def try_all(self, value: float) -> Trial:
        """Return a trial of all images, because no interval holds for a count that stops early."""
        return trial_of(value, list(self._take(value, self._settings.images)), self._bits)

    def try_at_end(self, value: float) -> Trial:
        """Return a trial of the images of an end, at least as many as are wanted of any value."""
        missing = self._settings.images - len(self.ends.lost.get(value, ()))
        if missing > 0:
            self.ends.take([value], missing)
        counts = [round((1.0 - lost) * self._bits) for lost in self.ends.lost[value]]
        return trial_of(value, counts, self._bits)

    def is_read(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def is_refuted(self, value: float) -> bool:
        """Return whether images at a value refute that the rate is reached."""
        if value not in self._refuted:
            counts = self._take(value, GAP_IMAGES)
            is_refuted = count_until_refuted(counts, self._bits, self._rate / 100.0) is not None
            self._refuted[value] = is_refuted
        return self._refuted[value]

    def _take(self, value: float, count: int) -> Iterator[int]:
        """Yield the right bits of the first images at a value."""
        known = self._right_bits.setdefault(value, [])
        if value not in self._further:
            enough = replace(self._settings, images=max(self._settings.images, GAP_IMAGES))
            self._further[value] = right_bits_of_images(
                self._at(value), enough, self._heartbeat, first=len(known)
            )
        for number in range(count):
            if number == len(known):
                known += next(self._further[value])
            yield known[number]

    def _read_ahead(self, values: Sequence[float], numbers: range) -> None:
        if numbers:
            seed = self._settings.seed
            series = [ImageSeries(self._at(value), seed, numbers) for value in values]
            read = read_ahead(series, self._settings, self._heartbeat)
            for value, counts in zip(values, read, strict=True):
                self._right_bits.setdefault(value, []).extend(counts)

    def _measure_lost(self, values: Sequence[float], images: int) -> Iterator[list[float]]:
        """Yield the fractions of lost bits in further images of ends at some values."""
        series = []
        for value in values:
            first = len(self.ends.lost.get(value, ()))
            seed = _seed_at(value, self._settings.seed)
            series.append(ImageSeries(self._at(value), seed, range(first, first + images)))
        for counts in read_ahead(series, self._settings, self._heartbeat):
            yield [1.0 - right / self._bits for right in counts]

    def _at(self, value: float) -> Scene:
        return self._scene.replace(**{self._name: value})


def _seed_at(value: float, seed: int) -> int:
    """Return the seed of the images about an end at a value.

    Images with the same seed start at the same parts of a packet, and would be lost together.
    """
    return int(np.random.SeedSequence([seed, 2, *value.as_integer_ratio()]).generate_state(1)[0])
