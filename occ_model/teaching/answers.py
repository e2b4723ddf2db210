"""Check a student's answer to a step of a lesson against the model."""

import math

from occ_model.errors import OccError, one_line
from occ_model.results.lessons import CheckedAnswer, Step
from occ_model.results.match import Match
from occ_model.scene.units import Unit
from occ_model.teaching.quantities import QUANTITIES

_NEAR = 3.0
"""An answer within so many tolerances is near."""

_LEAST_NEAR = 0.02
"""Relative difference that is near however small the tolerance is."""

_DIGITS = 3


def check_answer(step: Step, text: str, match: Match | None = None) -> CheckedAnswer:
    """Check what a student typed.

    The model's value is computed from the step's own scene, not from the one that the student has
    set meanwhile. Where the step is about a photo of the student's, it is that of the photo's
    match. A wrong answer does not give it away.

    Parameters
    ----------
    step
        The step.
    text
        The answer; a number without a unit is in the quantity's ``asked_in``.
    match
        The match of the photo that is open, None where there is none.

    Returns
    -------
    CheckedAnswer
        The outcome, with a sentence for the student.
    """
    text = text.strip()
    check = step.check
    if check is None:
        return CheckedAnswer(text, None, "Compare your answer with the explanation.")
    quantity = QUANTITIES[check.quantity]
    if step.own_photo and match is None:
        return CheckedAnswer(text, None, "Match the photo first: your answer is compared with it.")
    own = match if step.own_photo else None
    try:
        expected = quantity.compute(check.scene, own or step.photo)
    except OccError as error:
        return CheckedAnswer(text, None, f"This cannot be checked. {error}")
    plain = quantity.unit.factor(quantity.asked_in) or 1.0
    given = quantity.unit.parse(text, plain)
    if given is None or not math.isfinite(given):
        hint = f" in {quantity.asked_in}" if quantity.asked_in else ""
        return CheckedAnswer(text, "unreadable", f"“{one_line(text, 40)}” is no number{hint}.")
    difference = abs(given - expected) / abs(expected) if expected else abs(given)
    if difference <= check.tolerance * (1.0 + 1e-9):
        value = format_value(quantity.unit, expected)
        source = "The match" if own else "The model"
        return CheckedAnswer(text, "right", f"Right. {source} gives {value}.")
    side = "high" if given > expected else "low"
    if difference <= max(_NEAR * check.tolerance, _LEAST_NEAR):
        return CheckedAnswer(text, "near", f"Close, but a little too {side}. Look once more.")
    return CheckedAnswer(text, "wrong", f"Not yet: that is too {side}. Try again.")


def format_value(unit: Unit, value: float) -> str:
    """Write a value with as many digits as a student can read off; whole numbers in full."""
    if not unit.symbol and value == round(value):
        return f"{value:.0f}"
    return unit.format(value, _DIGITS)
