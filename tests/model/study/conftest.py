"""A search for limits in which a law of the test replaces simulating and decoding."""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study import value_images
from occ_model.study.success_rate import ImageSeries

Decoding = Callable[[Callable[[float, int, int], float]], "Counter[tuple[float, int]]"]
"""Called with the fraction of correct bits as a function of frequency, image number and seed."""


def replace_reading(
    monkeypatch: pytest.MonkeyPatch, right_bits_of_images: Callable[..., Iterator[tuple[int]]]
) -> None:
    def read_ahead(
        series: list[ImageSeries], settings: RateSettings, heartbeat: object
    ) -> Iterator[list[int]]:
        for each in series:
            these = replace(settings, seed=each.seed, images=each.numbers.stop)
            right = right_bits_of_images(each.scene, these, heartbeat, first=each.numbers.start)
            yield [count for (count,) in right]

    monkeypatch.setattr(value_images, "right_bits_of_images", right_bits_of_images)
    monkeypatch.setattr(value_images, "read_ahead", read_ahead)


@pytest.fixture
def decoding(monkeypatch: pytest.MonkeyPatch) -> Decoding:
    """Replace all decoding, and count the images read by frequency and seed."""

    def replace_decoding(
        fraction: Callable[[float, int, int], float],
    ) -> "Counter[tuple[float, int]]":
        read: Counter[tuple[float, int]] = Counter()

        def right_bits_of_images(
            scene: Scene,
            settings: RateSettings,
            heartbeat: Callable[[], object],
            first: int = 0,
            **_: bool,
        ) -> Iterator[tuple[int]]:
            frequency = scene.transmitter.switching_frequency
            for image in range(first, settings.images):
                heartbeat()
                read[frequency, settings.seed] += 1
                yield (int(fraction(frequency, image, settings.seed) * scene.transmitter.bits),)

        replace_reading(monkeypatch, right_bits_of_images)
        return read

    return replace_decoding


def correct_within(*ranges: tuple[float, float]) -> Callable[[float, int, int], float]:
    """Return a decoding with all bits correct in these ranges, and half of them elsewhere."""
    return lambda frequency, *_: 1.0 if any(a <= frequency <= b for a, b in ranges) else 0.5
