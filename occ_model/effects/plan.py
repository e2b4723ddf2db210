"""The plan: which effects are simulated for a scene, at a tolerance."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import FLAT, WHITE
from occ_model.effects.change import margins, observed
from occ_model.effects.cost import seconds_of
from occ_model.effects.effect import Effect
from occ_model.effects.observed import Observed
from occ_model.effects.observed_signal import signal_swing
from occ_model.effects.paper_view import PaperView, paper_view_of
from occ_model.effects.registry import EFFECTS, NAMES
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.errors import ProjectionError
from occ_model.results.plan import Decision, Plan, Way
from occ_model.scene.scene import Scene, check_scene
from occ_model.scene.simulation_settings import TOLERANCE, Observable, SimulationSettings

ALLOWANCE = 1.2
"""Factor on what a sample shows, so that hardly any change is larger than its estimate."""

_PEAK, _NOISE_PEAK = 2.0, 3.0
"""Root mean squares of a smooth change, and of noise, that are to stay within a chip's margin."""

_FARTHEST = 1.5
"""Times that changes that are added may exceed the tolerance where together they are within it."""

_LEAST_ESTIMATE = 1e-9
"""Estimate in grey levels of an effect that a scene has and a sample does not show."""


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
        threshold. The tolerance is then a share of the chips' margin from it.
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
    """Decide which effects are simulated with some settings: see :func:`plan`."""
    check_scene(scene)
    settings = settings.checked(NAMES)
    return plan_of(paper_view_of(scene), settings)


def called_for_by_signal(chosen: Plan, scene: Scene) -> tuple[str, ...]:
    """Name the effects that a plan leaves out and one for the signal takes in.

    A picture that is planned for its pixels, with a large tolerance, may so be decoded otherwise
    than a study says, which plans for the signal. What is switched by hand is so in both.

    Parameters
    ----------
    chosen
        A plan, for any observable.
    scene
        Its scene.

    Returns
    -------
    tuple of str
        Their labels.
    """
    left_out = {d.effect for d in chosen.decisions if d.estimate and not (d.included or d.forced)}
    if not left_out or chosen.observable == "signal" or chosen.tolerance == math.inf:
        return ()
    force = {d.effect: d.included for d in chosen.decisions if d.forced}
    own = plan_with(scene, SimulationSettings(chosen.tolerance, "signal", force))
    return tuple(d.label for d in own.decisions if d.included and d.effect in left_out)


def plan_of(view: PaperView, settings: SimulationSettings) -> Plan:
    """Decide which effects are simulated, from the paper's view of a scene.

    Parameters
    ----------
    view
        The paper's view.
    settings
        Checked; the seed is not used.
    """
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


def ways_of(scene: Scene, settings: SimulationSettings) -> tuple[Way, ...]:
    """Return the sets of effects that a plan chooses among, the fastest first.

    The error of each is the least tolerance at which it is chosen; no two are the same.

    Parameters
    ----------
    scene
        The scene.
    settings
        Their tolerance is not used.

    Raises
    ------
    ParameterError
        There is no such observable or effect.
    ProjectionError
        Part of the panel is behind the camera.
    """
    check_scene(scene)
    sets = _sets_of(paper_view_of(scene), settings.checked(NAMES))
    found: list[Way] = []
    for way in sets.ways:
        error = sets.error_of(way)
        if error < (found[-1].error if found else math.inf):
            found.append(Way(way.effects, way.seconds, error))
    return tuple(found)


def _sets_of(view: PaperView, settings: SimulationSettings) -> "_Sets":
    """Return the sets of effects that a scene can be simulated with."""
    try:
        estimates = _Estimates.of(view, settings.observable)
    except ProjectionError:  # the simulation refuses the lens
        estimates = _Estimates({"distortion": math.inf}, None, WHITE / view.swing, {})
    force = settings.force
    if any(not on and name in estimates.sizes for name, on in force.items()):
        kept = tuple(effect for effect in EFFECTS if force.get(effect.name, True))
        rest = _Estimates.of(view, settings.observable, kept)
        estimates = rest.with_sizes_of(estimates)
    if view.swing <= FLAT:  # far above the tolerance, or hidden to a sample: it cannot tell
        estimates = estimates.unknown()
    return _Sets.of(estimates, view, settings)


@dataclass(frozen=True, eq=False, slots=True)
class _Estimates:
    """What leaving effects out changes.

    Parameters
    ----------
    sizes
        The change by each effect of the scene, in levels of the stretched profile, by name.
    seen
        What is observed, None where nothing can be.
    stretch
        Levels of the stretched profile per grey level.
    factors
        By what an effect's change counts more than by its size.
    """

    sizes: Mapping[str, float]
    seen: Observed | None
    stretch: float
    factors: Mapping[str, float]

    @classmethod
    def of(
        cls, view: PaperView, observable: Observable, effects: tuple[Effect, ...] = EFFECTS
    ) -> "_Estimates":
        """Estimate the changes by effects of a scene."""
        pixels = SampledPixels(view, effects)
        of_signal = observable in ("signal", "decision")
        swing = signal_swing(pixels) if of_signal else view.swing
        stretch, factors = WHITE / swing, dict.fromkeys(pixels.names, 1.0)
        seen = observed(pixels, "signal" if of_signal else observable)
        if observable == "decision":
            margin, step = (max(found, 1e-6) for found in margins(pixels, seen))
            stretch = _PEAK / margin
            for name in pixels.names:
                if pixels.is_like_noise(name):
                    factors[name] = _NOISE_PEAK / _PEAK * max(margin / step, 1.0)
        sizes = {
            effect.name: max(math.sqrt(seen.together(frozenset({effect.name}))), _LEAST_ESTIMATE)
            * (ALLOWANCE * stretch * factors[effect.name])
            for effect in pixels.effects
        }
        return cls(sizes, seen, stretch, factors)

    def unknown(self) -> "_Estimates":
        """Return the same where no set of effects is known to be small enough together."""
        return _Estimates(self.sizes, None, self.stretch, self.factors)

    def with_sizes_of(self, other: "_Estimates") -> "_Estimates":
        """Return the same with the sizes of effects that are missing here."""
        return _Estimates({**other.sizes, **self.sizes}, self.seen, self.stretch, self.factors)

    def error_of(self, left_out: frozenset[str]) -> float:
        """Return what leaving out some effects together changes, in levels."""
        if not left_out:
            return 0.0
        if self.seen is None:
            return math.inf
        factor = max(self.factors.get(name, 1.0) for name in left_out)
        return math.sqrt(self.seen.together(left_out)) * ALLOWANCE * self.stretch * factor


@dataclass(frozen=True, eq=False, slots=True)
class _Choice:
    """What is left out, what that changes and saves, and what else could be."""

    left_out: frozenset[str]
    error: float
    saved: float
    ways: tuple[Way, ...]


@dataclass(frozen=True, eq=False, slots=True)
class _Sets:
    """The sets of effects that no other is both faster and closer than, the fastest first.

    Parameters
    ----------
    estimates
        What leaving effects out changes.
    names
        The effects that may be left out.
    everything
        Seconds with all of them.
    ways
        The sets, with their errors as if changes added.
    """

    estimates: _Estimates
    names: frozenset[str]
    everything: float
    ways: tuple[Way, ...]

    @classmethod
    def of(cls, estimates: _Estimates, view: PaperView, settings: SimulationSettings) -> "_Sets":
        """Compare all sets of a scene's effects that are not switched by hand."""
        force = settings.force
        free = [e for e in EFFECTS if e.name in estimates.sizes and e.name not in force]
        forced_in = [e for e in EFFECTS if force.get(e.name)]
        members = _subsets(len(free))
        pixels = view.scene.camera.rows * view.scene.camera.columns
        inside = np.hstack([1.0 - members, np.ones((len(members), len(forced_in)))])
        seconds = seconds_of([*free, *forced_in], inside, pixels, settings.noise)
        names = [effect.name for effect in free]
        if estimates.seen is None:
            errors = np.where(members.any(axis=1), math.inf, 0.0)
        elif names:
            factors = np.array([estimates.factors[name] for name in names])
            squares = estimates.seen.of_subsets(names, members)
            factor = np.maximum((members * factors).max(axis=1), 1.0)
            errors = np.sqrt(squares) * (ALLOWANCE * estimates.stretch) * factor
        else:
            errors = np.zeros(len(members))
        errors[0] = 0.0
        order = np.lexsort((errors, seconds))
        ways = tuple(
            Way(_named(names, 1.0 - members[at]), float(seconds[at]), float(errors[at]))
            for at in _front(errors, order)
        )
        return cls(estimates, frozenset(names), float(seconds[0]), ways)

    def error_of(self, way: Way) -> float:
        """Return the least tolerance at which a set may be simulated.

        Its effects' changes may add up otherwise than their sum, and are tried together.
        """
        return max(self.estimates.error_of(self.names - way.effects), way.error / _FARTHEST)

    def chosen(self, tolerance: float) -> tuple[Way, float]:
        """Return the fastest set within a tolerance, and its error."""
        fastest = self.ways[0]
        if tolerance == math.inf:
            return Way(frozenset(), fastest.seconds, math.inf), math.inf
        for way in self.ways if tolerance else ():
            if way.error <= tolerance * _FARTHEST:
                error = self.error_of(way)
                if error <= tolerance:
                    return way, error
        return Way(self.names, self.everything, 0.0), 0.0


@lru_cache(maxsize=16)
def _subsets(count: int) -> FloatArray:
    """Return all sets of some things, shape (2^count, count): 1 where a set has one."""
    number = np.arange(2**count)[:, None]
    return ((number >> np.arange(count)) & 1).astype(np.float64)


def _named(names: list[str], members: FloatArray) -> frozenset[str]:
    return frozenset(name for name, there in zip(names, members.tolist(), strict=True) if there)


def _front(errors: FloatArray, order: IndexArray) -> list[int]:
    """Return the sets that no other is both faster and closer than, the fastest first."""
    falling = errors[order]
    least = np.minimum.accumulate(falling)
    first = np.append(True, falling[1:] < least[:-1])
    return [int(place) for place in order[first]]


def _decide(
    effect: Effect, estimates: _Estimates, left_out: frozenset[str], settings: SimulationSettings
) -> Decision:
    estimate = estimates.sizes.get(effect.name, 0.0)
    by_hand = settings.force.get(effect.name)
    included = bool(estimate) and effect.name not in left_out if by_hand is None else by_hand
    unit = "of the margin" if settings.observable == "decision" else "levels"
    decided = _decided if estimate else _decided_of_nothing
    is_known = estimates.seen is not None
    return decided(effect, estimate, included, settings.tolerance, by_hand, unit, is_known)


def _decided(  # noqa: PLR0917 - what a sentence tells
    effect: Effect,
    estimate: float,
    included: bool,
    tolerance: float,
    by_hand: bool | None,
    unit: str,
    is_known: bool,
) -> Decision:
    size = f"about {estimate:.2g} {unit}" if estimate else "none in this scene"
    verdict = "taken in" if included else "left out"
    if by_hand is not None:
        why = f"switched {'on' if included else 'off'} by hand"
        reason = f"{size}: {why}"
    elif not estimate:
        why = size
        reason = f"{size}: {verdict}"
    else:
        why = _comparison(estimate, tolerance, included, is_known)
        limit = "" if tolerance == math.inf else f", tolerance {tolerance:g}"
        together = ", " + why if included and estimate <= tolerance else ""
        reason = f"{size}{limit}{together}: {verdict}"
    return Decision(
        effect=effect.name,
        label=effect.label,
        kind=effect.kind,
        stage=effect.stage,
        estimate=estimate,
        included=included,
        forced=by_hand is not None,
        why=why,
        reason=reason,
    )


_decided_of_nothing = lru_cache(maxsize=256)(_decided)
"""The same for effects that a scene does not have, most of them: their sentences are few."""


def _comparison(estimate: float, tolerance: float, included: bool, is_known: bool) -> str:
    if tolerance == math.inf:
        return "no tolerance is set"
    if not included:
        return "within the tolerance"
    if estimate > tolerance:
        return "above the tolerance"
    if not is_known:
        return "not known, as the stripes span less than a grey level"
    return "leaving out others saves more time"
