"""The plan: which effects are simulated for a scene, at a tolerance."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

from occ_model.camera.photometry import WHITE
from occ_model.effects.effect import ROUNDING, Effect, FileEffect
from occ_model.effects.noise_bound import NoiseBounds
from occ_model.effects.paper_view import PaperView, paper_view_of
from occ_model.effects.registry import EFFECTS, FILES, NAMES, NOISES, OTHERS, moves_light
from occ_model.effects.signal_bound import SignalView, signal_view
from occ_model.results import Decision, Plan
from occ_model.scene.scene import Scene, check_scene
from occ_model.scene.simulation_settings import TOLERANCE, Observable, SimulationSettings

_DITHERING = 0.5
"""Grey levels of noise that spread a pixel over the steps of rounding (dithering)."""


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
    The swing is that of the profile, and for the signal that of the enhanced profile.

    A file's rounding turns small changes into steps. With a file in the plan, each bound is that of
    the change after the file.

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
        enhancement, which is what a decoder reads.
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
    left_out = {d.effect for d in chosen.decisions if d.bound and not (d.included or d.forced)}
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
        Checked; the seed and the source of noise are not used.
    """
    tolerance, forced, observable = settings.tolerance, settings.force, settings.observable
    noise = _noise_bounds(view)
    signal = signal_view(view) if observable == "signal" else None
    stretch = WHITE / (view.swing if signal is None else signal.swing)
    bounds = _bounds(view, noise, signal, observable, stretch)
    if tolerance == math.inf:  # even an infinite bound is within it
        left_out, spent, file = set(NAMES), 0.0, None
    else:
        left_out, spent = _leave_out(bounds, forced, tolerance)
        file = _file_in(left_out, bounds, forced)
        if file is not None and (signal is None or not signal.is_enhanced):
            # A file is made of pixels, whatever is observed of it later.
            pixels = bounds
            if observable != "image":
                pixels = _bounds(view, noise, None, "image", stretch)
            dithers = _noise_that_dithers(pixels, forced, stretch)
            through = _ThroughFile(file, view, stretch, bool(dithers))
            kept = {**forced, **dict.fromkeys(dithers, True)}
            left_out, spent = _leave_out(pixels, kept, tolerance, through)
            bounds = {
                name: bound if name == file.name else through(bound)
                for name, bound in pixels.items()
            }
    decisions = tuple(
        _decide(effect, bounds[effect.name], left_out, tolerance, forced, file)
        for effect in EFFECTS
    )
    return Plan(tolerance, observable, decisions, spent, stretch)


def _noise_bounds(view: PaperView) -> NoiseBounds:
    noises = tuple(effect for effect in NOISES if effect.is_present(view.scene))
    return NoiseBounds(noises, view, moves_light=moves_light(view.scene))


def _bounds(
    view: PaperView,
    noise: NoiseBounds,
    signal: SignalView | None,
    observable: Observable,
    stretch: float,
) -> dict[str, float]:
    """Return every effect's bound in levels of the stretched profile, by name."""
    if signal is not None and signal.is_enhanced:
        found = _enhanced_bounds(view, noise, signal)
    else:
        found = _plain_bounds(view, noise, "profile" if observable == "signal" else observable)
        if observable == "signal":
            found = {name: min(bound + ROUNDING, WHITE) for name, bound in found.items() if bound}
    return {name: found.get(name, 0.0) * stretch for name in NAMES}


def _plain_bounds(view: PaperView, noise: NoiseBounds, observable: Observable) -> dict[str, float]:
    """Return the bounds of the effects in the image or the profile, in grey levels, by name."""
    of_noise = noise.bounds(observable)
    others = {effect.name: float(effect.bound(view, observable)) for effect in OTHERS}
    if any(of_noise.values()) and any(others.values()):
        factor = noise.amplification(observable)
        others = {name: bound * factor for name, bound in others.items()}
    return {**others, **of_noise}


def _enhanced_bounds(view: PaperView, noise: NoiseBounds, signal: SignalView) -> dict[str, float]:
    """Return the bounds of the effects in an enhanced signal, in its levels, by name.

    Noise passes the enhancement as a whole: each of its effects has the bound of them all.
    """
    found = {effect.name: effect.bound(view, "signal") for effect in EFFECTS}
    if not any(found[effect.name] for effect in OTHERS):
        of_noise = signal.noise_bound(noise.largest_spread)
        found = {name: min(bound, of_noise) for name, bound in found.items()}
    return found


@dataclass(frozen=True, slots=True)
class _ThroughFile:
    """What a file makes of a change, both in levels of the stretched profile."""

    file: FileEffect
    view: PaperView
    stretch: float
    dithered: bool

    def __call__(self, change: float) -> float:
        if not change:
            return 0.0
        levels = change / self.stretch
        return self.file.propagated_change(self.view, levels, self.dithered) * self.stretch


def _noise_that_dithers(
    bounds: Mapping[str, float], forced: Mapping[str, bool], stretch: float
) -> tuple[str, ...]:
    """Return the noise that dithers: it is always simulated with a file."""
    names = (effect.name for effect in NOISES)
    return tuple(
        name for name in names if forced.get(name, True) and bounds[name] >= _DITHERING * stretch
    )


def _file_in(
    left_out: set[str], bounds: Mapping[str, float], forced: Mapping[str, bool]
) -> FileEffect | None:
    """Return the file that the picture is kept in, None where it is left out or there is none."""
    for effect in FILES:
        name = effect.name
        if bounds[name] and name not in left_out:
            return effect if forced.get(name, True) else None
    return None


def _leave_out(
    bounds: Mapping[str, float],
    forced: Mapping[str, bool],
    tolerance: float,
    through: Callable[[float], float] = float,
) -> tuple[set[str], float]:
    """Leave out the smallest bounds first, as long as their sum is within the tolerance.

    Returns
    -------
    left_out
        The names of effects.
    spent
        The most that they can change together, after the file.
    """
    total, spent, left_out = 0.0, 0.0, set()
    for name in sorted((name for name in NAMES if name not in forced), key=bounds.__getitem__):
        total += bounds[name]
        if through(total) > tolerance:
            break
        spent = through(total)
        left_out.add(name)
    return left_out, spent


def _decide(
    effect: Effect,
    bound: float,
    left_out: set[str],
    tolerance: float,
    forced: Mapping[str, bool],
    file: FileEffect | None,
) -> Decision:
    by_hand = forced.get(effect.name)
    included = effect.name not in left_out if by_hand is None else by_hand
    decided = _decided if bound else _decided_of_nothing
    return decided(effect, bound, included, tolerance, by_hand, file)


def _decided(
    effect: Effect,
    bound: float,
    included: bool,
    tolerance: float,
    by_hand: bool | None,
    file: FileEffect | None,
) -> Decision:
    size = f"at most {bound:.2g} levels" if bound else "none in this scene"
    if bound and file is not None and file is not effect:
        size += f" through {file.label}"
    verdict = "taken in" if included else "left out"
    if by_hand is not None:
        why = f"switched {'on' if included else 'off'} by hand"
        reason = f"{size}: {why}"
    elif not bound:
        why = size
        reason = f"{size}: {verdict}"
    else:
        why = _comparison(bound, tolerance, included)
        limit = "" if tolerance == math.inf else f", tolerance {tolerance:g}"
        together = ", " + why if included and bound <= tolerance else ""
        reason = f"{size}{limit}{together}: {verdict}"
    return Decision(
        effect=effect.name,
        label=effect.label,
        kind=effect.kind,
        stage=effect.stage,
        bound=bound,
        included=included,
        forced=by_hand is not None,
        why=why,
        reason=reason,
    )


_decided_of_nothing = lru_cache(maxsize=256)(_decided)
"""The same for effects that a scene does not have, most of them: their sentences are few."""


def _comparison(bound: float, tolerance: float, included: bool) -> str:
    if tolerance == math.inf:
        return "no tolerance is set"
    if not included:
        return "within the tolerance"
    if bound > tolerance:
        return "above the tolerance"
    return "exceeded together with what is left out"
