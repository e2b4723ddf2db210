"""Exceptions whose message is a sentence for the user, and functions that quote values in them."""

import reprlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

_LONGEST_VALUE = 80  # characters of a value that a sentence quotes
_LONGEST_NAME = 200  # characters of a name or title in a sentence or a label
_LONGEST_TEXT = 1_000_000  # characters of any text


class OccError(Exception):
    """Base of every error that this package raises on purpose.

    Parameters
    ----------
    *args
        The sentence.
    parameters
        Names of the scene's parameters that the sentence is about, if any.
    """

    def __init__(self, *args: object, parameters: Sequence[str] = ()) -> None:
        super().__init__(*args)
        self.parameters = tuple(parameters)


@dataclass(frozen=True, slots=True)
class RefusedValue:
    """A value that a parameter cannot have, with its unit, and what is allowed."""

    parameter: str
    verb: str
    value: str
    allowed: str
    condition: str = ""
    place: str = ""

    def sentence(self, name: str = "", verb: str = "") -> str:
        """Return the refusal as a sentence, with another name and verb if given."""
        begin = f"{self.place}: " if self.place else ""
        condition = f" {self.condition}" if self.condition else ""
        return (
            f"{begin}{name or self.parameter} {verb or self.verb} {self.value}; "
            f"allowed{condition}: {self.allowed}."
        )


class ParameterError(OccError, ValueError):
    """A parameter is unknown, not of its kind, or outside its allowed range.

    Attributes
    ----------
    refused : RefusedValue or None
        The parameter, its value and what is allowed; None if no single value is refused.
    """

    refused: RefusedValue | None = None

    @classmethod
    def of(
        cls,
        parameter: str,
        value: str,
        allowed: str,
        *,
        verb: str = "is",
        condition: str = "",
        parameters: Sequence[str] = (),
    ) -> Self:
        """Return the error of a value that is not allowed; see :class:`RefusedValue`."""
        refused = RefusedValue(parameter, verb, value, allowed, condition)
        error = cls(refused.sentence(), parameters=parameters)
        error.refused = refused
        return error

    def within(self, place: str) -> Self:
        """Return the same error, of a value at a place such as a table or a frame."""
        error = type(self)(f"{place}: {self}", parameters=self.parameters)
        if self.refused is not None:
            error.refused = replace(self.refused, place=place)
        return error


class SceneFileError(OccError, ValueError):
    """A file cannot be read as a scene, a preset or text."""


class PresetError(OccError, KeyError):
    """There is no preset of this name."""

    def __str__(self) -> str:
        # KeyError would print the sentence as a quoted key.
        return str(self.args[0]) if self.args else ""


class ProjectionError(OccError, ValueError):
    """The panel has no picture in this pose, or the picture would be too large."""


class BandModelUndefined(OccError, ValueError):  # noqa: N818 - the name is public and older
    """The band model is undefined for this scene."""


class DecodeInputError(OccError, ValueError):
    """The input of a decoder is no image or profile."""


class PhotoError(OccError):
    """A photo cannot be read."""


class VideoError(OccError):
    """A film cannot be read or made."""


class MatchError(OccError):
    """A photo's stripes cannot be found, or no scene explains them.

    Its arguments are the reasons, each a sentence; the message is all of them.
    """

    def __str__(self) -> str:
        return " ".join(self.reasons)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the match is refused, each a sentence."""
        return tuple(map(str, self.args))


class PluginError(OccError):
    """A plug-in cannot be imported, or violates its interface."""


class OutputError(OccError):
    """A result cannot be written to a file."""


class _ShortRepr(reprlib.Repr):
    """A ``repr`` that is short and never fails."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 3
        self.maxstring = self.maxother = self.maxlong = _LONGEST_VALUE

    def repr_int(self, value: int, level: int) -> str:
        """Format a whole number, even one with more digits than Python converts."""
        try:
            repr(value)  # the base class names an address instead from Python 3.14 on
        except ValueError:
            return f"a whole number of {value.bit_length():,} bits"
        return super().repr_int(value, level)


def quote(value: object) -> str:
    """Format any value for a sentence: as ``repr`` would, but short and in one line."""
    lines = _ShortRepr().repr(value).split("\n")  # an array's has several
    return one_line(" ".join(line.strip() for line in lines), _LONGEST_VALUE)


def make_printable(text: str) -> str:
    """Format a text of any length in one line, with control characters escaped."""
    return one_line(" ".join(text.split()), _LONGEST_TEXT)


def inflect(number: float, noun: str) -> str:
    """Write a number with its noun: 1 frame, 2 frames, 0.5 frames."""
    text = str(number) if isinstance(number, int) else f"{number:g}"
    return f"{text} {noun}{'s' * (text != '1')}"


def capitalize(text: str) -> str:
    """Begin a text with a capital; ``str.capitalize`` would also change the other letters."""
    return text[:1].upper() + text[1:]


def distinct_texts(value: float, limit: float, digits: int = 1) -> tuple[str, str]:
    """Format two numbers with ``digits`` decimals, or as many more as distinguish them."""
    texts = ((f"{value:.{count}f}", f"{limit:.{count}f}") for count in range(digits, 18))
    return next((pair for pair in texts if pair[0] != pair[1]), (str(value), str(limit)))


def one_line(text: str, longest: int = _LONGEST_NAME) -> str:
    """Format a name, title or path in one line, with control characters escaped."""
    start = text[: longest + 1]
    if len(start) > longest:
        start = f"{start[: longest - 1]}…"
    if start.isprintable():
        return start
    return "".join(
        letter if letter.isprintable() else letter.encode("unicode_escape").decode("ascii")
        for letter in start
    )
