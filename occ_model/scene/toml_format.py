"""The TOML format of scene files: tables of parameters and the format's version."""

import re
import tomllib
from collections.abc import Mapping
from typing import Any

import tomli_w

from occ_model.errors import SceneFileError, one_line, quote

FORMAT = 1

_MAX_KEY_PARTS = 32  # of a dotted key: the parser's time grows as their square; scenes need two
_LONG_KEY = re.compile(rf"(?:(?<![\w-])[\w-]++[ \t]*+\.[ \t]*+){{{_MAX_KEY_PARTS}}}")

_STRING_OR_COMMENT = re.compile(  # an unclosed one ends with its line or with the text
    r'''"""(?:[^"\\]|\\.|"(?!""))*+(?:"""|\Z)'''
    r"""|'''(?:[^']|'(?!''))*+(?:'''|\Z)"""
    r"""|"(?:[^"\\\n]|\\[^\n])*+"?"""
    r"""|'[^'\n]*+'?|#[^\n]*+""",
    re.DOTALL,
)


def to_toml(tables: Mapping[str, Mapping[str, object]]) -> str:
    """Write tables as TOML, with the format's version first."""
    return tomli_w.dumps({"format": FORMAT, **tables})


def from_toml(text: str) -> dict[str, Any]:
    """Parse a text of :func:`to_toml` into its tables, and check its version."""
    content = parse_toml(text)
    version = content.pop("format", None)
    if version is None:
        raise SceneFileError(f"This is not a scene file: it has no line 'format = {FORMAT}'.")
    if isinstance(version, bool) or version != FORMAT:
        raise SceneFileError(
            f"The scene file has format {quote(version)}; this version reads format {FORMAT}."
        )
    return content


def table_of(value: object, name: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise SceneFileError(f"{name} must be a table: a line '[{name}]' and its keys.")
    return value


def parse_toml(text: str) -> dict[str, Any]:
    """Parse TOML from an untrusted source, in a time in proportion to the text's length."""
    if not isinstance(text, str):
        raise SceneFileError(f"A scene is read from text (str), not from {type(text).__name__}.")
    # A dot inside a string does not separate parts of a key.
    if _LONG_KEY.search(_STRING_OR_COMMENT.sub("s", text)):
        raise SceneFileError(
            f"This is not a scene file: a key has more than {_MAX_KEY_PARTS} parts."
        )
    try:
        return tomllib.loads(text)
    except ValueError as error:  # also for a number of thousands of digits
        raise SceneFileError(f"This is not a TOML file: {one_line(str(error))}.") from None
    except RecursionError:
        raise SceneFileError("This is not a scene file: it is nested too deeply.") from None
