"""Says that the student has changed a step's scene, so that the text's numbers are not its."""

from occ_model.results.lessons import Step
from occ_model.scene.parameter_kinds import distinguished
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene

_MOST_NAMED = 2


def changed_sentence(step: Step, scene: Scene) -> str:
    """Say what differs from the step's scene, and what is about which.

    Empty where the scene is that of the step or of its check, and where the step is about a photo,
    whose match changes the scene when it is applied.
    """
    if step.own_photo or step.photo or scene in {step.scene, step.asked}:
        return ""
    changes = []
    for name in (name for names in GROUPS.values() for name in names):
        now, own = scene.value(name), step.scene.value(name)
        if now != own:
            texts = (text or "empty" for text in distinguished(PARAMETERS[name], now, own))
            changes.append(f"{PARAMETERS[name].label} is {next(texts)} instead of {next(texts)}")
    named = changes[:_MOST_NAMED]
    if len(changes) > _MOST_NAMED:
        named.append(f"{len(changes) - _MOST_NAMED} more")
    return (
        f"You have changed the scene: {' and '.join(named)}. Picture, formula, check and report "
        "are of your scene; the numbers in the text are of the lesson's own."
    )
