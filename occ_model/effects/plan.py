"""The plan: which effects are simulated for a scene, at a tolerance."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from occ_model.effects.effect import Effect
from occ_model.effects.effect_sets import EffectSets
from occ_model.effects.estimates import Estimates, estimates_of
from occ_model.effects.paper_view import PaperView, paper_view_of
from occ_model.effects.registry import EFFECTS, NAMES
from occ_model.results.plan import Decision, Plan, Way
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import (
    TOLERANCE,
    NoiseSource,
    Observable,
    SimulationSettings,
    unit_of,
)
from occ_model.scene.units import NONE

_ROUNDING_FACTOR = 1.0 + 1e-9
"""Factor on an error in comparisons with one whose sums were rounded otherwise."""

_CLEAR_RATIO = 1.3  # ratio of limit to estimate from which both are stated


def plan(
    scene: Scene,
    tolerance: float = TOLERANCE.default,
    observable: Observable = "image",
    force: Mapping[str, bool] | None = None,
) -> Plan:
    """Decide which effects are simulated.

    Of all sets of effects whose absence changes what is observed by no more than the tolerance, the
    one is simulated that takes the least time. Changes are estimated from a sample of the pixels,
    with an allowance. Estimates and tolerance are counted in levels of the stretched profile, grey
    levels times 255 / swing: what a decoder sees is contrast. The swing is that of the profile, and
    for the signal that of the enhanced profile.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        Root mean square in levels of the stretched profile. 0: every effect that is not exactly
        nothing; infinity: none, the paper's model.
    observable
        ``"image"``: the camera's pixels of the panel's bounding rectangle; ``"profile"``: the means
        of its columns; ``"signal"``: the means of its columns after the receiver's contrast
        enhancement, which is what a decoder reads; ``"decision"``: the code that is read by a
        threshold. The tolerance is then a fraction of the chips' margin from it.
    force
        Effects that are always simulated (True) or left out (False). The tolerance does not cover
        what is left out by hand.

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
    force = {} if force is None else force
    return plan_with(scene, SimulationSettings(tolerance, observable, force))


def plan_with(scene: Scene, settings: SimulationSettings) -> Plan:
    settings = settings.checked(NAMES)
    return plan_of(paper_view_of(scene), settings)


def called_for_by_signal(chosen: Plan, scene: Scene) -> tuple[str, ...]:
    """Name the effects that a plan leaves out and one for the signal includes.

    A picture planned for its pixels, with a large tolerance, may so be decoded otherwise than in a
    study, which plans for the signal. Effects switched by hand are so in both.
    """
    left_out = {d.effect for d in chosen.decisions if d.estimate and not (d.included or d.forced)}
    if not left_out or chosen.observable == "signal" or chosen.tolerance == math.inf:
        return ()
    force = {d.effect: d.included for d in chosen.decisions if d.forced}
    own = plan_with(scene, SimulationSettings(chosen.tolerance, "signal", force))
    return tuple(d.label for d in own.decisions if d.included and d.effect in left_out)


def plan_of(view: PaperView, settings: SimulationSettings) -> Plan:
    """Decide which effects are simulated, from a view of a scene and checked settings."""
    sets = _sets_of(view, settings)
    estimates = sets.estimates
    way, error = sets.chosen(settings.tolerance)
    left_out = sets.names - way.effects
    decisions = tuple(_decide(effect, estimates, left_out, settings) for effect in EFFECTS)
    return Plan(
        tolerance=settings.tolerance,
        observable=settings.observable,
        decisions=decisions,
        left_out=0.0 if settings.tolerance == math.inf else error,
        stretch=estimates.stretch,
        saved=sets.everything - way.seconds,
        ways=sets.ways,
    )


def complete_plan(scene: Scene, settings: SimulationSettings) -> Plan:
    """Include every effect of a scene but those switched off by hand, without any estimate."""
    decisions = tuple(
        _take_in(effect, scene, settings.force.get(effect.name)) for effect in EFFECTS
    )
    return Plan(0.0, settings.observable, decisions, left_out=0.0, stretch=math.nan)


def _take_in(effect: Effect, scene: Scene, by_hand: bool | None) -> Decision:
    is_present = effect.is_present(scene)
    included = is_present if by_hand is None else by_hand
    estimate = math.inf if is_present else 0.0
    why = "not estimated" if is_present else "none in this scene"
    if by_hand is not None:
        why = f"switched {'on' if included else 'off'} by hand"
    reason = f"{why}: {'included' if included else 'left out'}"
    return Decision(
        effect.name, effect.label, effect.kind, effect.stage, estimate, estimate, included,
        by_hand is not None, why, reason,
    )  # fmt: skip


def signal_plan(
    scenes: Sequence[Scene], settings: SimulationSettings, *, needs_pixels: bool
) -> Plan:
    """Decide on the effects of pictures for decoders, which differ in phase and code alone.

    Where pixels are simulated, those that the signal of any of them calls for. Without pixels all
    effects take less time than estimating what they change.
    """
    own = replace(settings, observable="signal").checked(NAMES)
    complete = complete_plan(scenes[0], own)
    if needs_pixels or "image" in complete.kinds or own.tolerance == math.inf:
        return plan_of_any([paper_view_of(scene) for scene in scenes], own)
    return complete


def plan_of_any(views: Sequence[PaperView], settings: SimulationSettings) -> Plan:
    """Decide which effects are simulated in several pictures: those that any of them calls for."""
    present = {e.name for e in EFFECTS if any(e.is_present(view.scene) for view in views)}
    present -= {name for name, is_on in settings.force.items() if not is_on}
    chosen = plan_of(views[0], settings)
    for view in views[1:]:
        if present <= set(chosen.included):
            break  # none can call for more
        other = plan_of(view, settings)
        pairs = zip(chosen.decisions, other.decisions, strict=True)
        decisions = tuple(max(pair, key=lambda d: (d.included, d.estimate)) for pair in pairs)
        left_out = max(chosen.left_out, other.left_out)
        chosen = replace(chosen, decisions=decisions, left_out=left_out)
    return chosen


def ways_of(scene: Scene, settings: SimulationSettings) -> tuple[Way, ...]:
    """Return the sets of effects that a plan chooses among, the fastest first.

    The error of each is the least tolerance at which it is chosen; no two are the same.
    """
    sets = _sets_of(paper_view_of(scene), settings.checked(NAMES))
    found: list[Way] = []
    for way, error in zip(sets.ways, sets.errors_of(sets.ways), strict=True):
        if error < (found[-1].error if found else math.inf):
            found.append(Way(way.effects, way.seconds, error * _ROUNDING_FACTOR))
    return tuple(found)


def _sets_of(view: PaperView, settings: SimulationSettings) -> EffectSets:
    force = tuple(sorted(settings.force.items()))
    return _known_sets(view, settings.observable, force, settings.noise)


@lru_cache(maxsize=4)  # a picture, its forecast and its reading ask the same
def _known_sets(
    view: PaperView,
    observable: Observable,
    force: tuple[tuple[str, bool], ...],
    noise: NoiseSource,
) -> EffectSets:
    settings = SimulationSettings(observable=observable, force=dict(force), noise=noise)
    return EffectSets.of(estimates_of(view, settings), view, settings)


def _decide(
    effect: Effect, estimates: Estimates, left_out: frozenset[str], settings: SimulationSettings
) -> Decision:
    name = effect.name
    estimate, limit = (found.get(name, 0.0) for found in (estimates.sizes, estimates.limits))
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
        why = f"switched {'on' if included else 'off'} by hand"
        reason = f"{size}: {why}"
    elif not estimate or (estimates.unknown and tolerance != math.inf):
        why = size
        reason = f"{size}: {verdict}"
    else:
        why = _comparison(estimate, limit, tolerance, included)
        compared = "" if tolerance == math.inf else f", tolerance {tolerance:g}"
        together = ", " + why if included and estimate <= tolerance else ""
        reason = f"{size}{compared}{together}: {verdict}"
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


def _comparison(estimate: float, limit: float, tolerance: float, included: bool) -> str:
    if tolerance == math.inf:
        return "no tolerance is set"
    if not included:
        return "within the tolerance"
    if estimate > tolerance:
        return "above the tolerance"
    if limit > tolerance:
        return "not known to be within the tolerance"
    return "leaving out others saves more time"
