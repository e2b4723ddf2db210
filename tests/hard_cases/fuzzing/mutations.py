"""Random numbers and texts that are hard to parse, and mutations of valid texts."""

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
"""Numbers that are hard to parse, and texts that look like numbers.

Python reads a number of 4,300 digits, but does not write one that is larger by 1.
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
"""Texts with a special meaning for a parser, a terminal or Unicode."""

_NUMBER = re.compile(r"-?\d[\d.]*(?:[eE][+-]?\d+)?")
_STRING = re.compile(r'"[^"\n]*"')
_WORD = re.compile(r"[A-Za-z_]{3,}")


def random_number(random: Random) -> str:
    """Return a number, or a text that looks like one."""
    kind = random.randrange(4)
    if kind == 0:
        return (
            f"{random.choice((1, -1)) * 10.0 ** random.uniform(-30, 30):.{random.randint(1, 17)}g}"
        )
    if kind == 1:
        return str(random.randint(-(10 ** random.randint(0, 25)), 10 ** random.randint(0, 25)))
    return random.choice(NUMBERS)


def random_quantity(random: Random) -> str:
    """Return a number with a unit, often a wrong one."""
    text = random_number(random)
    if random.random() < 0.15:
        text += f"/{random_number(random)}"
    text += random.choice(("", "", " ", "  ")) + random.choice(UNITS)
    return mutate_once(random, text) if random.random() < 0.1 else text


def random_text(random: Random) -> str:
    """Return a text of a few random pieces and letters."""
    letters = "".join(chr(random.choice((random.randrange(32, 127), random.randrange(0x3000))))
                      for _ in range(random.randrange(6)))  # fmt: skip
    return "".join((*random.choices(PIECES, k=random.randrange(3)), letters))


def mutate_once(random: Random, text: str) -> str:
    """Insert a piece into a text, remove a part of it, or repeat one."""
    place = random.randint(0, len(text))
    kind = random.randrange(3)
    if kind == 0:
        return text[:place] + random.choice(PIECES) + text[place:]
    length = random.randint(1, 4)
    if kind == 1:
        return text[:place] + text[place + length :]
    return text[:place] + text[place : place + length] * random.choice((2, 3, 200)) + text[place:]


def random_value(random: Random) -> object:
    """Return any value of Python in place of a number or a text."""
    huge: tuple[object, ...] = (
        None, True, False, "", (), [], {}, [1.0], {"a": 1}, b"1", 10**400, -(10**400), 1j, float,
        float("nan"), float("inf"), -0.0, 5e-324, 1.7e308, object(), [[]], set(), range(3),
    )  # fmt: skip
    kind = random.randrange(4)
    if kind == 0:
        return random.choice(huge)
    if kind == 1:
        return random_quantity(random)
    if kind == 2:
        return random_text(random)
    return random.choice((1, -1)) * 10.0 ** random.uniform(-320, 308)


def mutate_text(random: Random, text: str) -> str:
    """Apply one to three mutations to a text."""
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        text = random.choice(MUTATIONS)(random, text)
    return text


def encode_text(random: Random, text: str) -> bytes:
    """Return a text as the bytes of a file, which need not be valid UTF-8."""
    content = text.encode("utf-8", "surrogatepass")
    kind = random.randrange(12)
    if kind == 0:
        return text.encode("utf-16", "surrogatepass")
    if kind == 1:
        return b"\xef\xbb\xbf" + content
    if kind == 2:
        place = random.randint(0, len(content))
        return content[:place] + random.randbytes(random.randint(1, 8)) + content[place:]
    if kind == 3:
        return content.replace(b"\n", random.choice((b"\r\n", b"\r", b"\0", b"\n\n")))
    return content


def _replace_number(random: Random, text: str) -> str:
    return _replace_match(random, text, _NUMBER, random_number(random))


def _replace_string(random: Random, text: str) -> str:
    inside = random_text(random) if random.random() < 0.7 else random_quantity(random)
    return _replace_match(random, text, _STRING, f'"{inside}"')


def _replace_type(random: Random, text: str) -> str:
    pattern = random.choice((_NUMBER, _STRING))
    others = ("[]", "{}", "[1, 2]", "true", "1979-05-27T07:32:00Z", '"x"', "{a = 1}", "[[[]]]",
              "''", "[[1], 'a']", "07:32:00", "null", "{'a': [1]}", '{"a": 1}')  # fmt: skip
    return _replace_match(random, text, pattern, random.choice(others))


def _replace_word(random: Random, text: str) -> str:
    found = _WORD.findall(text)
    if not found:
        return text + random_text(random)
    other = random.choice(found) if random.random() < 0.6 else random_text(random)
    return _replace_match(random, text, _WORD, other)


def _replace_match(random: Random, text: str, pattern: re.Pattern[str], other: str) -> str:
    """Replace one of the texts that match a pattern."""
    found = list(pattern.finditer(text))
    if not found:
        return text + other
    match = random.choice(found)
    return text[: match.start()] + other + text[match.end() :]


def _mutate_line(random: Random, text: str) -> str:
    lines = text.splitlines(keepends=True) or [""]
    place = random.randrange(len(lines))
    lines[place] = mutate_once(random, lines[place])
    return "".join(lines)


def _move_lines(random: Random, text: str) -> str:
    lines = text.splitlines(keepends=True) or [""]
    place, other = random.randrange(len(lines)), random.randrange(len(lines))
    kind = random.randrange(4)
    if kind == 0:
        del lines[place]
    elif kind == 1:
        lines.insert(other, lines[place])
    elif kind == 2:
        lines[place], lines[other] = lines[other], lines[place]
    else:
        lines[place:place] = lines[place : place + 1] * random.choice((2, 50, 1000))
    return "".join(lines)


def _cut(random: Random, text: str) -> str:
    place = random.randint(0, len(text))
    return text[:place] if random.random() < 0.7 else text[place:]


def _insert(random: Random, text: str) -> str:
    place = random.randint(0, len(text))
    piece = random.choice(
        (random_text(random), random_quantity(random), random.choice(PIECES) * 50)
    )
    return text[:place] + piece + text[place:]


def _nest(random: Random, text: str) -> str:
    depth = random.choice((20, 200, 3000))
    opening, closing = random.choice((("[", "]"), ("{a=", "}"), ("(", ")"), ('{"a":', "}")))
    return _replace_match(random, text, _NUMBER, opening * depth + "1" + closing * depth)


def _join_halves(random: Random, text: str) -> str:
    """Join a start and an end of the text, which may overlap or leave out a part."""
    first, second = random.randint(0, len(text)), random.randint(0, len(text))
    return text[:first] + text[second:]


MUTATIONS: tuple[Callable[[Random, str], str], ...] = (
    _replace_number, _replace_number, _replace_string, _replace_type, _replace_word, _mutate_line,
    _move_lines, _cut, _insert, _nest, _join_halves,
)  # fmt: skip
"""Mutations of a text of numbers, strings, words and lines."""
