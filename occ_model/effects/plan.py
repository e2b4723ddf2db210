"""The plan: which effects a scene calls for."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from occ_model.camera.photometry import WHITE
from occ_model.checks import check_choice
from occ_model.effects.effect import Effect, FileEffect, NoiseEffect
from occ_model.effects.noise_bound import louder
from occ_model.effects.registry import EFFECTS, NAMES
from occ_model.effects.sight import sight_of
from occ_model.results import Decision, Plan
from occ_model.scene import Scene
from occ_model.simulation_settings import OBSERVABLES, TOLERANCE, Observable


def plan(
    scene: Scene,
    tolerance: float = TOLERANCE.default,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
) -> Plan:
    """Decide which effects are simulated.

    The effects with the smallest bounds are left out, as long as the sum of those bounds stays
    within the tolerance: root mean squares obey the triangle inequality, so that what is observed
    then differs by no more from what it is with all effects. Bounds and tolerance are counted in
    levels of the stretched profile, grey levels times 255 / swing: what a decoder sees is contrast.

    A file's rounding turns small changes into steps. With it in the plan, what is left out is
    counted as it comes through the file.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        Root mean square in levels of the stretched profile. 0: every effect that is not exactly
        nothing; infinity: none, the paper's model.
    observable
        ``"image"``: the pixels of the panel's bounding rectangle; ``"profile"``: the means of its
        columns, which is what a decoder sees.
    force
        Effects that are simulated (True) or left out (False) whatever they do. What is left out by
        hand is outside of the promise.

    Returns
    -------
    Plan

    Raises
    ------
    ParameterError
        The tolerance is negative or no number, or there is no such observable or effect.
    ProjectionError
        Part of the panel is behind the camera.
    """
    tolerance = TOLERANCE.check(tolerance)
    check_choice("observable", observable, OBSERVABLES)
    forced = dict(force or {})
    for name in forced:
        check_choice("effect", name, NAMES)
    stretch = WHITE / sight_of(scene).swing
    bounds = _bounds(scene, observable, stretch)
    if tolerance == math.inf:  # also of what a bound says to be without end
        budget = _Budget(tolerance, frozenset(NAMES), 0.0)
    else:
        budget = _spend(scene, tolerance, observable, bounds, forced, stretch)
    decisions = tuple(
        _decide(effect, bounds[effect.name], budget, forced.get(effect.name)) for effect in EFFECTS
    )
    return Plan(tolerance, observable, decisions, budget.spent, stretch)


def _bounds(scene: Scene, observable: Observable, stretch: float) -> dict[str, float]:
    """Give every effect's bound in levels of the stretched profile."""
    bounds = {effect.name: effect.bound(scene, observable) * stretch for effect in EFFECTS}
    noise = tuple(e for e in EFFECTS if isinstance(e, NoiseEffect) and bounds[e.name])
    others = [e.name for e in EFFECTS if not isinstance(e, NoiseEffect) and bounds[e.name]]
    if noise and others:
        more = louder(noise, scene, observable)
        for name in others:
            bounds[name] *= more
    return bounds


@dataclass(frozen=True, slots=True)
class _Budget:
    """What the tolerance is spent on."""

    tolerance: float
    left_out: frozenset[str]
    spent: float
    file: str = ""


def _spend(
    scene: Scene,
    tolerance: float,
    observable: Observable,
    bounds: Mapping[str, float],
    forced: Mapping[str, bool],
    stretch: float,
) -> _Budget:
    """Leave out the smallest bounds first, as far as the tolerance reaches."""
    free = sorted((name for name in NAMES if name not in forced), key=lambda name: bounds[name])
    budget = _leave_out(free, bounds, tolerance)
    files = [e for e in EFFECTS if isinstance(e, FileEffect) and bounds[e.name]]
    kept = [e for e in files if e.name not in budget.left_out and forced.get(e.name, True)]
    if not kept:
        return budget
    # A file is made of pixels, whatever is observed of it later.
    pixels = bounds if observable == "image" else _bounds(scene, "image", stretch)
    free = sorted((n for n in free if n != kept[0].name), key=lambda name: pixels[name])
    return _leave_out(free, pixels, tolerance, kept[0], scene, stretch)


def _leave_out(
    free: list[str],
    bounds: Mapping[str, float],
    tolerance: float,
    file: FileEffect | None = None,
    scene: Scene | None = None,
    stretch: float = 1.0,
) -> _Budget:
    total, spent, left_out = 0.0, 0.0, set()
    for name in free:
        total += bounds[name]
        seen = total
        if file is not None and scene is not None and total:
            seen = file.passed_on(scene, total / stretch) * stretch
        if seen > tolerance:
            break
        spent = seen
        left_out.add(name)
    return _Budget(tolerance, frozenset(left_out), spent, file.label if file else "")


def _decide(effect: Effect, bound: float, budget: _Budget, forced: bool | None) -> Decision:
    included = effect.name not in budget.left_out if forced is None else forced
    return Decision(
        effect=effect.name,
        label=effect.label,
        kind=effect.kind,
        bound=bound,
        included=included,
        forced=forced is not None,
        reason=_reason(bound, budget, included, forced),
    )


def _reason(bound: float, budget: _Budget, included: bool, forced: bool | None) -> str:
    size = f"at most {bound:.2g} levels" if bound else "none in this scene"
    if forced is not None:
        return f"{size}: switched {'on' if included else 'off'} by hand"
    if not bound:
        return f"{size}: left out"
    if budget.tolerance == math.inf:
        return f"{size}, no limit: left out"
    limit = f"tolerance {budget.tolerance:g}"
    if not included:
        return f"{size}, {limit}: left out"
    if bound > budget.tolerance:
        return f"{size}, {limit}: taken in"
    if budget.file:
        return f"{size}, which {budget.file} can turn into more than the {limit}: taken in"
    return f"{size}, with what is left out already more than the {limit}: taken in"
