"""Sentences of the model in the words of the window."""

import re

from occ_model.scene.parameters import PARAMETERS

_FIRST = re.compile(r"^[a-z]\w*")
_INNER = re.compile(r"\b[a-z]+(?:_[a-z0-9]+)+\b")
"""Names that are no words of the language: the others are left as they are."""


def spoken(sentence: str) -> str:
    """Put the labels of parameters, which stand beside their fields, in place of their names."""

    def first(found: re.Match[str]) -> str:
        declared = PARAMETERS.get(found[0])
        return found[0] if declared is None else declared.label

    def inner(found: re.Match[str]) -> str:
        declared = PARAMETERS.get(found[0])
        return found[0] if declared is None else f"“{declared.label}”"

    return _INNER.sub(inner, _FIRST.sub(first, sentence))
