"""Hostile numbers and texts, and ways to damage a text that was right."""

import re
from collections.abc import Callable
from random import Random

NUMBERS = (
    "0", "-0", "1", "-1", "2", "0.5", "1e-320", "1e308", "-1e308", "1e309", "5e-324", "nan", "NaN",
    "-nan", "inf", "-inf", "Infinity", "0x10", "0b101", "0o7", "007", "1_000", "١٢", "½", "²",
    "1,5", "1,000", "12,345", "1.000,5", "1e", "e5", ".", ",", "+", "-", "--1", "+-1", "1/0",
    "0/0", "1/3", "1e999/1e999", "9" * 19, "9" * 300, "9" * 4300, "9" * 5000,
    "0." + "0" * 330 + "1",
    "1e999999999",    "1e-999999999", " 7 ", "7\t", "1 000", "1\u202f000", "true", "None", "2**64",
    "18446744073709551616", "-9223372036854775809", "4294967296", "2147483648", "65536", "0.1e1",
    "1E3", "\u0663.\u0665", "1.", ".5", "1e+5", "1j",
)  # fmt: skip
"""Numbers that programs stumble over, and what looks like a number.

Of 4,300 digits Python reads a number, but writes none that is one larger.
"""

UNITS = (
    "", "", "s", "ms", "us", "µs", "μs", "ns", "Hz", "kHz", "MHz", "GHz", "m", "cm", "mm", "km",
    "°", "deg", "rad", "lx", "cd/m²", "cd/m2", "px", "ppm", "%", "levels", "e-", "e⁻", "k", "kk",
    "KHz", "hz", "sec", "parsec", " ms ", "m s", "\u200bs", "s\0", "Ω", "µ", "/", "s/s",
)  # fmt: skip

PIECES = (
    "\0", "\n", "\r\n", "\r", "\t", "\x0b", "\x1b[31m", "\x07", "\x7f", "\x85", "\u202e", "\u2028",
    "\u2029", "\ufeff", "\u200b", "\ud800", "\udcff", "😀", "ﬀ", "é", "e\u0301", "\U000e0001",
    "", " ", "'", '"', "'''", '"""', "\\", "\\u0000", "\\ud800", "\\x", "%s", "%(prog)s", "{}",
    "{0}", "../..", "/", "//", "=", "==", ":", "::", ",", ";", "#", "-", "--", "[", "]]", "[[", "{",
    "}", "(", ")", "$(x)", "<b>", "</", "&amp;", "&#0;", "&#xd800;", "&#" + "9" * 5000 + ";", "nul",
    "a" * 300, "A" * 10_000, "e\u0301" * 200, "\u0301" * 50, "..", ".", "~", "*", "|", "`",
)  # fmt: skip
"""Texts that mean something to a parser, a terminal, or the letters' own tables."""

_NUMBER = re.compile(r"-?\d[\d.]*(?:[eE][+-]?\d+)?")
_STRING = re.compile(r'"[^"\n]*"')
_WORD = re.compile(r"[A-Za-z_]{3,}")


def number(chance: Random) -> str:
    """A number, or what looks like one."""
    kind = chance.randrange(4)
    if kind == 0:
        return (
            f"{chance.choice((1, -1)) * 10.0 ** chance.uniform(-30, 30):.{chance.randint(1, 17)}g}"
        )
    if kind == 1:
        return str(chance.randint(-(10 ** chance.randint(0, 25)), 10 ** chance.randint(0, 25)))
    return chance.choice(NUMBERS)


def quantity(chance: Random) -> str:
    """A number with a unit, as somebody or something may type it."""
    text = number(chance)
    if chance.random() < 0.15:
        text += f"/{number(chance)}"
    text += chance.choice(("", "", " ", "  ")) + chance.choice(UNITS)
    return spoiled(chance, text) if chance.random() < 0.1 else text


def word(chance: Random) -> str:
    """Any text of a few pieces."""
    letters = "".join(chr(chance.choice((chance.randrange(32, 127), chance.randrange(0x3000))))
                      for _ in range(chance.randrange(6)))  # fmt: skip
    return "".join((*chance.choices(PIECES, k=chance.randrange(3)), letters))


def spoiled(chance: Random, text: str) -> str:
    """A text with a piece put in, taken out, or repeated."""
    place = chance.randint(0, len(text))
    kind = chance.randrange(3)
    if kind == 0:
        return text[:place] + chance.choice(PIECES) + text[place:]
    length = chance.randint(1, 4)
    if kind == 1:
        return text[:place] + text[place + length :]
    return text[:place] + text[place : place + length] * chance.choice((2, 3, 200)) + text[place:]


def value(chance: Random) -> object:
    """Any value of Python that may stand for a number or a text."""
    huge: tuple[object, ...] = (
        None, True, False, "", (), [], {}, [1.0], {"a": 1}, b"1", 10**400, -(10**400), 1j, float,
        float("nan"), float("inf"), -0.0, 5e-324, 1.7e308, object(), [[]], set(), range(3),
    )  # fmt: skip
    kind = chance.randrange(4)
    if kind == 0:
        return chance.choice(huge)
    if kind == 1:
        return quantity(chance)
    if kind == 2:
        return word(chance)
    return chance.choice((1, -1)) * 10.0 ** chance.uniform(-320, 308)


def damaged(chance: Random, text: str) -> str:
    """A text that was right, changed in one to three ways."""
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        text = chance.choice(WAYS)(chance, text)
    return text


def encoded(chance: Random, text: str) -> bytes:
    """A text as the bytes of a file, which need not be UTF-8."""
    content = text.encode("utf-8", "surrogatepass")
    kind = chance.randrange(12)
    if kind == 0:
        return text.encode("utf-16", "surrogatepass")
    if kind == 1:
        return b"\xef\xbb\xbf" + content
    if kind == 2:
        place = chance.randint(0, len(content))
        return content[:place] + chance.randbytes(chance.randint(1, 8)) + content[place:]
    if kind == 3:
        return content.replace(b"\n", chance.choice((b"\r\n", b"\r", b"\0", b"\n\n")))
    return content


def _other_number(chance: Random, text: str) -> str:
    return _replaced(chance, text, _NUMBER, number(chance))


def _other_string(chance: Random, text: str) -> str:
    inside = word(chance) if chance.random() < 0.7 else quantity(chance)
    return _replaced(chance, text, _STRING, f'"{inside}"')


def _other_kind(chance: Random, text: str) -> str:
    pattern = chance.choice((_NUMBER, _STRING))
    others = ("[]", "{}", "[1, 2]", "true", "1979-05-27T07:32:00Z", '"x"', "{a = 1}", "[[[]]]",
              "''", "[[1], 'a']", "07:32:00", "null", "{'a': [1]}", '{"a": 1}')  # fmt: skip
    return _replaced(chance, text, pattern, chance.choice(others))


def _other_word(chance: Random, text: str) -> str:
    found = _WORD.findall(text)
    if not found:
        return text + word(chance)
    other = chance.choice(found) if chance.random() < 0.6 else word(chance)
    return _replaced(chance, text, _WORD, other)


def _replaced(chance: Random, text: str, pattern: re.Pattern[str], other: str) -> str:
    """Put another text in place of one that fits a pattern."""
    found = list(pattern.finditer(text))
    if not found:
        return text + other
    match = chance.choice(found)
    return text[: match.start()] + other + text[match.end() :]


def _spoiled_line(chance: Random, text: str) -> str:
    lines = text.splitlines(keepends=True) or [""]
    place = chance.randrange(len(lines))
    lines[place] = spoiled(chance, lines[place])
    return "".join(lines)


def _moved_lines(chance: Random, text: str) -> str:
    lines = text.splitlines(keepends=True) or [""]
    place, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    kind = chance.randrange(4)
    if kind == 0:
        del lines[place]
    elif kind == 1:
        lines.insert(other, lines[place])
    elif kind == 2:
        lines[place], lines[other] = lines[other], lines[place]
    else:
        lines[place:place] = lines[place : place + 1] * chance.choice((2, 50, 1000))
    return "".join(lines)


def _cut(chance: Random, text: str) -> str:
    place = chance.randint(0, len(text))
    return text[:place] if chance.random() < 0.7 else text[place:]


def _put_in(chance: Random, text: str) -> str:
    place = chance.randint(0, len(text))
    piece = chance.choice((word(chance), quantity(chance), chance.choice(PIECES) * 50))
    return text[:place] + piece + text[place:]


def _nested(chance: Random, text: str) -> str:
    depth = chance.choice((20, 200, 3000))
    opening, closing = chance.choice((("[", "]"), ("{a=", "}"), ("(", ")"), ('{"a":', "}")))
    return _replaced(chance, text, _NUMBER, opening * depth + "1" + closing * depth)


def _joined(chance: Random, text: str) -> str:
    """Two halves that overlap or leave something out."""
    first, second = chance.randint(0, len(text)), chance.randint(0, len(text))
    return text[:first] + text[second:]


WAYS: tuple[Callable[[Random, str], str], ...] = (
    _other_number, _other_number, _other_string, _other_kind, _other_word, _spoiled_line,
    _moved_lines, _cut, _put_in, _nested, _joined,
)  # fmt: skip
"""Ways to damage a text of numbers, strings, words and lines."""
