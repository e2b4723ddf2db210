"""Sentences about refused values that name a parameter by its label on screen."""

from occ_model.errors import OccError, ParameterError, capitalize
from occ_model.scene.parameters import PARAMETERS

_CANNOT = {"is": "cannot be", "has": "cannot have"}


def sentence_with_label(error: OccError) -> str:
    """Return the sentence of an error, with the parameter's label in place of its name."""
    refused = error.refused if isinstance(error, ParameterError) else None
    if refused is None or refused.parameter not in PARAMETERS:
        return str(error)
    return refused.sentence(PARAMETERS[refused.parameter].label)


def refusal_of(error: OccError) -> str:
    """Phrase an error as the refusal of a value, not as a fault of the present one.

    "Distance cannot be 0 m" stands beside a field that shows the last allowed value again. If the
    allowed range depends on other parameters, the refused value may be the present one.
    """
    refused = error.refused if isinstance(error, ParameterError) else None
    if refused is None or refused.condition or refused.verb not in _CANNOT:
        return f"Refused: {sentence_with_label(error)}"
    declared = PARAMETERS.get(refused.parameter)
    label = refused.parameter.replace("_", " ") if declared is None else declared.label
    return refused.sentence(capitalize(label), _CANNOT[refused.verb])
