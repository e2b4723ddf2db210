"""Bit errors and net bits a second of a decoder; the request and the results of the bench."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from occ_model.scene.recording import FRAME_RATE
from occ_model.scene.scene import Scene

FRAMES_A_SECOND = FRAME_RATE.default  # default frame rate of a camera, in frames a second

_WHY_ABOVE_HALF = "Above 0.5, because all bits of an unread payload count as wrong."


@dataclass(frozen=True, slots=True)
class BitErrors:
    """Bit errors of a decoder over pictures, each with a random payload.

    Parameters
    ----------
    bits
        Number of bits sent.
    errors
        Number of wrong bits, including all bits of an unread payload.
    low, high
        The 95 % interval of the rate. As the bits of a payload fail together, it is based on the
        scatter between pictures, or on their number if all or no bits are wrong.
    pictures
        Number of pictures, with one payload each.
    pictures_right
        Number of pictures whose bits were all right and accepted by the decoder.
    right_low, right_high
        The 95 % interval of the fraction of such pictures.
    picture_time, readout_time
        Seconds to read out the panel's columns, and all columns.
    faults
        A sentence on how often a plug-in has failed, whose bits count as wrong; empty if none has.
    """

    decoder: str
    bits: int
    errors: int
    low: float
    high: float
    pictures: int
    pictures_right: int
    right_low: float
    right_high: float
    picture_time: float
    readout_time: float
    faults: str = ""

    @property
    def rate(self) -> float:
        """The fraction of the bits that are wrong, from 0 to 1."""
        return self.errors / self.bits

    @property
    def why_above_half(self) -> str:
        """Why the rate exceeds that of a guess; empty if it does not."""
        return _WHY_ABOVE_HALF if self.rate > 0.5 else ""

    @property
    def bits_a_picture(self) -> float:
        """Net bits a picture: those of a payload times the fraction of right payloads."""
        return self.bits / self.pictures * (self.pictures_right / self.pictures)

    @property
    def bits_a_second_of_picture(self) -> float:
        """Net bits a second while the panel is read out; 0 without a panel in view."""
        return self.bits_a_picture / self.picture_time if self.picture_time else 0.0

    def bits_a_second(self, frames_a_second: float = FRAMES_A_SECOND) -> float:
        """Return the net bits a second of a video with a new payload in each picture.

        Whatever is sent between two pictures is lost; see :meth:`gap`.
        """
        return self.bits_a_picture * frames_a_second

    def bits_a_second_interval(
        self, frames_a_second: float = FRAMES_A_SECOND
    ) -> tuple[float, float]:
        """Return the 95 % interval of :meth:`bits_a_second`."""
        sent_bits = self.bits / self.pictures * frames_a_second
        return sent_bits * self.right_low, sent_bits * self.right_high

    def gap(self, frames_a_second: float = FRAMES_A_SECOND) -> float:
        """Return the seconds between the last column of a picture and the first of the next.

        It is negative if the camera cannot take so many pictures.
        """
        return 1.0 / frames_a_second - self.readout_time


def bits_a_second(
    right_fraction: float, bits: int, frames_a_second: float, readout_time: float
) -> float:
    """Return the net bits a second of a video with a new payload in each picture.

    The readout time in seconds limits the frame rate, as pictures cannot overlap.
    """
    return right_fraction * bits * min(frames_a_second, 1.0 / readout_time)


@dataclass(frozen=True, slots=True)
class MostBits:
    """The scheme, frequency and number of bits with a decoder's highest net bit rate.

    Parameters
    ----------
    scene
        The best scene, None if every trial failed.
    pictures
        Number of pictures tried, each with its own payload and start; all their bits were right.
    bits_a_second
        Net bits a second of a video with one payload a picture.
    tried
        Number of faster combinations that were tried but could not be read.
    failure
        None, or a sentence on why there is no scene.
    faults
        A sentence on how often a plug-in has failed, whose pictures count as unread; empty if none
        has.
    """

    decoder: str
    scene: Scene | None
    pictures: int
    bits_a_second: float
    frames_a_second: float
    tried: int
    failure: str | None = None
    faults: str = ""


_CAMERA = Scene().camera

EXPOSURES = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)  # default exposures, in symbols

DECIBELS = (10.0, 15.0, 20.0, 25.0, 30.0)  # default ratios of the chips' variance to the noise's

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
    # For each axis, its exposures or ratios, and the most bits in a picture at each of them if the
    # light has Gaussian levels
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
