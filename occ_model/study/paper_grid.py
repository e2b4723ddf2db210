"""The paper's experiment: success rate over frequency, distance and exposure time."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from occ_model.results import RateSettings
from occ_model.scene.presets import load_preset
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import check_rate, right_bits

FREQUENCIES = tuple(2000.0 * step for step in range(1, 11))
"""2 to 20 kHz in steps of 2 kHz (II.A)."""

DISTANCES = tuple(round(0.6 + 0.2 * step, 1) for step in range(8))
"""60 to 200 cm in steps of 20 cm (II.A)."""

IMAGES = 5
"""Images taken for each frequency, exposure time and distance (II.A)."""

DEVICES = {
    "phone": ("phone-68us", "phone-136us"),
    "tablet": ("tablet-61us", "tablet-122us"),
}
"""The presets of each device, its lowest exposure time first."""


@dataclass(frozen=True, slots=True)
class GridPoint:
    """One measured point.

    Parameters
    ----------
    preset, decoder
        Their names.
    switching_frequency, distance
        In Hz and m.
    images
        How many were read.
    seed
        ``success_rate`` with this seed gives the same rate again.
    rate
        Percent.
    """

    preset: str
    decoder: str
    switching_frequency: float
    distance: float
    images: int
    seed: int
    rate: float

    @property
    def sent_bits(self) -> int:
        """Bits sent in all images."""
        return self.images * load_preset(self.preset).transmitter.bits

    @property
    def right_bits(self) -> int:
        """Bits of them that were read rightly."""
        return round(self.rate / 100.0 * self.sent_bits)


def point_scene(preset: str, switching_frequency: float, distance: float) -> Scene:
    """Give the scene of a point."""
    return load_preset(preset).replace(switching_frequency=switching_frequency, distance=distance)


def measure(
    presets: Sequence[str],
    decoders: Sequence[str],
    images: int = IMAGES,
    seed: int = 1,
    progress: Callable[[], object] = lambda: None,
) -> Iterator[GridPoint]:
    """Measure the success rate at every point of the paper's experiment, point by point.

    Parameters
    ----------
    presets, decoders
        Names.
    images
        Images a point.
    seed
        Every point gets a seed of its own from this one.
    progress
        Called after each point.
    """
    points = list(product(presets, FREQUENCIES, DISTANCES))
    seeds = np.random.SeedSequence(seed).generate_state(len(points)).tolist()
    for (preset, frequency, distance), own_seed in zip(points, seeds, strict=True):
        scene = point_scene(preset, frequency, distance)
        settings = RateSettings(images, tuple(decoders), own_seed)
        check_rate(scene, settings)
        sent = images * scene.transmitter.bits
        for decoder, right in zip(decoders, right_bits(scene, settings), strict=True):
            rate = 100.0 * right / sent
            yield GridPoint(preset, decoder, frequency, distance, images, own_seed, rate)
            progress()


def point_count(presets: Sequence[str], decoders: Sequence[str]) -> int:
    """Count the points that :func:`measure` measures."""
    return len(presets) * len(decoders) * len(FREQUENCIES) * len(DISTANCES)


def ceases_at(points: Sequence[GridPoint], readable: float = 60.0) -> float | None:
    """Find the lowest frequency from which on no distance is read at ``readable`` percent.

    Returns
    -------
    float or None
        Hz, None where the highest frequency is still read.
    """
    best = {
        frequency: max(p.rate for p in points if p.switching_frequency == frequency)
        for frequency in sorted({p.switching_frequency for p in points})
    }
    ceased = None
    for frequency, rate in reversed(best.items()):
        if rate >= readable:
            break
        ceased = frequency
    return ceased
