"""Predict the time and the error of a simulation with other settings, from measured parts."""

from functools import lru_cache

import numpy as np

from occ_model.effects.plan import plan_with, ways_of
from occ_model.effects.registry import EFFECTS
from occ_model.results.effect_costs import Forecast, MeasuredCosts
from occ_model.results.plan import Way
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import NoiseSource, Observable, SimulationSettings
from occ_model.study.effect_differences import rms


def forecast(scene: Scene, settings: SimulationSettings, costs: MeasuredCosts) -> Forecast:
    """Predict a simulation."""
    chosen = plan_with(scene, settings)
    seconds = _seconds(chosen.included, costs)
    force = tuple(sorted(settings.force.items()))
    ways = _known_ways(scene, settings.observable, force, settings.noise)
    forced = frozenset(name for name, on in force if on)
    times = tuple(_seconds(tuple(way.effects | forced), costs) for way in ways)
    present = frozenset(d.effect for d in chosen.decisions if d.estimate)
    included = present & frozenset(chosen.included)
    if included == present or included in costs.errors:
        error = costs.errors.get(included, 0.0)
        return Forecast(chosen, seconds, error, True, ways, times)
    left_out = sorted(present - included)
    expected = None
    if all(name in costs.differences for name in left_out):
        expected = rms(np.sum([costs.differences[name].change for name in left_out], axis=0))
    return Forecast(chosen, seconds, expected, False, ways, times)


@lru_cache(maxsize=4)
def _known_ways(
    scene: Scene, observable: Observable, force: tuple[tuple[str, bool], ...], noise: NoiseSource
) -> tuple[Way, ...]:
    """Return what a plan chooses among, which does not depend on the tolerance."""
    return ways_of(scene, SimulationSettings(observable=observable, force=dict(force), noise=noise))


def _seconds(included: tuple[str, ...], costs: MeasuredCosts) -> float | None:
    """Add up the times of effects and of everything else, as each was last measured."""
    rows_differ = any(effect.name in included and effect.kind != "column" for effect in EFFECTS)
    measured = (costs.picture, *costs.others)
    rest = [shares for shares in measured if shares.rows_differ == rows_differ]
    if not rest:
        return None
    total = rest[0].everything_else
    counted: set[str] = set()
    for name in included:
        seconds = costs.seconds_of(name)
        if seconds is None:
            return None
        together = (shares.together.get(name) for shares in measured)
        group = next((own for own in together if own is not None), name)
        if group not in counted:
            counted.add(group)
            total += seconds
    return total
