"""Results of decoding, step by step, and reasons why a picture is not read."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.errors import capitalize
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.units import PERCENT

PAPER_DECODER = "threshold"  # name of the paper's decoder, the default


def _no_bits() -> ByteArray:
    return np.empty(0, dtype=np.uint8)


@dataclass(frozen=True, slots=True)
class Region:
    """A rectangle of an image; ``last_row`` and ``last_column`` are the first beyond it."""

    first_row: int
    last_row: int
    first_column: int
    last_column: int

    @property
    def rows(self) -> int:
        """Height in rows."""
        return self.last_row - self.first_row

    @property
    def columns(self) -> int:
        """Width in columns."""
        return self.last_column - self.first_column

    def __str__(self) -> str:
        return (
            f"columns {self.first_column} to {self.last_column - 1}, "
            f"rows {self.first_row} to {self.last_row - 1}"
        )

    def within(self, outer: "Region") -> "Region":
        """Return a rectangle of a part of an image, ``outer``, in the rows and columns of all."""
        row, column = outer.first_row, outer.first_column
        return Region(
            row + self.first_row, row + self.last_row,
            column + self.first_column, column + self.last_column,
        )  # fmt: skip

    def crop(self, image: NDArray[Any]) -> NDArray[Any]:
        """Return the rectangle's pixels, a view of an image of shape (rows, columns)."""
        return image[self.first_row : self.last_row, self.first_column : self.last_column]


@dataclass(frozen=True, slots=True)
class Location:
    region: Region
    bright_level: int  # Lowest grey level of a pixel that counts as bright
    contours: int
    growth: int  # Pixels by which the contours were grown until they merged into one


@dataclass(frozen=True, eq=False, slots=True)
class Runs:
    """A signal of zeros and ones, as runs of equal values."""

    values: ByteArray  # Shape (runs,): 0 and 1 in turn
    lengths: IndexArray  # Shape (runs,): columns of each


@dataclass(frozen=True, eq=False, slots=True)
class RunHistogram:
    """Histogram of the lengths of complete runs of one value."""

    counts: IndexArray  # Shape (longest + 1,): runs of each length in columns
    # Length of the longest short run by Otsu's threshold, None if all lengths are equal
    split: int | None


@dataclass(frozen=True, eq=False, slots=True)
class DecodeResult:
    """The steps of a decoder on an image, up to the one that failed.

    Parameters
    ----------
    failure
        None, or a sentence on why no code was read.
    code
        The code, None if there is a failure.
    bits : ndarray of uint8
        The bits read, in the order sent; after a failure only if the chips violate the line code.
    payload
        The bits in the notation of the scene's payload: text, hex digits or bits; empty for a code.
    region
        The rectangle of the image that was read.
    location
        How the region was found; None for a profile.
    signal : ndarray of float64, shape (columns of the region,)
        Mean of each column in grey levels.
    threshold
        Grey level that separates ones from zeros.
    runs
        Runs of the signal after thresholding.
    histograms
        Run lengths of zeros and of ones.
    chip_length
        Length of one chip in columns.
    chips : ndarray of uint8
        The chips read, in the order sent.
    chip_starts : ndarray of float64, shape as ``chips``
        Start of each chip, in columns of the region.
    headers
        Indices of ``chips`` at which headers start.
    correlation
        Correlation of the best code's forward model with the signal.
    confidence
        From 0 to 1: how much better the best code fits than the second best, or the probability
        that all bits are right.
    folded : ndarray of float64, shape (bins,)
        The signal folded over one packet.
    model : ndarray of float64, shape (bins,)
        The best code's forward model of ``folded``.
    equalized : ndarray of float64, shape as ``signal``
        The light after deconvolution of the exposure, 255 being white: ``threshold`` refers to it.
    light : ndarray of float64, shape as ``signal``
        Light of each column as a fraction of full light, with the tone curve inverted.
    light_model : ndarray of float64, shape as ``signal``
        Light predicted from the chips read.
    chip_likelihoods : ndarray of float64, shape as ``chips``
        The probability that each chip is right.
    bit_likelihoods : ndarray of float64, shape as ``bits``
        The probability that each bit is right.
    """

    decoder: str
    failure: str | None = None
    code: int | None = None
    bits: ByteArray = field(default_factory=_no_bits)
    payload: str = ""
    region: Region | None = None
    location: Location | None = None
    signal: FloatArray | None = None
    threshold: float | None = None
    runs: Runs | None = None
    histograms: tuple[RunHistogram, RunHistogram] | None = None
    chip_length: float | None = None
    chips: ByteArray = field(default_factory=_no_bits)
    chip_starts: FloatArray | None = None
    headers: tuple[int, ...] = ()
    correlation: float | None = None
    confidence: float | None = None
    folded: FloatArray | None = None
    model: FloatArray | None = None
    equalized: FloatArray | None = None
    light: FloatArray | None = None
    light_model: FloatArray | None = None
    chip_likelihoods: FloatArray | None = None
    bit_likelihoods: FloatArray | None = None


@dataclass(frozen=True, slots=True)
class Remedy:
    """A remedy: parameters to change, in SI units, or another decoder."""

    label: str
    changes: Mapping[str, ParameterValue] = field(default_factory=dict)
    decoder: str = ""


@dataclass(frozen=True, slots=True)
class Cause:
    """What is wrong in a few words, why in a sentence, and a remedy, if any."""

    what: str
    why: str
    remedy: Remedy | None = None
    is_overexposed: bool = False

    def __str__(self) -> str:
        return f"{capitalize(self.what)}. {self.why}"


_SYMPTOM_END = re.compile(r"[:;.](?= |$)")


def symptom(failure: str) -> str:
    """Return the start of a failure, without its possible cause and remedy."""
    start = _SYMPTOM_END.split(failure, maxsplit=1)[0]
    return f"{start}." if start else ""


def overexposed_text(fraction: float) -> str:
    """Return the sentence on the fraction of the panel's columns that are overexposed."""
    return f"Overexposed: {PERCENT.format(fraction, 2)} of the panel's columns are saturated."
