"""Predict the time and the error of a simulation with other settings, from measured parts."""

import numpy as np

from occ_model.effects.plan import plan_with
from occ_model.results import Forecast, MeasuredCosts, Plan
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.effect_differences import rms


def forecast(scene: Scene, settings: SimulationSettings, costs: MeasuredCosts) -> Forecast:
    """Predict a simulation.

    Parameters
    ----------
    scene, settings
        The scene and the settings that the simulation would have.
    costs
        What has been measured of the scene.

    Raises
    ------
    ParameterError
        A setting is not allowed.
    ProjectionError
        Part of the panel is behind the camera.
    """
    chosen = plan_with(scene, settings)
    seconds = _seconds(chosen, costs)
    present = frozenset(d.effect for d in chosen.decisions if d.estimate)
    included = present & frozenset(chosen.included)
    if included == present or included in costs.errors:
        return Forecast(chosen, seconds, costs.errors.get(included, 0.0), is_measured=True)
    left_out = sorted(present - included)
    error = None
    if all(name in costs.differences for name in left_out):
        error = rms(np.sum([costs.differences[name].change for name in left_out], axis=0))
    return Forecast(chosen, seconds, error, is_measured=False)


def _seconds(chosen: Plan, costs: MeasuredCosts) -> float | None:
    """Add up the times of the plan's effects and of everything else, as each was last measured."""
    rows_differ = not chosen.kinds <= {"column"}
    measured = (costs.picture, *costs.others)
    rest = [shares for shares in measured if shares.rows_differ == rows_differ]
    if not rest:
        return None
    total = rest[0].everything_else
    counted: set[str] = set()
    for name in chosen.included:
        seconds = costs.seconds_of(name)
        if seconds is None:
            return None
        together = (shares.together.get(name) for shares in measured)
        group = next((own for own in together if own is not None), name)
        if group not in counted:
            counted.add(group)
            total += seconds
    return total
