"""Request and results of the bench: bit errors over the exposure, and over the noise."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from occ_model.results.bit_errors import BitErrors
from occ_model.scene.scene import Scene

_CAMERA = Scene().camera

EXPOSURES = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)
"""Exposures in symbols."""

DECIBELS = (10.0, 15.0, 20.0, 25.0, 30.0)
"""Signal-to-noise ratios: the chips' variance over that of a row's noise."""

BenchPlace: TypeAlias = tuple[str, str, float, float]
"""The scheme, what is varied (``"exposure"`` or ``"noise"``), the exposure and the ratio."""


@dataclass(frozen=True, slots=True)
class BenchRequest:
    """What the bench measures."""

    # Each the name of a line code, or of a line code and a framing with a slash between
    schemes: tuple[str, ...] = ("manchester",)
    decoders: tuple[str, ...] = ()
    # The exposures in symbols, tried at ``at_decibels``, and the signal-to-noise ratios, tried at
    # ``at_exposure``
    exposures: tuple[float, ...] = EXPOSURES
    decibels: tuple[float, ...] = DECIBELS
    # The exposure of the curve over noise, and the ratio of the curve over exposure
    at_exposure: float = 4.0
    at_decibels: float = 30.0
    rows_a_symbol: float = 5.0  # Rows that are read out while a symbol lasts
    payload_bits: int = 256  # Bits of a payload; each picture shows another one
    bits: int = 10_240
    seed: int = 1
    # Of the schemes, as the parameters of a scene
    preamble: str = ""
    error_correction: str = "none"
    rows: int = _CAMERA.columns  # Rows of a picture, all of which see the light
    # Time between two rows in seconds; it matters for bits a second alone
    readout_time: float = _CAMERA.readout_time

    @property
    def points(self) -> tuple[BenchPlace, ...]:
        """Where it is measured."""
        return tuple(
            (scheme, axis, exposure, ratio)
            for scheme in self.schemes
            for axis, exposure, ratio in (
                *(("exposure", exposure, self.at_decibels) for exposure in self.exposures),
                *(("noise", self.at_exposure, ratio) for ratio in self.decibels),
            )
        )


@dataclass(frozen=True, slots=True)
class BenchPoint:
    """Bit errors of a decoder at one exposure and one noise."""

    scheme: str
    axis: str
    exposure: float
    decibels: float
    errors: BitErrors
    note: str = ""  # Why the first payload was not read that was not; empty where all were

    @property
    def place(self) -> float:
        """Where the point lies on its axis."""
        return self.exposure if self.axis == "exposure" else self.decibels

    @property
    def explanation(self) -> str:
        """The note, and why the bit error rate is above 0.5 where it is."""
        return f"{self.note} {self.errors.why_above_half}".strip()


@dataclass(frozen=True, slots=True)
class BenchBounds:
    """What theory says of the points of a bench."""

    # The exposures, in symbols, at which chips that alternate leave no stripes
    nulls: tuple[float, ...]
    # For each axis the exposures or ratios, and the bits that light of Gaussian levels can carry to
    # one picture there
    most_bits: Mapping[str, tuple[tuple[float, ...], tuple[float, ...]]]


HEADER = (
    "scheme", "decoder", "varied", "exposure (symbols)", "signal to noise (dB)", "bits",
    "wrong bits", "bit error rate", "low", "high", "payloads right", "payloads",
    "bits a second", "bits from", "bits to", "note",
)  # fmt: skip
"""The columns of the table."""


def written(points: Sequence[BenchPoint], frames_a_second: float) -> list[tuple[object, ...]]:
    """Return the rows of the table under :data:`HEADER`."""
    return [
        (
            point.scheme,
            point.errors.decoder,
            point.axis,
            point.exposure,
            point.decibels,
            point.errors.bits,
            point.errors.errors,
            point.errors.rate,
            point.errors.low,
            point.errors.high,
            point.errors.pictures_right,
            point.errors.pictures,
            point.errors.bits_a_second(frames_a_second),
            *point.errors.bits_a_second_interval(frames_a_second),
            point.explanation,
        )
        for point in points
    ]
