"""Lessons: steps with a goal, a scene, a question and its answer, and what a student found."""

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
    """How a student's number is checked against the model."""

    quantity: str  # Name of what is asked for, one of ``occ_model.teaching.quantities.QUANTITIES``
    asked_in: str  # The unit of an answer that is a number alone; empty for a pure number
    tolerance: float  # Largest difference that is right, as a fraction of the model's value
    # The scene that the question is about, which may differ from the one that the step sets
    scene: Scene
    # The parameters whose values the question names: an answer is checked only at these
    named: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a lesson."""

    goal: str
    text: str
    question: str
    answer: str
    scene: Scene
    pane: str = ""  # The pane to show it in, empty for the current one
    photo: str = ""  # Name of the sample photo to open, empty for none
    control: str = ""  # The one parameter to change, empty where several or none are meant
    # How the student's number is checked; None where the answer is in words
    check: Check | None = None
    equation: str = ""  # Name of the equation that explains the answer, empty for none
    # Whether the step shows how a rolling shutter exposes one column after the other
    animation: bool = False
    # What the step has a button for, one of ``occ_model.teaching.lessons.ACTIONS``; empty for none
    action: str = ""
    # Whether the step is about a photo of the student's; ``photo`` stands in for it while none is
    # open
    own_photo: bool = False

    @property
    def asked(self) -> Scene:
        """The scene that the question and the explanation are about."""
        return self.scene if self.check is None else self.check.scene

    def judged_at(self, shown: Scene) -> Scene:
        """Return the scene that an answer is checked at, given while another one was shown.

        While the step's own is shown nothing has been set yet: the answer is a prediction for the
        scene that the question is about.
        """
        return self.asked if shown == self.scene else shown

    def with_unit(self, given: str) -> str:
        """Return a given answer with the unit that it was asked in, where it is a number alone."""
        unit = "" if self.check is None else self.check.asked_in
        given = given.strip()
        return f"{given} {unit}" if unit and _NUMBER.fullmatch(given) else given


@dataclass(frozen=True, slots=True)
class Lesson:
    """A lesson."""

    name: str
    title: str
    summary: str  # What one can do after it, in one sentence
    steps: tuple[Step, ...]
    is_sheet: bool = False  # Whether it is a lab sheet, which ends with a measurement of one's own


@dataclass(frozen=True, slots=True)
class CheckedAnswer:
    """A student's answer to a step, checked."""

    text: str
    # Whether it is right, near, wrong, or no number; None where the answer is in words
    outcome: Outcome | None
    sentence: str


@dataclass(frozen=True, slots=True)
class LessonList:
    """The lessons that were found."""

    # Those that come with the program, then those of the user's own folder
    lessons: tuple[Lesson, ...]
    # Why files of the user's own folder are no lessons: sentences by the file's name
    problems: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class AnsweredStep:
    """A step with a student's answer to it."""

    step: Step
    answer: CheckedAnswer | None
    # The scene at which it was given and checked, which the report draws; that of the question
    # where there is no answer
    scene: Scene
    # The match of the photo that was open, where the step is about one; the report draws it
    match: Match | None = None
    photo: str = ""
