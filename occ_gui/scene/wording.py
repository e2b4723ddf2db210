"""Wording of the model's sentences: labels for parameter names, refusals for wrong values."""

import re

from occ_model.scene.parameter_kinds import Parameter, ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS

_FIRST = re.compile(r"^[a-z]\w*")
_INNER = re.compile(r"\b[a-z]+(?:_[a-z0-9]+)+\b")
"""Names with an underscore; a name without one could be an ordinary word, and is kept."""

_WRONG_VALUE = re.compile(r"^([^;]+?) (is|are|has) (.*; allowed: .*)$", re.DOTALL)
_ALL_DIGITS = 17

_CANNOT = {"is": "cannot be", "are": "cannot be", "has": "cannot have"}


def refusal_of(sentence: str) -> str:
    """Say that a value was refused, in the model's words about it.

    The model says what the value is: "distance is 0 m; allowed: ...". Beside a field that shows the
    last allowed value again, that would be wrong.
    """
    found = _WRONG_VALUE.match(sentence)
    if found is None:
        return f"Refused: {with_labels(sentence)}"
    name, verb, rest = found.groups()
    declared = PARAMETERS.get(name)
    label = name.replace("_", " ") if declared is None else declared.label
    return with_labels(f"{label[:1].upper()}{label[1:]} {_CANNOT[verb]} {rest}")


def with_labels(sentence: str) -> str:
    """Replace the names of parameters by the labels of their fields."""

    def first(found: re.Match[str]) -> str:
        declared = PARAMETERS.get(found[0])
        return found[0] if declared is None else declared.label

    def inner(found: re.Match[str]) -> str:
        declared = PARAMETERS.get(found[0])
        return found[0] if declared is None else f"“{declared.label}”"

    return _INNER.sub(inner, _FIRST.sub(first, sentence))


def distinguished(
    declared: Parameter, one: ParameterValue, other: ParameterValue
) -> tuple[str, str]:
    """Format two different values with enough digits to distinguish them."""
    if isinstance(declared, Quantity):
        a, b = float(one), float(other)
        texts = declared.format(a), declared.format(b)
        if texts[0] != texts[1]:
            return texts
        return declared.format(a, _ALL_DIGITS), declared.format(b, _ALL_DIGITS)
    return str(one), str(other)
