"""Units: quantities as people write them, ``"10 kHz"``, ``"68us"``, ``"1/8000 s"``.

Everywhere else values are in SI units; only this module knows prefixes.
"""

import math
import re
from dataclasses import dataclass

_PREFIXES = {
    "n": 1e-9,
    "u": 1e-6,
    "µ": 1e-6,  # micro sign
    "μ": 1e-6,
    "m": 1e-3,
    "c": 1e-2,
    "": 1.0,
    "k": 1e3,
    "M": 1e6,
    "G": 1e9,
}

_NUMBER = r"[+-]?(?:\d+(?:\.\d*|,\d+)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_QUANTITY = re.compile(rf"({_NUMBER})\s*(?:/\s*({_NUMBER}))?\s*(.*)", re.DOTALL)

_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}(?:[eE][+-]?\d+)?")
"""Numbers whose comma may separate thousands: one to three digits before it, three after."""

_MAX_DECIMALS = 6  # of an estimate; with more, its error is written in a unit of its own

_LARGEST_WITHOUT_EXPONENT = 1e6  # numbers from 1 to this one are written without an exponent

_ROUNDING_ERROR = 1e-12  # a relative error this small is only that of the arithmetic
LONGEST_TEXT = 200  # characters of a quantity's text; 17 digits and a unit need far fewer


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measure, and how its values are displayed."""

    symbol: str  # The SI unit, empty for a pure number
    prefixes: tuple[str, ...] = ("",)
    # Smallest value displayed without a prefix
    smallest_without_prefix: float = 1.0
    # Other accepted spellings, each with its value in the SI unit
    spellings: tuple[tuple[str, float], ...] = ()
    # Symbol of a unit that is displayed in place of the SI unit, and its value in the SI unit
    shown: tuple[str, float] | None = None

    def factor(self, text: str) -> float | None:
        """Return the SI value of a unit written as ``text``, None if it is unknown."""
        known = dict(self.spellings)
        if self.shown is not None:
            known[self.shown[0]] = self.shown[1]
        if text in known:
            return known[text]
        if not self.symbol:
            return None
        if text == self.symbol:
            return 1.0
        stem = text.removesuffix(self.symbol)
        # "10k" means ten kilohertz; the "m" of "5m" was matched as metre above.
        return _PREFIXES.get(stem) if stem else None

    def parse(self, text: str, default_factor: float = 1.0) -> float | None:
        """Parse a number or fraction; None if unclear.

        A number without a unit is multiplied by ``default_factor``.
        """
        meanings = self.meanings(text, default_factor)
        return meanings[0] if len(meanings) == 1 else None

    def meanings(self, text: str, default_factor: float = 1.0) -> tuple[float, ...]:
        """Return the SI values that a text can mean: none, one or two.

        A comma is first read as a decimal comma; the comma in ``1,000 Hz`` may also separate
        thousands.
        """
        # Stripped first, since a match among n trailing spaces takes a time in proportion to n^2.
        match = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST_TEXT else None
        if match is None:
            return ()
        number, divisor, unit = match.groups()
        factor = default_factor if not unit else self.factor(unit)
        if factor is None:
            return ()
        parts = (number, divisor or "1")
        points = [part.replace(",", ".") for part in parts]
        texts = [points]
        if any(_THOUSANDS.fullmatch(part) for part in parts):
            texts.append(
                [part.replace(",", "" if _THOUSANDS.fullmatch(part) else ".") for part in parts]
            )
        values = [(float(above), float(below)) for above, below in texts]
        return tuple(_scale(above / below, factor) for above, below in values if below != 0.0)

    def display(self, value: float) -> tuple[str, float]:
        """Choose the unit in which to display ``value``; return its symbol and its SI value."""
        if self.shown is not None:
            # A value that would be infinite in that unit is displayed in the SI unit.
            is_too_large = math.isfinite(value) and math.isinf(value / self.shown[1])
            return (self.symbol, 1.0) if is_too_large else self.shown
        size = abs(value)
        chosen = ""
        for prefix in self.prefixes:
            start = self.smallest_without_prefix if prefix == "" else _PREFIXES[prefix]
            if prefix == self.prefixes[0] or size >= start * (1 - 1e-12):
                chosen = prefix
        if size == 0.0 or math.isnan(size):
            chosen = ""
        return chosen + self.symbol, _PREFIXES[chosen]

    def format_estimate(self, value: float, deviation: float | None) -> str:
        """Format a value with its standard deviation, both to significant digits."""
        if deviation is None or not _ROUNDING_ERROR * abs(value) < deviation < math.inf:
            return self.format(value)
        symbol, factor = self.display(max(abs(value), deviation))
        decimals = _count_decimals(deviation / factor)
        if decimals > _MAX_DECIMALS:
            whole = math.floor(math.log10(abs(value / factor))) + 1 if value else 0
            number = f"{value / factor:.{max(whole + decimals, 1)}g} {symbol}".rstrip()
            return f"{number} ± {self.format_deviation(deviation)}"
        number = _format_rounded(value / factor, decimals)
        return f"{number} ± {_format_rounded(deviation / factor, decimals)} {symbol}".rstrip()

    def format_deviation(self, deviation: float) -> str:
        """Format a standard deviation by itself, to two digits and in the unit that suits it."""
        symbol, factor = self.display(deviation)
        number = deviation / factor
        decimals = _count_decimals(number)
        text = _format_rounded(number, decimals) if decimals <= _MAX_DECIMALS else f"{number:.1e}"
        return f"{text} {symbol}".rstrip()

    def round_estimate(self, value: float, deviation: float | None) -> float:
        """Round a value to a tenth of its deviation or finer, as in :meth:`format_estimate`."""
        if deviation is None or not _ROUNDING_ERROR * abs(value) < deviation < math.inf:
            return value
        _, factor = self.display(value)
        return _scale(round(value / factor, max(_count_decimals(deviation / factor), 0)), factor)

    def format(self, value: float, digits: int = 6) -> str:
        """Format ``value`` with ``digits`` significant digits and its unit."""
        symbol, factor = self.display(value)
        number = f"{value / factor:.{digits}g}" if math.isfinite(value) else str(value)
        if "e" in number and 1.0 <= abs(float(number)) < _LARGEST_WITHOUT_EXPONENT:
            number = f"{float(number):.0f}"
        if not symbol:
            return number
        return f"{number}{symbol}" if symbol == "°" else f"{number} {symbol}"


def _count_decimals(deviation: float) -> int:
    """Return the decimals for two digits of a standard deviation; negative for hundreds."""
    return 1 - math.floor(math.log10(float(f"{deviation:.1e}")))


def _format_rounded(value: float, decimals: int) -> str:
    """Format a value with some decimals; a negative number rounds before the decimal point."""
    return f"{round(value, decimals):z.{max(decimals, 0)}f}"


def _scale(value: float, factor: float) -> float:
    """Multiply, or divide where that is exact: 68 us is 68 / 1e6, not 68 * 1e-6."""
    if 0.0 < factor < 1.0 and round(1.0 / factor) * factor == 1.0:
        return value / round(1.0 / factor)
    return value * factor


NONE = Unit("")
SECOND = Unit("s", ("n", "µ", "m", ""), spellings=(("sec", 1.0),))
HERTZ = Unit("Hz", ("", "k", "M", "G"))
METRE = Unit("m", ("n", "µ", "m", "", "k"), smallest_without_prefix=0.1)
RADIAN = Unit("rad", shown=("°", math.pi / 180), spellings=(("deg", math.pi / 180),))
LUX = Unit("lx")
NIT = Unit("cd/m²", spellings=(("cd/m2", 1.0), ("nit", 1.0), ("nits", 1.0)))
PIXEL = Unit("px", spellings=(("pixel", 1.0), ("pixels", 1.0)))
LEVEL = Unit("levels")
PPM = Unit("", shown=("ppm", 1e-6))
PERCENT = Unit("", shown=("%", 1e-2))
ELECTRON = Unit("e⁻", spellings=(("e", 1.0), ("e-", 1.0), ("electrons", 1.0)))
