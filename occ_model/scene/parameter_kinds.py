"""Kinds of parameter: quantities, counts, choices, patterns, payloads. Each checks its values.

Values are in SI units; their unit formats them (:mod:`occ_model.scene.units`).
"""

import math
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Literal, TypeAlias

from occ_model.errors import quote
from occ_model.plugins import plugin_names
from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.declaration import Declaration
from occ_model.scene.payload import PAYLOADS, canonical_payload, typed_form
from occ_model.scene.units import Unit

ParameterValue: TypeAlias = float | int | str

MAX_PATTERN_CHIPS = 4096


def _as_whole_number(value: object) -> int | None:
    """Convert a whole number of any numeric type to an int; None for anything else."""
    if isinstance(value, bool):
        return None
    if isinstance(value, Integral):
        return int(value)
    try:
        number = float(value) if isinstance(value, Real) else math.nan
    except OverflowError:  # a fraction too large for a float is too large for any parameter
        return None
    return int(number) if number.is_integer() else None


def _parse_whole_number(text: str) -> int:
    """Parse a whole number in any of Python's notations, also with leading zeros."""
    try:
        return int(text, 0)
    except ValueError:
        return int(text, 10)


_LIMIT_DIGITS = 12  # digits of a limit that are written without an exponent


@dataclass(frozen=True, slots=True)
class Quantity(Declaration):
    """A real number with a unit, from ``low`` to ``high``; its slider covers part of the range."""

    unit: Unit
    low: float
    high: float
    slider: tuple[float, float]
    scale: Literal["linear", "log"]
    default: float

    @property
    def allowed(self) -> str:
        if self.high == math.inf:
            return f"from {self._format_limit(self.low)}"
        return f"{self._format_limit(self.low)} to {self._format_limit(self.high)}"

    def _format_limit(self, value: float) -> str:
        """Format a limit in full, 1000000 s and not 1e+06 s, unless it has too many digits."""
        return self.unit.format(value, digits=_LIMIT_DIGITS)

    def check(self, value: object) -> float:
        if type(value) is float:  # the usual case, checked faster
            number = value
        elif isinstance(value, bool) or not isinstance(value, Real):
            raise self.refuse(f"is {quote(value)}, which is not a number", self.allowed)
        else:
            try:
                number = float(value)
            except OverflowError:
                number = -math.inf if value < 0 else math.inf
        if not self.low <= number <= self.high:
            raise self.refuse(f"is {self._format_refused(number)}", self.allowed)
        return number

    def _format_refused(self, number: float) -> str:
        """Format a refused value with enough digits to look different from every allowed one."""
        text = self.unit.format(number)
        read = self.unit.parse(text)  # 0.999999999 mm is formatted as 1000 µm
        is_rounded_in = read is not None and self.low <= read <= self.high
        return self.unit.format(number, digits=17) if is_rounded_in else text

    def parse(self, text: str, shown_factor: float | None = None) -> float:
        """Parse a value as people write it.

        A number without a unit is in SI units, or in the unit of a field that shows another one,
        whose SI value is ``shown_factor``. It is refused if it is off the slider in this unit but
        on the slider in the other one: 20000 for a frequency shown in kHz hardly means 20 MHz, and
        136 for an exposure time hardly means 136 s.
        """
        self.check_length(text, self.allowed)
        meanings = self.unit.meanings(text, 1.0 if shown_factor is None else shown_factor)
        if len(meanings) > 1:
            comma, thousands = (self.unit.format(value) for value in meanings)
            raise self.refuse(
                f"is {quote(text)}, which means {comma} with a decimal comma and {thousands} with "
                "a comma between thousands",
                f"{self.allowed}, written without that comma",
            )
        if not meanings:
            unit = f" in {self.unit.display(self.default)[0]}" if self.unit.symbol else ""
            raise self.refuse(f"is {quote(text)}, which is not a number{unit}", self.allowed)
        value = self.check(meanings[0])
        usual = self.unit.display(self.default)
        other = self.unit.parse(text, usual[1] if shown_factor is None else 1.0)
        if (
            other not in (value, None)
            and self._is_on_slider(other)
            and not self._is_on_slider(value)
        ):
            found = (self.unit.format(value), self.unit.format(other))
            both = (
                f"is {found[0]} and may be meant as {found[1]}"
                if shown_factor is None
                else f"means {found[0]} in the unit shown and {found[1]} in {self.unit.symbol}"
            )
            raise self.refuse(
                f"is {quote(text)} without a unit, which {both}",
                f"{self.allowed}, written with its unit",
            )
        return value

    def _is_on_slider(self, value: float) -> bool:
        low, high = self.slider
        return low <= value <= high

    def format(self, value: float, digits: int = 6) -> str:
        return self.unit.format(value, digits)

    def at(self, fraction: float) -> float:
        """Return the value at a slider's position from 0 to 1, to four significant digits."""
        low, high = self.slider
        if self.scale == "log":
            value = low * (high / low) ** fraction
        else:
            value = low + (high - low) * fraction
        # Rounded by way of its text, so that typing the displayed text gives the same value.
        rounded = self.unit.parse(self.unit.format(value, digits=4))
        return min(max(value if rounded is None else rounded, low), high)

    def fraction(self, value: float) -> float:
        """Return a slider's position from 0 to 1 for a value; values off it are at its ends."""
        low, high = self.slider
        value = min(max(value, low), high)
        if self.scale == "log":
            return math.log(value / low) / math.log(high / low)
        return (value - low) / (high - low)


@dataclass(frozen=True, slots=True)
class Count(Declaration):
    low: int
    high: int
    default: int

    @property
    def allowed(self) -> str:
        return f"a whole number from {self.low} to {self.high}"

    def check(self, value: object) -> int:
        number = _as_whole_number(value)
        if number is None:
            raise self.refuse(f"is {quote(value)}", self.allowed)
        if not self.low <= number <= self.high:
            raise self.refuse(f"is {quote(number)}", self.allowed)
        return number

    def parse(self, text: str) -> int:
        """Parse a whole number, also as ``0b...``, ``0x...`` or ``007``."""
        self.check_length(text, self.allowed)
        try:
            number = _parse_whole_number(text)
        except ValueError:
            raise self.refuse(f"is {quote(text)}", self.allowed) from None
        return self.check(number)


@dataclass(frozen=True, slots=True)
class Choice(Declaration):
    """One of a few words."""

    choices: tuple[str, ...]
    default: str

    @property
    def allowed(self) -> str:
        return ", ".join(self.choices)

    def check(self, value: object) -> str:
        if not isinstance(value, str) or value not in self.choices:
            raise self.refuse(f"is {quote(value)}", self.allowed)
        return value

    def parse(self, text: str) -> str:
        return self.check(text.strip())


@dataclass(frozen=True, slots=True)
class OpenChoice(Choice):
    """One of a few words, or the name of a plug-in with the entry point ``group``."""

    group: str

    @property
    def allowed(self) -> str:
        return f"{', '.join(self.choices)}, or a plug-in's name"

    def all_choices(self) -> tuple[str, ...]:
        """Return the built-in words and the names of the installed plug-ins."""
        return tuple(dict.fromkeys((*self.choices, *plugin_names(self.group))))

    def check(self, value: object) -> str:
        if isinstance(value, str) and (value in self.choices or value in self.all_choices()):
            return value
        raise self.refuse(f"is {quote(value)}", ", ".join(self.all_choices()))


@dataclass(frozen=True, slots=True)
class Payload(Declaration):
    """What is sent: a text, bytes, bits or nothing."""

    default: str
    empty: str = "the code"  # what is sent without a payload

    @property
    def allowed(self) -> str:
        return f"nothing, or {PAYLOADS}"

    def check(self, value: object) -> str:
        try:
            return canonical_payload(value)
        except ValueError as problem:
            raise self.refuse(str(problem), self.allowed) from None

    def parse(self, text: str) -> str:
        return self.check(text)

    def format(self, value: str) -> str:
        return typed_form(value)


@dataclass(frozen=True, slots=True)
class ChipPattern(Declaration):
    """A string of 0 and 1, or nothing."""

    default: str
    most: int = MAX_PATTERN_CHIPS
    empty: str = "packets"  # what is sent without a pattern

    @property
    def allowed(self) -> str:
        return f"nothing, or up to {self.most} characters 0 and 1"

    def check(self, value: object) -> str:
        if not isinstance(value, str) or set(value) - {"0", "1"}:
            raise self.refuse(f"is {quote(value)}", self.allowed)
        if len(value) > self.most:
            raise self.refuse(f"has {len(value)} chips", self.allowed)
        return value

    def parse(self, text: str) -> str:
        """Parse a pattern, ignoring spaces between chips."""
        return self.check("".join(text.split()))


Parameter: TypeAlias = Quantity | Count | Choice | ChipPattern | Payload | CanonicalText

_ALL_DIGITS = 17


def format_distinctly(
    declared: Parameter, one: ParameterValue, other: ParameterValue
) -> tuple[str, str]:
    """Format two values with enough digits to distinguish them."""
    if isinstance(declared, Quantity):
        a, b = float(one), float(other)
        texts = declared.format(a), declared.format(b)
        if texts[0] != texts[1]:
            return texts
        return declared.format(a, _ALL_DIGITS), declared.format(b, _ALL_DIGITS)
    return str(one), str(other)
