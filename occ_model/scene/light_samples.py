"""Lights written as text: a line of levels, and the rows of a CSV file of seconds and levels."""

import math
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from occ_model.files.reading import read_text

MOST_LEVELS = 4096
MOST_SAMPLES = 16_384  # so that a scene with all of them is within what files are searched for
_LARGEST_FILE = 4_000_000  # bytes

LEVELS = f"up to {MOST_LEVELS} numbers from 0 to 1, or such as 0 1 2 3 / 3"
SAMPLES = (
    f"nothing, or a CSV file of up to {MOST_SAMPLES} rows: rising seconds, a level from 0 to 1"
)

_SEPARATORS = str.maketrans(",;\t", "   ")


def canonical_levels(text: str) -> str:
    """Return a line of levels in its shortest form; ValueError with the problem."""
    line, slash, divisor = (part.strip() for part in text.partition("/"))
    numbers = line.split()
    if not numbers:
        raise ValueError("has no levels")
    if len(numbers) > MOST_LEVELS:
        raise ValueError(f"has {len(numbers)} levels")
    values = [_number(each) for each in (*numbers, *([divisor] if slash else []))]
    by = values.pop() if slash else Fraction(1)
    if by <= 0:
        raise ValueError(f"is divided by {divisor}")
    for number, value in zip(numbers, values, strict=True):
        if not 0 <= value / by <= 1:
            raise ValueError(f"has the level {number}{f' / {divisor}' if slash else ''}")
    return f"{' '.join(numbers)}{f' / {divisor}' if slash else ''}"


def levels_of(text: str) -> list[float]:
    """Return the levels of a canonical line, from 0 to 1."""
    line, _, divisor = text.partition("/")
    by = Fraction(divisor.strip() or 1)
    return [float(Fraction(number) / by) for number in line.split()]


def _number(text: str) -> Fraction:
    # Fraction reads "1/3" and "1_0" as well, and exponents of any size without end.
    if len(text) > 40 or "_" in text or not math.isfinite(_as_float(text)):
        raise ValueError(f"has {text[:40]!r}, which is not a number")
    return Fraction(text)


def _as_float(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def canonical_file(text: str) -> str:
    """Return the canonical rows of a CSV file, given as path or rows; an empty text stays empty.

    A scene keeps the rows, so that it stays the same when the file changes or is gone.
    """
    if not text.strip():
        return ""
    return canonical_samples(text) if "\n" in text else read_samples(Path(text))


def read_samples(path: Path) -> str:
    """Read a CSV file as the canonical text of a waveform; ValueError with the problem."""
    return canonical_samples(read_text(path, _LARGEST_FILE))


def canonical_samples(text: str) -> str:
    """Return rows of seconds and levels in one form; ValueError with the problem.

    A level lasts until the next row's time. The last one lasts as long as the one before it, unless
    a final row with only a time ends it. Words above the first row are column names.
    """
    rows = [line.translate(_SEPARATORS).split() for line in text.splitlines()]
    rows = [row for row in rows if row and not row[0].startswith("#")]
    if rows and math.isnan(_as_float(rows[0][0])):
        del rows[0]
    if len(rows) > MOST_SAMPLES + 1:
        raise ValueError(f"has {len(rows):,} rows")
    seconds: list[float] = []
    levels: list[float] = []
    for number, row in enumerate(rows, 1):
        values = [_as_float(each) for each in row]
        is_end = len(values) == 1 and number == len(rows) > 1
        if not (is_end or len(values) == 2) or not all(map(math.isfinite, values)):
            raise ValueError(f"has {' '.join(row)[:40]!r} in row {number}")
        if seconds and not values[0] > seconds[-1]:
            raise ValueError(f"has {values[0]:g} s in row {number}, after {seconds[-1]:g} s")
        seconds.append(values[0])
        if not is_end:
            if not 0.0 <= values[1] <= 1.0:
                raise ValueError(f"has the level {values[1]:g} in row {number}")
            levels.append(values[1])
    if len(levels) == len(seconds):
        if len(levels) < 2:
            raise ValueError(f"has {len(levels)} rows and no end")
        seconds.append(seconds[-1] + (seconds[-1] - seconds[-2]))
    first = seconds[0]
    return text_of_samples([second - first for second in seconds], levels)


def text_of_samples(seconds: Sequence[float], levels: Sequence[float]) -> str:
    """Write the times of edges, from 0 to the period, and levels as a canonical text."""
    rows = (f"{second!r},{level!r}\n" for second, level in zip(seconds, levels, strict=False))
    return "".join(rows) + f"{seconds[-1]!r}\n"


def samples_of(text: str) -> tuple[list[float], list[float]]:
    """Return the times of a canonical text's edges, from 0 to the period, and its levels."""
    *rows, end = text.split("\n")[:-1]
    pairs = [row.split(",") for row in rows]
    return (
        [*(float(second) for second, _ in pairs), float(end)],
        [float(level) for _, level in pairs],
    )
