"""What the simulation and the receiver hand to whoever shows or stores it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.scene import Scene


def _nothing() -> ByteArray:
    return np.empty(0, dtype=np.uint8)


@dataclass(frozen=True, slots=True)
class Region:
    """A rectangle of an image: rows and columns from the first to before the last."""

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


@dataclass(frozen=True, slots=True)
class Location:
    """Where a decoder found the panel, and how.

    Parameters
    ----------
    region
        The rectangle.
    bright_level
        The grey level from which a pixel counts as bright.
    contours
        How many contours the bright pixels formed.
    growth
        By how many pixels they were grown until one was left.
    """

    region: Region
    bright_level: int
    contours: int
    growth: int


@dataclass(frozen=True, slots=True)
class Decision:
    """What a plan does with one effect.

    Parameters
    ----------
    effect
        Its name.
    label
        The field's term for it.
    kind
        ``"column"``: it leaves all rows of the panel alike; ``"noise"``: alike but for independent
        noise; ``"image"``: not alike.
    bound
        How much leaving it out can change what is observed, root mean square in levels of the
        stretched profile. 0 where the scene has none of it.
    included
        Whether it is simulated.
    forced
        Whether the user decided so.
    reason
        Why, in words.
    """

    effect: str
    label: str
    kind: str
    bound: float
    included: bool
    forced: bool
    reason: str


@dataclass(frozen=True, slots=True)
class Plan:
    """Which effects are simulated, and why.

    Parameters
    ----------
    tolerance
        How much all that is left out may change what is observed, in levels of the stretched
        profile.
    observable
        What is observed: ``"image"`` or ``"profile"``.
    decisions
        One for each effect, in the order that light travels.
    left_out
        How much all that is left out, by the plan and not by the user, can change what is
        observed: at most the tolerance.
    stretch
        Levels of the stretched profile to one grey level.
    """

    tolerance: float
    observable: str
    decisions: tuple[Decision, ...]
    left_out: float
    stretch: float

    def __contains__(self, effect: object) -> bool:
        return any(d.effect == effect and d.included for d in self.decisions)

    @property
    def included(self) -> tuple[str, ...]:
        """The names of the effects that are simulated."""
        return tuple(d.effect for d in self.decisions if d.included)

    @property
    def kinds(self) -> frozenset[str]:
        """The kinds of the effects that are simulated."""
        return frozenset(d.kind for d in self.decisions if d.included)

    def __str__(self) -> str:
        return "\n".join(f"{d.label}: {d.reason}" for d in self.decisions)


@dataclass(frozen=True, eq=False, slots=True)
class Frame:
    """One simulated picture and what it was made of.

    Parameters
    ----------
    scene
        The scene.
    image : ndarray of uint8, shape (rows, columns)
        The picture.
    plan
        Which effects were simulated.
    profile : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column, in grey levels, before enhancement and rounding.
        With column effects only it is the column's value itself, PV_sim; also in columns that do
        not show the panel.
    enhanced : ndarray of uint8, shape (columns,)
        The column values after enhancement; as they stand in the image where that has column
        effects only.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners in the image, each as (column, row), in order round the panel.
    timings
        Seconds that each stage took, an effect under its name, in the order they ran.
    """

    scene: Scene
    plan: Plan
    image: ByteArray
    profile: FloatArray
    enhanced: ByteArray
    corners: FloatArray
    timings: Mapping[str, float]


@dataclass(frozen=True, eq=False, slots=True)
class Runs:
    """A signal of zeros and ones, as runs of equal values.

    Parameters
    ----------
    values : ndarray of uint8, shape (runs,)
        0 and 1 in turn.
    lengths : ndarray of int64, shape (runs,)
        Columns of each.
    """

    values: ByteArray
    lengths: IndexArray


@dataclass(frozen=True, eq=False, slots=True)
class RunHistogram:
    """How often each run length occurs among the whole runs of one value.

    Parameters
    ----------
    counts : ndarray of int64, shape (longest + 1,)
        Runs of each length in columns.
    split
        The longest of the short runs by Otsu's threshold, None where all are alike.
    """

    counts: IndexArray
    split: int | None


@dataclass(frozen=True, eq=False, slots=True)
class DecodeResult:
    """What a decoder made of an image, step by step, as far as it came.

    Parameters
    ----------
    decoder
        Its name.
    failure
        None, or a sentence that says why no code was read.
    code
        The code, None where ``failure`` says why.
    bits : ndarray of uint8
        The bits read, the first sent first; empty where none were read. They can be there beside
        a failure, when the chips break the line code.

    region
        The rectangle of the image that was read.
    location
        How the region was found, None where a profile was read.
    signal : ndarray of float64, shape (columns of the region,)
        Mean of each column in grey levels.
    threshold
        The grey level that parts ones from zeros.
    runs
        The signal after the threshold, as runs.
    histograms
        The run lengths of zeros, and of ones.
    chip_length
        Length of one chip in columns.
    chips : ndarray of uint8
        The chips read, first sent first.
    chip_starts : ndarray of float64, shape as ``chips``
        The column of the region at which each chip starts.
    headers
        Where headers start among ``chips``.
    correlation
        Of the best code's forward model with the signal.
    confidence
        How far the best code is ahead of the second best, 0 to 1.
    folded : ndarray of float64, shape (bins,)
        The signal folded over one packet.
    model : ndarray of float64, shape (bins,)
        The best code's forward model, beside ``folded``.
    """

    decoder: str
    failure: str | None = None
    code: int | None = None
    bits: ByteArray = field(default_factory=_nothing)
    region: Region | None = None
    location: Location | None = None
    signal: FloatArray | None = None
    threshold: float | None = None
    runs: Runs | None = None
    histograms: tuple[RunHistogram, RunHistogram] | None = None
    chip_length: float | None = None
    chips: ByteArray = field(default_factory=_nothing)
    chip_starts: FloatArray | None = None
    headers: tuple[int, ...] = ()
    correlation: float | None = None
    confidence: float | None = None
    folded: FloatArray | None = None
    model: FloatArray | None = None


@dataclass(frozen=True, slots=True)
class AccuracyPoint:
    """What one way of simulating costs in time, and how wrong it is.

    Parameters
    ----------
    part
        ``"integration"``, ``"effects"``, ``"path"`` or ``"noise"``: what is compared.
    name
        The way.
    seconds
        Time that it takes.
    error
        How far it is from the best that is compared, in levels of the stretched profile.
    current
        Whether the settings at hand are this way.
    """

    part: str
    name: str
    seconds: float
    error: float
    current: bool = False
