"""Check students' answers in lessons against the model, and explain the right ones."""

import math

from occ_model.errors import OccError, one_line
from occ_model.results.match import Match
from occ_model.results.teaching import Check, CheckedAnswer, LessonStep
from occ_model.scene.parameter_kinds import format_distinctly
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene
from occ_model.teaching.quantities import QUANTITIES, result_text

_NEAR_TOLERANCES = 3.0  # tolerances within which an answer is near
_MIN_NEAR_DIFFERENCE = 0.02  # relative difference that is near for any tolerance
_SAME_DIFFERENCE = 1e-9  # largest relative difference of two values that count as equal


def check_answer(
    step: LessonStep, text: str, match: Match | None = None, scene: Scene | None = None
) -> CheckedAnswer:
    """Check an answer that a student typed against the model's value.

    The value is that of ``scene``, which is None if nothing has been changed: then that of the
    question's scene, a prediction. If the step is about the student's own photo, it is that of the
    ``match``. If the question names values and the student has set others, the answer is judged
    only once the named ones are set. A wrong answer does not reveal the value.
    """
    text = text.strip()
    check = step.check
    if check is None:
        return CheckedAnswer(text, None, "Compare your answer with the explanation.")
    quantity = QUANTITIES[check.quantity]
    if step.own_photo and match is None:
        return CheckedAnswer(
            text, None, "Match the photo first: your answer is compared with the match."
        )
    own_match = match if step.own_photo else None
    scene = check.scene if scene is None else step.scene_to_judge(scene)
    instruction = "" if own_match else _name_unset_values(check, scene)
    if instruction:
        return CheckedAnswer(text, None, instruction)
    try:
        model_value = quantity.compute(scene, own_match or step.photo)
    except OccError as error:
        return CheckedAnswer(text, None, f"This cannot be checked. {error}")
    default_factor = quantity.unit.factor(quantity.asked_in) or 1.0
    answer = quantity.unit.parse(text, default_factor)
    if answer is None or not math.isfinite(answer):
        hint = f" in {quantity.asked_in}" if quantity.asked_in else ""
        return CheckedAnswer(text, "unreadable", f"“{one_line(text, 40)}” is not a number{hint}.")
    difference = abs(answer - model_value) / abs(model_value) if model_value else abs(answer)
    if difference <= check.tolerance * (1.0 + _SAME_DIFFERENCE):
        value = result_text(quantity.unit, model_value)
        source = "The match" if own_match else "The model"
        return CheckedAnswer(text, "right", f"Right. {source} gives {value}.")
    if quantity.identified:  # a code: no number is near it
        return CheckedAnswer(
            text, "wrong", f"Not yet: that is not the {quantity.identified}. Try again."
        )
    direction = "high" if answer > model_value else "low"
    if difference <= max(_NEAR_TOLERANCES * check.tolerance, _MIN_NEAR_DIFFERENCE):
        return CheckedAnswer(text, "near", f"Close, but a little too {direction}. Look again.")
    return CheckedAnswer(text, "wrong", f"Not yet: that is too {direction}. Try again.")


def _name_unset_values(check: Check, scene: Scene) -> str:
    """Name the values of the question that a scene does not have; empty if it has all."""
    settings = []
    for name in check.named:
        present, required = scene.value(name), check.scene.value(name)
        if isinstance(present, float) and isinstance(required, float):
            allowed = max(check.tolerance, _SAME_DIFFERENCE) * abs(required)
            is_set = abs(present - required) <= allowed
        else:
            is_set = present == required
        if not is_set:
            parameter = PARAMETERS[name]
            settings.append(f"{parameter.label} to {parameter.format(required)}")  # type: ignore[arg-type]
    if not settings:
        return ""
    return f"First set {' and '.join(settings)}, as in the question."


_MAX_NAMED = 2  # parameters whose values are stated; others are only counted


def explanation(step: LessonStep, scene: Scene) -> str:
    """Return a step's explanation; for another scene, with the one that its numbers belong to."""
    question = step.question_scene
    if step.own_photo or scene == question:
        return step.answer
    differing = _list_differing(scene, question)
    values = ", ".join(
        f"{PARAMETERS[name].label}: {PARAMETERS[name].format(question.value(name)) or 'empty'}"  # type: ignore[arg-type]
        for name in differing[:_MAX_NAMED]
    )
    more = ", …" if len(differing) > _MAX_NAMED else ""
    return f"For the lesson's own scene ({values}{more}): {step.answer}"


def describe_changes(step: LessonStep, scene: Scene) -> str:
    """State how the scene differs from the step's, and to which of the two each text refers.

    Empty for the scene of the step or of its check, and for a step about a photo, whose match
    changes the scene.
    """
    if step.own_photo or step.photo or scene in {step.scene, step.question_scene}:
        return ""
    differing = _list_differing(scene, step.scene)
    stated = []
    for name in differing[:_MAX_NAMED]:
        declared = PARAMETERS[name]
        texts = format_distinctly(declared, scene.value(name), step.scene.value(name))
        value, step_value = (text or "empty" for text in texts)
        stated.append(f"{declared.label} is {value} instead of {step_value}")
    if len(differing) > _MAX_NAMED:
        stated.append(f"{len(differing) - _MAX_NAMED} more")
    return (
        f"You have changed the scene: {' and '.join(stated)}. Picture, formula, check and report "
        "are of your scene; the numbers in the text are the lesson's."
    )


def _list_differing(scene: Scene, other: Scene) -> list[str]:
    """List the parameters in which two scenes differ."""
    names = (name for group in GROUPS.values() for name in group)
    return [name for name in names if scene.value(name) != other.value(name)]
