"""The plan: which effects are simulated for a scene, at a tolerance."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from occ_model.effects.effect import Effect, PaperView, paper_view_of
from occ_model.effects.effect_sets import EffectSets
from occ_model.effects.estimates import Estimates, estimates_of
from occ_model.effects.registry import EFFECTS, NAMES
from occ_model.results.frame import Decision, EffectSet, Plan
from occ_model.scene.scene import (
    TOLERANCE,
    Observable,
    Scene,
    SimulationSettings,
    unit_of,
)
from occ_model.scene.units import NONE

_ROUNDING_FACTOR = 1.0 + 1e-9
"""Allowance for comparing errors whose sums were rounded differently."""

_DISTINCT_FACTOR = 1.0 + 1e-7  # ratio of errors above which they are no rounding of each other

_CLEAR_RATIO = 1.3  # ratio of limit to estimate above which the reason states both


def plan(
    scene: Scene,
    tolerance: float = TOLERANCE.default,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
) -> Plan:
    """Decide which effects are simulated.

    The plan leaves out the effects that save most time, as long as the observable changes by no
    more than the tolerance. Changes are estimated from a sample of the pixels, with an allowance.
    Estimates and tolerance are in levels of the stretched profile, which are grey levels times 255
    / swing, since a decoder depends on contrast. The swing is that of the profile, or of the
    enhanced profile for the signal.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        Root mean square in levels of the stretched profile. 0 includes every effect that is not
        exactly nothing; infinity includes none, which is the paper's model.
    observable
        ``"image"``: the camera's pixels of the panel's bounding rectangle; ``"profile"``: the means
        of its columns; ``"signal"``: the means of its columns after the receiver's contrast
        enhancement, which is what a decoder reads; ``"decision"``: the code that a threshold
        decoder reads. For the decision, the tolerance is a fraction of the chips' margin from the
        threshold.
    force
        Effects that are always simulated (True) or always left out (False). The tolerance does not
        cover the effects that are left out here.

    Returns
    -------
    Plan

    Raises
    ------
    ParameterError
        The tolerance is negative or not a number, there is no such observable or effect, or the
        observable is the decision and the light is no code.
    ProjectionError
        Part of the panel is behind the camera.
    """
    force = {} if force is None else force
    return plan_with(scene, SimulationSettings(tolerance, observable, force))


def plan_with(scene: Scene, settings: SimulationSettings) -> Plan:
    settings = settings.check(NAMES)
    return plan_of(paper_view_of(scene), settings)


def name_effects_for_signal(planned: Plan, scene: Scene) -> tuple[str, ...]:
    """Name the effects that a plan leaves out, although a plan for the signal includes them.

    Without them, a picture planned for its pixels may be decoded differently than in a study, which
    plans for the signal. Effects that the user has switched are the same in both plans.
    """
    left_out = {d.effect for d in planned.decisions if d.estimate and not (d.included or d.forced)}
    if not left_out or planned.observable == "signal" or planned.tolerance == math.inf:
        return ()
    force = {d.effect: d.included for d in planned.decisions if d.forced}
    signal_plan = plan_with(scene, SimulationSettings(planned.tolerance, "signal", force))
    return tuple(d.label for d in signal_plan.decisions if d.included and d.effect in left_out)


def plan_of(view: PaperView, settings: SimulationSettings) -> Plan:
    """Decide which effects are simulated, from a view of a scene and checked settings."""
    sets = _sets_of(view, settings)
    estimates = sets.estimates
    effect_set, error = sets.choose(settings.tolerance)
    left_out = sets.names - effect_set.effects
    decisions = tuple(_decide(effect, estimates, left_out, settings) for effect in EFFECTS)
    by_hand = {d.effect for d in decisions if d.forced and d.estimate and not d.included}
    if settings.tolerance == math.inf:
        error = estimates.error_without(left_out)
    total_error = estimates.error_without(left_out | by_hand) if by_hand else error
    return Plan(
        tolerance=settings.tolerance,
        observable=settings.observable,
        decisions=decisions,
        left_out=error,
        error=total_error,
        stretch=estimates.stretch,
        saved=sets.complete_seconds - effect_set.seconds,
        effect_sets=sets.effect_sets,
    )


def complete_plan(scene: Scene, settings: SimulationSettings) -> Plan:
    """Include every effect of a scene that is not switched off, without estimates."""
    decisions = tuple(
        _decide_without_estimate(effect, scene, settings.force.get(effect.name))
        for effect in EFFECTS
    )
    return Plan(0.0, settings.observable, decisions, left_out=0.0, error=math.nan, stretch=math.nan)


def _decide_without_estimate(effect: Effect, scene: Scene, by_hand: bool | None) -> Decision:
    is_present = effect.is_present(scene)
    included = is_present if by_hand is None else by_hand
    estimate = math.inf if is_present else 0.0
    why = "not estimated" if is_present else "none in this scene"
    if by_hand is not None:
        why = f"switched {'on' if included else 'off'}"
    reason = f"{why}: {'included' if included else 'left out'}"
    return Decision(
        effect.name, effect.label, effect.kind, effect.stage, estimate, estimate, included,
        by_hand is not None, why, reason,
    )  # fmt: skip


def signal_plan(
    scenes: Sequence[Scene], settings: SimulationSettings, *, is_estimated: bool = False
) -> Plan:
    """Plan pictures for decoders, which differ only in phase and code.

    If pixels are simulated, effects are estimated, and the plan includes those that the signal of
    any picture needs. If not, simulating all effects takes less time than estimating what they
    change.
    """
    signal_settings = replace(settings, observable="signal").check(NAMES)
    if is_estimated or signal_settings.tolerance == math.inf:
        return plan_of_any([paper_view_of(scene) for scene in scenes], signal_settings)
    return complete_plan(scenes[0], signal_settings)


def plan_of_any(views: Sequence[PaperView], settings: SimulationSettings) -> Plan:
    """Plan several pictures at once: include the effects that any of them needs."""
    present = {e.name for e in EFFECTS if any(e.is_present(view.scene) for view in views)}
    present -= {name for name, is_on in settings.force.items() if not is_on}
    chosen = plan_of(views[0], settings)
    for view in views[1:]:
        if present <= set(chosen.included):
            break  # no other picture can need more
        other_plan = plan_of(view, settings)
        pairs = zip(chosen.decisions, other_plan.decisions, strict=True)
        decisions = tuple(max(pair, key=lambda d: (d.included, d.estimate)) for pair in pairs)
        left_out, error = (max(pair) for pair in (
            (chosen.left_out, other_plan.left_out), (chosen.error, other_plan.error),
        ))  # fmt: skip
        chosen = replace(chosen, decisions=decisions, left_out=left_out, error=error)
    return chosen


def effect_sets_of(scene: Scene, settings: SimulationSettings) -> tuple[EffectSet, ...]:
    """Return the sets of effects among which a plan chooses, fastest first.

    The error of each is the smallest tolerance at which it is chosen; no two are equal.
    """
    sets = _sets_of(paper_view_of(scene), settings.check(NAMES))
    effect_sets: list[EffectSet] = []
    for effect_set, error in zip(sets.effect_sets, sets.errors_of(sets.effect_sets), strict=True):
        least = error * _DISTINCT_FACTOR
        if not effect_sets or least < effect_sets[-1].error:
            effect_sets.append(
                EffectSet(effect_set.effects, effect_set.seconds, error * _ROUNDING_FACTOR)
            )
    return tuple(effect_sets)


def _sets_of(view: PaperView, settings: SimulationSettings) -> EffectSets:
    force = tuple(sorted(settings.force.items()))
    return _cached_sets(view, settings.observable, force)


@lru_cache(maxsize=4)  # a picture, its forecast and its decoding ask for the same sets
def _cached_sets(
    view: PaperView,
    observable: Observable,
    force: tuple[tuple[str, bool], ...],
) -> EffectSets:
    settings = SimulationSettings(observable=observable, force=dict(force))
    return EffectSets.of(estimates_of(view, settings), view, settings)


def _decide(
    effect: Effect, estimates: Estimates, left_out: frozenset[str], settings: SimulationSettings
) -> Decision:
    name = effect.name
    estimate, limit = estimates.sizes.get(name, 0.0), estimates.limits.get(name, 0.0)
    by_hand = settings.force.get(name)
    included = bool(estimate) and name not in left_out if by_hand is None else by_hand
    unit = unit_of(settings.observable)
    size = f"about {NONE.format(estimate, 2)} {unit}" if estimate else "none in this scene"
    if estimate and estimates.unknown:
        size = f"not known, as {estimates.unknown}"
    elif estimate and limit > _CLEAR_RATIO * estimate:
        size = f"about {NONE.format(estimate, 2)}, at most {NONE.format(limit, 2)} {unit}"
    verdict = "included" if included else "left out"
    tolerance = settings.tolerance
    if by_hand is not None:
        why = f"switched {'on' if included else 'off'}"
        reason = f"{size}: {why}"
    elif not estimate or (estimates.unknown and tolerance != math.inf):
        why = size
        reason = f"{size}: {verdict}"
    else:
        why = _compare_with_tolerance(estimate, limit, tolerance, included)
        comparison = "" if tolerance == math.inf else f", tolerance {tolerance:g}"
        addition = ", " + why if included and estimate <= tolerance else ""
        reason = f"{size}{comparison}{addition}: {verdict}"
    return Decision(
        effect=name,
        label=effect.label,
        kind=effect.kind,
        stage=effect.stage,
        estimate=estimate,
        limit=limit,
        included=included,
        forced=by_hand is not None,
        why=why,
        reason=reason,
    )


def _compare_with_tolerance(estimate: float, limit: float, tolerance: float, included: bool) -> str:
    if tolerance == math.inf:
        return "no tolerance is set"
    if not included:
        return "within the tolerance"
    if estimate > tolerance:
        return "above the tolerance"
    if limit > tolerance:
        return "not known to be within the tolerance"
    return "leaving out others saves more time"
