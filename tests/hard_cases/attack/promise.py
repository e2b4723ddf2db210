"""What any input may end in: a result that keeps its laws, or documented sentences."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import TypeAlias

from occ_model.errors import OccError

LONGEST = 1500
"""Characters of a sentence; one that lists the known names of something has about a thousand."""

Case: TypeAlias = Callable[[Random, Path], Sequence[str]]
"""Tries one input in an empty folder, and gives the sentences that came instead of a result.

What breaks a law is an ``AssertionError``, and any exception but a documented one is a break too.
"""


@dataclass(frozen=True, slots=True)
class Door:
    """A way by which input comes into the program.

    Parameters
    ----------
    name
        A word.
    what
        What comes in, in a few words.
    case
        Tries one input.
    refusals
        The exceptions that are documented for it.
    share
        How many of a thousand cases are of this door.
    patience
        Seconds of processor time that a case may take.
    memory
        Megabytes that the process which tries the cases may take in all.
    """

    name: str
    what: str
    case: Case
    refusals: tuple[type[OccError], ...]
    fraction: int
    patience: float = 3.0
    memory: int = 700


def sentences_of(door: Door, seed: int, folder: Path) -> list[str]:
    """Try the input of a seed; give the sentences that came instead of a result, none for one.

    Raises
    ------
    AssertionError
        The promise is broken.
    """
    try:
        sentences = list(door.case(Random(seed), folder))
    except door.refusals as refusal:
        sentences = [str(refusal)]
    for sentence in sentences:
        check_sentence(sentence)
    return sentences


def check_sentence(text: str) -> None:
    """See that a text is one printable line of a bounded length that ends as a sentence does."""
    assert text.isprintable(), f"not one printable line: {text!r}"
    assert 0 < len(text) <= LONGEST, f"{len(text)} characters: {text[:400]!r}"
    assert text.endswith((".", "?", "!")), f"no whole sentence: {text!r}"
