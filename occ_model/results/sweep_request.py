"""The request of a sweep: a scene, varied parameters, and how each rate is measured."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Literal, TypeAlias

from occ_model.results.bit_errors import FRAMES_A_SECOND, bits_a_second
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import TOLERANCE, Scene

SignalPath: TypeAlias = Literal["auto", "profile", "rows", "image"]
"""How a decoder's signal is simulated: "image" from the whole image, all others without pixels."""

ShownQuantity: TypeAlias = Literal["rate", "bits"]  # success rates in percent, or net bits a second
SHOWN_QUANTITIES: tuple[ShownQuantity, ...] = ("rate", "bits")

SIGNAL_PATHS: tuple[SignalPath, ...] = ("auto", "profile", "rows", "image")

MOST_POINTS = 1_000_000  # points of a sweep, whose counts all stay in memory
MOST_AXES = 31  # parameters of a sweep: NumPy's arrays have 32 axes, one is the decoders'
MOST_IMAGES = 1_000_000  # images at a point
MOST_JOBS = 1024  # processes of a sweep

JOBS_A_CORE = 4  # most processes for each core, as more take memory and save no time
_AXES_IN_ORDER = ("bits", "", "exposure_time", "switching_frequency")
"""Parameters from that which changes least often from point to point to the one that changes most
often; "" stands for all others. The forward models of all codes are slow for many bits. Pictures
that differ in exposure and frequency alone are simulated at once."""


@dataclass(frozen=True, slots=True)
class RateSettings:
    images: int
    decoders: tuple[str, ...]
    seed: int = 1
    tolerance: float = TOLERANCE.default
    force: Mapping[str, bool] = field(default_factory=dict)
    path: SignalPath = "auto"
    # Images a second for the bits a second; it does not change any rate
    frames_a_second: float = FRAMES_A_SECOND


@dataclass(frozen=True, slots=True)
class SweepRequest:
    """A request for success rates at all combinations of some parameters' values."""

    scene: Scene
    # The values of each varied parameter, in SI units
    axes: Mapping[str, tuple[ParameterValue, ...]]
    settings: RateSettings

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(values) for values in self.axes.values())

    @property
    def point_count(self) -> int:
        """The number of combinations of the axes' values."""
        return math.prod(self.shape)

    def values(self, index: int) -> dict[str, ParameterValue]:
        """Return the parameters of a point by its index; the last axis runs fastest."""
        reversed_values: list[ParameterValue] = []
        for values in reversed(list(self.axes.values())):
            index, position = divmod(index, len(values))
            reversed_values.append(values[position])
        return dict(zip(self.axes, reversed(reversed_values), strict=True))

    def bits_sent(self, index: int) -> int:
        """Return the number of bits in an image of a point."""
        names = ("payload", "bits")
        changes = {name: value for name, value in self.values(index).items() if name in names}
        scene = self.scene.replace(**changes) if changes else self.scene
        return scene.transmitter.payload_length

    def bits_a_second(self, point: "SweepPoint", decoder: int) -> float | None:
        """Return the net bits a second of a point; None if the model refuses the scene.

        It assumes that each image has a new payload, which is read as often as the scene's own.
        """
        if not point.sent or not point.whole:
            return None
        images, values = self.settings.images, self.values(point.index)
        camera = self.scene.camera
        columns = values.get("columns", camera.columns)
        readout_time = float(columns) * float(values.get("readout_time", camera.readout_time))
        fraction = point.whole[decoder] / images
        bits = point.sent // images
        return bits_a_second(fraction, bits, self.settings.frames_a_second, readout_time)

    def in_order_of_work(self) -> Iterator[int]:
        """Yield the indices of the points in the order that takes the least time."""
        names = list(self.axes)
        order = sorted(
            names, key=lambda name: _AXES_IN_ORDER.index(name if name in _AXES_IN_ORDER else "")
        )
        sizes = [math.prod(self.shape[names.index(name) + 1 :]) for name in order]
        for indices in product(*(range(len(self.axes[name])) for name in order)):
            yield sum(size * index for size, index in zip(sizes, indices, strict=True))


@dataclass(frozen=True, slots=True)
class SweepPoint:
    index: int  # The point's index; the last axis runs fastest
    sent: int  # Bits sent in all images, 0 if the model refuses the scene
    right: tuple[int, ...]  # Number of these bits that each decoder read correctly
    # Why the model refuses the scene, or how often a plug-in has failed; else empty
    note: str = ""
    # Images of which each decoder read every bit correctly; empty if they were not counted
    whole: tuple[int, ...] = ()
