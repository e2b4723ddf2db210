"""The explanation of a step, with the scene that its numbers are of."""

from occ_model.results.lessons import Step
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene

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
