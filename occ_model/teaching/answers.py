"""Check a student's answer to a step of a lesson against the model, and explain the right one."""

import math

from occ_model.errors import OccError, one_line
from occ_model.results.match import Match
from occ_model.results.teaching import Check, CheckedAnswer, Step
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene
from occ_model.teaching.quantities import QUANTITIES, result_text

_NEAR_TOLERANCES = 3.0  # an answer within this many tolerances is near
_MIN_NEAR_DIFFERENCE = 0.02  # relative difference that is near however small the tolerance is
_SAME_DIFFERENCE = 1e-9  # relative difference of two values that are the same


def check_answer(
    step: Step, text: str, match: Match | None = None, scene: Scene | None = None
) -> CheckedAnswer:
    """Check what a student typed against the model's value.

    That is of the scene which the student sees, of the question's scene while nothing has been
    changed (a prediction), or of the ``match`` where the step is about a photo of the student's.
    Where the question names values and the student has set others, nothing is judged: they are to
    be set first. A wrong answer does not reveal the value.
    """
    text = text.strip()
    check = step.check
    if check is None:
        return CheckedAnswer(text, None, "Compare your answer with the explanation.")
    quantity = QUANTITIES[check.quantity]
    if step.own_photo and match is None:
        return CheckedAnswer(text, None, "Match the photo first: your answer is compared with it.")
    own = match if step.own_photo else None
    scene = check.scene if scene is None else step.judged_at(scene)
    first = "" if own else _to_set_first(check, scene)
    if first:
        return CheckedAnswer(text, None, first)
    try:
        expected = quantity.compute(scene, own or step.photo)
    except OccError as error:
        return CheckedAnswer(text, None, f"This cannot be checked. {error}")
    plain = quantity.unit.factor(quantity.asked_in) or 1.0
    given = quantity.unit.parse(text, plain)
    if given is None or not math.isfinite(given):
        hint = f" in {quantity.asked_in}" if quantity.asked_in else ""
        return CheckedAnswer(text, "unreadable", f"“{one_line(text, 40)}” is not a number{hint}.")
    difference = abs(given - expected) / abs(expected) if expected else abs(given)
    if difference <= check.tolerance * (1.0 + _SAME_DIFFERENCE):
        value = result_text(quantity.unit, expected)
        source = "The match" if own else "The model"
        return CheckedAnswer(text, "right", f"Right. {source} gives {value}.")
    if quantity.called:
        return CheckedAnswer(
            text, "wrong", f"Not yet: that is not the {quantity.called}. Try again."
        )
    side = "high" if given > expected else "low"
    if difference <= max(_NEAR_TOLERANCES * check.tolerance, _MIN_NEAR_DIFFERENCE):
        return CheckedAnswer(text, "near", f"Close, but a little too {side}. Look once more.")
    return CheckedAnswer(text, "wrong", f"Not yet: that is too {side}. Try again.")


def _to_set_first(check: Check, scene: Scene) -> str:
    """List the values that the question names and a scene lacks; empty where it has all."""
    differing = []
    for name in check.named:
        now, asked = scene.value(name), check.scene.value(name)
        if isinstance(now, float) and isinstance(asked, float):
            allowed = max(check.tolerance, _SAME_DIFFERENCE) * abs(asked)
            is_set = abs(now - asked) <= allowed
        else:
            is_set = now == asked
        if not is_set:
            declared = PARAMETERS[name]
            differing.append(f"{declared.label} to {declared.format(asked)}")  # type: ignore[arg-type]
    if not differing:
        return ""
    return f"First set {' and '.join(differing)}: the question is about that."


_MAX_NAMED = 2


def explanation(step: Step, scene: Scene) -> str:
    """Return a step's explanation, which begins with the scene of its numbers if not this one."""
    if step.own_photo or scene == step.asked:
        return step.answer
    names = (name for names in GROUPS.values() for name in names)
    differing = [name for name in names if scene.value(name) != step.asked.value(name)]
    own = ", ".join(
        f"{PARAMETERS[name].label}: {PARAMETERS[name].format(step.asked.value(name)) or 'empty'}"  # type: ignore[arg-type]
        for name in differing[:_MAX_NAMED]
    )
    more = ", …" if len(differing) > _MAX_NAMED else ""
    return f"For the lesson's own scene ({own}{more}): {step.answer}"
