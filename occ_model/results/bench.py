"""Request and results of the bench: bit errors against exposure and against noise."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from occ_model.results.bit_errors import BitErrors
from occ_model.scene.scene import Scene

_CAMERA = Scene().camera

EXPOSURES = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)  # default exposures, in symbols

DECIBELS = (
    10.0,
    15.0,
    20.0,
    25.0,
    30.0,
)  # default ratios of the chips' variance to the noise's
BenchPlace: TypeAlias = tuple[str, str, float, float]  # scheme, varied axis, exposure, ratio in dB


@dataclass(frozen=True, slots=True)
class BenchRequest:
    # Each is a line code, or a line code and a framing separated by a slash
    schemes: tuple[str, ...] = ("manchester",)
    decoders: tuple[str, ...] = ()
    # Exposures in symbols, at the ratio ``at_decibels``, and signal-to-noise ratios, at the
    # exposure ``at_exposure``
    exposures: tuple[float, ...] = EXPOSURES
    decibels: tuple[float, ...] = DECIBELS
    # Exposure of the curve against noise, and ratio of the curve against exposure
    at_exposure: float = 4.0
    at_decibels: float = 30.0
    rows_a_symbol: float = 5.0  # Rows read out during a symbol
    payload_bits: int = 256  # Each picture has another payload
    bits: int = 10_240
    seed: int = 1
    # As in a scene's parameters
    preamble: str = ""
    error_correction: str = "none"
    rows: int = _CAMERA.columns  # Of a picture; all receive the light
    # In seconds; affects only bits a second
    readout_time: float = _CAMERA.readout_time

    @property
    def points(self) -> tuple[BenchPlace, ...]:
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
    # How often a plug-in has failed, or why the first unread payload was not read
    note: str = ""

    @property
    def place(self) -> float:
        return self.exposure if self.axis == "exposure" else self.decibels

    @property
    def explanation(self) -> str:
        """The note, and the reason for a bit error rate above 0.5."""
        return f"{self.note} {self.errors.why_above_half}".strip()


@dataclass(frozen=True, slots=True)
class BenchBounds:
    # Exposures in symbols at which alternating chips leave no stripes
    nulls: tuple[float, ...]
    # By axis, the exposures or ratios, and the bits a picture that light of Gaussian levels can
    # carry at each
    most_bits: Mapping[str, tuple[tuple[float, ...], tuple[float, ...]]]


HEADER = (  # the titles of the table's columns
    "scheme", "decoder", "varied", "exposure (symbols)", "signal to noise (dB)", "bits",
    "wrong bits", "bit error rate", "low", "high", "payloads right", "payloads",
    "bits a second", "bits from", "bits to", "note",
)  # fmt: skip


def table_rows(points: Sequence[BenchPoint], frames_a_second: float) -> list[tuple[object, ...]]:
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
