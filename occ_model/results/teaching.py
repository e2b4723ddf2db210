"""Results for teaching: equations with numbers, and a column's exposure."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray


@dataclass(frozen=True, slots=True)
class Term:
    """A part of an equation."""

    text: str  # As HTML with ``sub`` and ``sup`` only
    parameters: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Equation:
    """An equation, in symbols and in numbers."""

    name: str  # The name by which a lesson refers to it
    source: str  # Its number in the paper, or where else it is from
    meaning: str  # A short description of the result, as HTML like a term's
    # Its right side in symbols and with the scene's numbers
    symbols: tuple[Term, ...]
    numbers: tuple[Term, ...]
    result: str  # The result with its unit, or why there is none

    @property
    def parameters(self) -> frozenset[str]:
        return frozenset(name for term in self.numbers for name in term.parameters)


@dataclass(frozen=True, eq=False, slots=True)
class ExposureWindow:
    """One column's exposure on the LED's waveform, in seconds from the first chip drawn."""

    column: int
    start: float
    end: float
    # Shape (chips + 1,): start of each chip around the exposure, and end of the last one
    edges: FloatArray
    lit: ByteArray  # Shape (chips,): whether the LED is on in each
    on_time: float
    # Whether the exposure holds more chips than are drawn; these are its first ones
    shortened: bool

    @property
    def exposure_time(self) -> float:
        """Length of the exposure, in seconds."""
        return self.end - self.start

    @property
    def lit_parts(self) -> FloatArray:
        """Starts and ends of the lit times within the exposure, shape (parts, 2), a part a chip."""
        begins = np.maximum(self.edges[:-1], self.start)
        ends = np.minimum(self.edges[1:], self.end)
        seen = (self.lit == 1) & (ends > begins)
        return np.stack([begins[seen], ends[seen]], axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class LightCurve:
    """The light of the LED over the columns that begin their exposures meanwhile."""

    # Shape (knots,): the light, 0 to 1, which is linear from each knot to the next; two knots lie
    # at the same column where it jumps
    columns: FloatArray
    light: FloatArray
    # Shape (chips + 1,): the column at which each chip starts, and at which the last one ends
    edges: FloatArray
    lit: ByteArray  # Shape (chips,): whether the LED is on in each
    places: IndexArray  # Shape (chips,): the number of each chip within the period sent, from 0

    def light_at(self, column: float) -> float:
        after = int(np.searchsorted(self.columns, column, side="right"))
        after = min(max(after, 1), len(self.columns) - 1)
        columns, light = self.columns[after - 1 : after + 1], self.light[after - 1 : after + 1]
        return float(np.interp(column, columns, light))

    def mean(self, first: float, last: float) -> float:
        """Return the mean light between two columns within the curve."""
        areas = np.diff(self.columns) * (self.light[1:] + self.light[:-1]) / 2.0
        integral = np.concatenate([[0.0], np.cumsum(areas)])
        at_first, at_last = np.interp([first, last], self.columns, integral)
        return float(at_last - at_first) / (last - first)


@dataclass(frozen=True, eq=False, slots=True)
class RollingShutter:
    """Exposures of evenly chosen columns, in time from the first column's start."""

    columns: IndexArray  # Shape (shown,): the columns
    starts: FloatArray  # Shape (shown,): when the exposure of each begins, in seconds
    exposure_time: float  # How long each lasts, in seconds
    lit_fraction: FloatArray  # Shape (shown,): fraction of each exposure for which the LED is on
    # Shape (chips + 1,): when each chip begins, and when the last one ends, in seconds
    edges: FloatArray
    lit: ByteArray  # Shape (chips,): whether the LED is on in each

    @property
    def duration(self) -> float:
        """Time from the first start to the last end, in seconds."""
        return float(self.starts[-1]) + self.exposure_time


@dataclass(frozen=True, slots=True)
class MarkedValue:
    """A value of a parameter that is worth a mark."""

    value: float
    label: str
    meaning: str
