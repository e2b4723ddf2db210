"""Results for teaching: equations with numbers, exposures of columns, lessons and answers."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.results.match import Match
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Term:
    text: str  # HTML with only ``sub`` and ``sup``
    parameters: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Equation:
    name: str  # The name by which a lesson refers to it
    source: str  # Its number in the paper, or another source
    meaning: str  # A short description of the result, as HTML like a term's
    # Its right-hand side in symbols, and with the scene's numbers
    symbols: tuple[Term, ...]
    numbers: tuple[Term, ...]
    result: str  # The result with its unit, or why there is none

    @property
    def parameters(self) -> frozenset[str]:
        return frozenset(name for term in self.numbers for name in term.parameters)


@dataclass(frozen=True, eq=False, slots=True)
class ExposureWindow:
    """One column's exposure on the light's waveform, in seconds from the first piece.

    A piece is an interval of constant light: for a code, a chip.
    """

    column: int
    start: float
    end: float
    # Shape (pieces + 1,): start of each piece around the exposure, and end of the last one
    edges: FloatArray
    levels: FloatArray  # Shape (pieces,): light of each, 1 being the panel fully lit
    on_time: float  # Seconds for which the panel is lit during the exposure
    # Whether only the first pieces of the exposure are drawn
    shortened: bool

    @property
    def exposure_time(self) -> float:
        """Length of the exposure, in seconds."""
        return self.end - self.start

    @property
    def lit_parts(self) -> FloatArray:
        """Start, end and light of each lit piece during the exposure, shape (parts, 3)."""
        begins = np.maximum(self.edges[:-1], self.start)
        ends = np.minimum(self.edges[1:], self.end)
        inside = (self.levels > 0.0) & (ends > begins)
        return np.stack([begins, ends, self.levels], axis=1)[inside]


@dataclass(frozen=True, eq=False, slots=True)
class LightCurve:
    """The light of the LED over the columns: each time is the column whose exposure starts then."""

    # Shape (knots,): the light, 1 being the panel fully lit, which is linear between knots; at a
    # jump, two knots are at the same column
    columns: FloatArray
    light: FloatArray
    # Shape (pieces + 1,): the column at which each piece starts, and at which the last one ends
    edges: FloatArray
    levels: FloatArray  # Shape (pieces,): light of each, sharp
    places: IndexArray  # Shape (pieces,): the number of each piece in the period sent, from 0

    def light_at(self, column: float) -> float:
        knot = int(np.searchsorted(self.columns, column, side="right"))
        knot = min(max(knot, 1), len(self.columns) - 1)
        columns, light = self.columns[knot - 1 : knot + 1], self.light[knot - 1 : knot + 1]
        return float(np.interp(column, columns, light))

    def mean(self, first: float, last: float) -> float:
        """Return the mean light between two columns on the curve."""
        areas = np.diff(self.columns) * (self.light[1:] + self.light[:-1]) / 2.0
        integral = np.concatenate([[0.0], np.cumsum(areas)])
        first_integral, last_integral = np.interp([first, last], self.columns, integral)
        return float(last_integral - first_integral) / (last - first)


@dataclass(frozen=True, eq=False, slots=True)
class RollingShutter:
    """Exposures of evenly spaced columns, with times from the first column's start."""

    columns: IndexArray  # Shape (n,): the columns
    starts: FloatArray  # Shape (n,): when the exposure of each begins, in seconds
    exposure_time: float  # How long each exposure lasts, in seconds
    lit_fraction: FloatArray  # Shape (n,): mean light of each, 1 being the panel fully lit
    # Shape (pieces + 1,): when each piece begins, and when the last one ends, in seconds
    edges: FloatArray
    levels: FloatArray  # Shape (pieces,): light of each

    @property
    def duration(self) -> float:
        """Time from the first start to the last end, in seconds."""
        return float(self.starts[-1]) + self.exposure_time


@dataclass(frozen=True, slots=True)
class MarkedValue:
    """A notable value of a parameter, marked in a view."""

    value: float
    label: str
    meaning: str


Outcome = Literal["right", "near", "wrong", "unreadable"]

_NUMBER = re.compile(r"[-+−]?[\d.,]+(?:[eE][-+]?\d+)?")  # noqa: RUF001


@dataclass(frozen=True, slots=True)
class Check:
    """How a student's number is checked against the model."""

    quantity: str  # A name of ``occ_model.teaching.quantities.QUANTITIES``
    asked_in: str  # Unit of an answer without one; empty for a pure number
    tolerance: float  # Accepted difference as a fraction of the model's value
    # The scene of the question, which may differ from the step's own
    scene: Scene
    # Parameters whose values the question names; an answer is checked only at these values
    named: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class LessonStep:
    goal: str
    text: str
    question: str
    answer: str
    scene: Scene
    pane: str = ""  # The pane to show; empty for the current one
    decoder: str = ""  # The decoder whose result is shown at first; empty for the paper's
    photo: str = ""  # Name of the sample photo to open
    control: str = ""  # The parameter to change; empty for several or none
    # None if the answer is in words
    check: Check | None = None
    equation: str = ""  # Name of the equation that explains the answer
    # Whether the step shows the animation of the rolling shutter
    animation: bool = False
    # Action of the step's button, one of ``occ_model.teaching.lessons.ACTIONS``
    action: str = ""
    # Whether the step is about the student's own photo; ``photo`` is used while none is open
    own_photo: bool = False

    @property
    def question_scene(self) -> Scene:
        return self.scene if self.check is None else self.check.scene

    def scene_to_judge(self, current: Scene) -> Scene:
        """Return the scene that an answer is checked by.

        It is the question's while the step's own scene is shown, else the one that is shown.
        """
        return self.question_scene if current == self.scene else current

    def with_unit(self, answer: str) -> str:
        """Append the question's unit to an answer without one."""
        unit = "" if self.check is None else self.check.asked_in
        answer = answer.strip()
        return f"{answer} {unit}" if unit and _NUMBER.fullmatch(answer) else answer


@dataclass(frozen=True, slots=True)
class Lesson:
    name: str
    title: str
    summary: str  # Learning objective in one sentence
    steps: tuple[LessonStep, ...]
    # Whether it is a lab sheet, which ends with the student's own measurement
    is_sheet: bool = False


@dataclass(frozen=True, slots=True)
class CheckedAnswer:
    text: str
    # None if the answer is in words
    outcome: Outcome | None
    sentence: str


@dataclass(frozen=True, slots=True)
class LoadedLessons:
    # The built-in lessons, then those of the user's folder
    lessons: tuple[Lesson, ...]
    # Why files of the user's folder are not lessons, by file name
    problems: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class AnsweredStep:
    step: LessonStep
    answer: CheckedAnswer | None
    # The scene at which the answer was checked, for the report; the question's without an answer
    scene: Scene
    # Match of the photo that the step is about, for the report
    match: Match | None = None
    photo: str = ""
