"""Wording of the model's sentences: labels in place of parameter names."""

import re

from occ_model.scene.parameters import PARAMETERS

_FIRST = re.compile(r"^[a-z]\w*")
_INNER = re.compile(r"\b[a-z]+(?:_[a-z0-9]+)+\b")
"""Names with an underscore; a name without one could be an ordinary word, and is kept."""


def with_labels(sentence: str) -> str:
    """Replace the names of parameters by the labels of their fields."""

    def first(found: re.Match[str]) -> str:
        declared = PARAMETERS.get(found[0])
        return found[0] if declared is None else declared.label

    def inner(found: re.Match[str]) -> str:
        declared = PARAMETERS.get(found[0])
        return found[0] if declared is None else f"“{declared.label}”"

    return _INNER.sub(inner, _FIRST.sub(first, sentence))
