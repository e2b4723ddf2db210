"""Results for teaching: equations with numbers, and a column's exposure."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray


@dataclass(frozen=True, slots=True)
class Term:
    """A part of an equation.

    Parameters
    ----------
    text
        As HTML with ``sub`` and ``sup`` only.
    """

    text: str
    parameters: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Equation:
    """An equation, in symbols and in numbers.

    Parameters
    ----------
    name
        The name by which a lesson refers to it.
    source
        Its number in the paper, or where else it is from.
    meaning
        A short description of the result, as HTML like a term's.
    symbols, numbers
        Its right side in symbols and with the scene's numbers.
    result
        The result with its unit, or why there is none.
    """

    name: str
    source: str
    meaning: str
    symbols: tuple[Term, ...]
    numbers: tuple[Term, ...]
    result: str

    @property
    def parameters(self) -> frozenset[str]:
        """All parameters that it depends on."""
        return frozenset(name for term in self.numbers for name in term.parameters)


@dataclass(frozen=True, eq=False, slots=True)
class ExposureWindow:
    """One column's exposure on the waveform of the LED.

    Times are in seconds from the start of the first chip that is drawn.

    Parameters
    ----------
    edges : ndarray of float64, shape (chips + 1,)
        Start of each chip around the exposure, and end of the last one.
    lit : ndarray of uint8, shape (chips,)
        Whether the LED is on in each.
    shortened
        Whether the exposure holds more chips than are drawn; these are its first ones.
    """

    column: int
    start: float
    end: float
    edges: FloatArray
    lit: ByteArray
    on_time: float
    shortened: bool

    @property
    def exposure_time(self) -> float:
        """Length of the exposure, in seconds."""
        return self.end - self.start

    @property
    def lit_parts(self) -> FloatArray:
        """Starts and ends of the times that the LED is on within the exposure, shape (parts, 2).

        Each chip is a part of its own. Together they are the time on, unless the drawing is
        shortened.
        """
        begins = np.maximum(self.edges[:-1], self.start)
        ends = np.minimum(self.edges[1:], self.end)
        seen = (self.lit == 1) & (ends > begins)
        return np.stack([begins[seen], ends[seen]], axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class LightCurve:
    """The light of the LED over the columns that begin their exposures meanwhile.

    Parameters
    ----------
    columns, light : ndarray of float64, shape (knots,)
        The light, 0 to 1, which is linear from each knot to the next; two knots lie at the same
        column where it jumps.
    edges : ndarray of float64, shape (chips + 1,)
        The column at which each chip starts, and at which the last one ends.
    lit : ndarray of uint8, shape (chips,)
        Whether the LED is on in each.
    places : ndarray of int64, shape (chips,)
        The number of each chip within the period sent, from 0.
    """

    columns: FloatArray
    light: FloatArray
    edges: FloatArray
    lit: ByteArray
    places: IndexArray

    def chip_at(self, column: float) -> int | None:
        """Return the index of the chip that is sent at a column, None outside the curve."""
        if not self.edges[0] <= column < self.edges[-1]:
            return None
        return int(np.searchsorted(self.edges, column, side="right")) - 1

    def light_at(self, column: float) -> float:
        """Return the light at a column within the curve, from it on where it jumps there."""
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
    """Exposures of evenly chosen columns, in time from the first column's start.

    Parameters
    ----------
    columns : ndarray of int, shape (shown,)
        The columns.
    starts : ndarray of float64, shape (shown,)
        When the exposure of each begins, in seconds.
    exposure_time
        How long each lasts, in seconds.
    lit_fraction : ndarray of float64, shape (shown,)
        Fraction of each exposure for which the LED is on.
    edges : ndarray of float64, shape (chips + 1,)
        When each chip begins, and when the last one ends, in seconds.
    lit : ndarray of uint8, shape (chips,)
        Whether the LED is on in each.
    """

    columns: IndexArray
    starts: FloatArray
    exposure_time: float
    lit_fraction: FloatArray
    edges: FloatArray
    lit: ByteArray

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
