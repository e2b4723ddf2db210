"""What a fuzz target is: any input gives a result that keeps its laws, or documented sentences."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import TypeAlias

from occ_model.errors import OccError

LONGEST_SENTENCE = 1500
"""Characters of a sentence; one that lists the known names of something has about a thousand."""

Case: TypeAlias = Callable[[Random, Path], Sequence[str]]
"""Tries one input in an empty folder; returns the sentences given in place of a result.

It raises AssertionError if a law does not hold. Every undocumented exception is a failure, too.
"""


@dataclass(frozen=True, slots=True)
class FuzzTarget:
    """A part of the program that takes input from outside.

    Parameters
    ----------
    name
        Its name on the command line of ``program.py``.
    what
        The inputs, in a few words.
    case
        Tries one random input.
    refusals
        The documented exceptions.
    fraction
        How many of about a thousand cases are for this target.
    patience
        Largest processor time of a case in seconds.
    memory
        Largest memory of the process in megabytes.
    """

    name: str
    what: str
    case: Case
    refusals: tuple[type[OccError], ...]
    fraction: int
    patience: float = 3.0
    memory: int = 700


def run_case(target: FuzzTarget, seed: int, folder: Path) -> list[str]:
    """Try the input of a seed; return the sentences given in place of a result, none for a result.

    Raises
    ------
    AssertionError
        A law does not hold.
    """
    try:
        sentences = list(target.case(Random(seed), folder))
    except target.refusals as refusal:
        sentences = [str(refusal)]
    for sentence in sentences:
        check_sentence(sentence)
    return sentences


def check_sentence(text: str) -> None:
    """Check that a text is one printable line of limited length that ends as a sentence does."""
    assert text.isprintable(), f"not one printable line: {text!r}"
    assert 0 < len(text) <= LONGEST_SENTENCE, f"{len(text)} characters: {text[:400]!r}"
    assert text.endswith((".", "?", "!")), f"no whole sentence: {text!r}"
