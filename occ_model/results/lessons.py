"""Lessons: steps with a goal, a scene and a question, and a student's answers."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

from occ_model.results.match import Match
from occ_model.scene.scene import Scene

Outcome = Literal["right", "near", "wrong", "unreadable"]

_NUMBER = re.compile(r"[-+−]?[\d.,]+(?:[eE][-+]?\d+)?")  # noqa: RUF001


@dataclass(frozen=True, slots=True)
class Check:
    """Rule by which a student's number is checked against the model."""

    quantity: str  # A name of ``occ_model.teaching.quantities.QUANTITIES``
    asked_in: str  # Unit of an answer without one; empty for a pure number
    tolerance: float  # Accepted difference, as a fraction of the model's value
    # The scene of the question, which may differ from the step's own
    scene: Scene
    # Parameters whose values the question names: an answer is checked only at these
    named: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Step:
    goal: str
    text: str
    question: str
    answer: str
    scene: Scene
    pane: str = ""  # The pane to show; empty for the current one
    photo: str = ""  # Name of the sample photo to open
    control: str = ""  # The parameter to change; empty for several or none
    # None where the answer is in words
    check: Check | None = None
    equation: str = ""  # Name of the equation that explains the answer
    # Whether the step shows the animation of the rolling shutter
    animation: bool = False
    # Action of the step's button, one of ``occ_model.teaching.lessons.ACTIONS``
    action: str = ""
    # Whether the step is about the student's photo; ``photo`` stands in while none is open
    own_photo: bool = False

    @property
    def asked(self) -> Scene:
        return self.scene if self.check is None else self.check.scene

    def judged_at(self, shown: Scene) -> Scene:
        """Return the scene of a check: the question's as long as the step's own is shown."""
        return self.asked if shown == self.scene else shown

    def with_unit(self, given: str) -> str:
        """Return an answer with the question's unit appended where it has none."""
        unit = "" if self.check is None else self.check.asked_in
        given = given.strip()
        return f"{given} {unit}" if unit and _NUMBER.fullmatch(given) else given


@dataclass(frozen=True, slots=True)
class Lesson:
    name: str
    title: str
    summary: str  # Learning objective, in one sentence
    steps: tuple[Step, ...]
    # Whether it is a lab sheet, which ends with the student's own measurement
    is_sheet: bool = False


@dataclass(frozen=True, slots=True)
class CheckedAnswer:
    """A student's answer to a step, checked."""

    text: str
    # None where the answer is in words
    outcome: Outcome | None
    sentence: str


@dataclass(frozen=True, slots=True)
class LessonList:
    """The lessons that were found."""

    # Built-in lessons, then those of the user's folder
    lessons: tuple[Lesson, ...]
    # Why files of the user's folder are not lessons, by file name
    problems: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class AnsweredStep:
    """A step with a student's answer to it."""

    step: Step
    answer: CheckedAnswer | None
    # The scene at which the answer was checked and which the report draws; the question's without
    # an answer
    scene: Scene
    # Match of the photo that the step is about; the report draws it
    match: Match | None = None
    photo: str = ""
