"""Why a picture is not read, and what would help, in words."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.units import PERCENT


@dataclass(frozen=True, slots=True)
class Remedy:
    """A remedy: parameters to change, in SI units, or another decoder."""

    label: str
    changes: Mapping[str, ParameterValue] = field(default_factory=dict)
    decoder: str = ""


@dataclass(frozen=True, slots=True)
class Cause:
    """What is wrong in a few words, why in a sentence, and a remedy, if any."""

    what: str
    why: str
    remedy: Remedy | None = None
    is_overexposed: bool = False

    def __str__(self) -> str:
        return f"{self.what[:1].upper()}{self.what[1:]}. {self.why}"


_SYMPTOM_END = re.compile(r"[:;.](?= |$)")


def symptom(failure: str) -> str:
    """Return the start of a failure, without what it might come from and what might help."""
    first = _SYMPTOM_END.split(failure, maxsplit=1)[0]
    return f"{first}." if first else ""


def overexposed_text(fraction: float) -> str:
    """Return the sentence on the fraction of the panel's columns that are overexposed."""
    return f"Overexposed: {PERCENT.format(fraction, 2)} of the panel's columns are white, or full."
