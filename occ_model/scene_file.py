"""TOML in and out: tables of parameters, with the version of the format, read strictly."""

import tomllib
from collections.abc import Mapping
from typing import Any

import tomli_w

from occ_model.errors import SceneFileError

FORMAT = 1


def to_toml(tables: Mapping[str, Mapping[str, object]]) -> str:
    """Write tables as TOML, the format's version first."""
    return tomli_w.dumps({"format": FORMAT, **tables})


def from_toml(text: str) -> dict[str, Any]:
    """Read what :func:`to_toml` wrote, without the version.

    Raises
    ------
    SceneFileError
        It is no text, is not TOML, names no format, or a format that this version does not know.
    """
    if not isinstance(text, str):
        raise SceneFileError(f"A scene is read from text (str), not from {type(text).__name__}.")
    try:
        content = tomllib.loads(text)
    except ValueError as error:  # a TOMLDecodeError, or a number of thousands of digits
        raise SceneFileError(f"This is not a TOML file: {error}.") from None
    except RecursionError:
        raise SceneFileError("This is not a scene file: it is nested too deeply.") from None
    version = content.pop("format", None)
    if version is None:
        raise SceneFileError(f"This is not a scene file: it has no line 'format = {FORMAT}'.")
    if isinstance(version, bool) or version != FORMAT:
        raise SceneFileError(
            f"The scene file has format {version!r}; this version reads format {FORMAT}."
        )
    return content
