"""Predict the time and the error of a simulation with other settings, from measured parts."""

from collections.abc import Mapping

import numpy as np

from occ_model.effects.plan import plan_with
from occ_model.results import EffectDifference, Forecast, Plan, TimeShares
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.effect_differences import rms


def forecast(
    scene: Scene,
    settings: SimulationSettings,
    measured: TimeShares,
    complete: TimeShares | None,
    bare: TimeShares | None,
    differences: Mapping[str, EffectDifference],
) -> Forecast:
    """Predict a simulation.

    Parameters
    ----------
    scene, settings
        The scene and the settings that the simulation would have.
    measured
        The times of the last picture of the scene.
    complete, bare
        The times of a picture with all effects and of one with none, None where not measured yet:
        the first gives the times of effects that the last picture leaves out, the second that of
        everything else where no effect makes rows differ.
    differences
        What each effect changes, by its name, as far as measured.

    Raises
    ------
    ParameterError
        A setting is not allowed.
    ProjectionError
        Part of the panel is behind the camera.
    """
    chosen = plan_with(scene, settings)
    present = [d.effect for d in chosen.decisions if d.bound]
    left_out = [name for name in present if name not in chosen]
    return Forecast(
        chosen,
        _seconds(chosen, measured, complete, bare),
        _error([differences.get(name) for name in left_out]),
    )


def _error(left_out: list[EffectDifference | None]) -> float | None:
    changes = [difference.change for difference in left_out if difference is not None]
    if len(changes) < len(left_out):
        return None
    return rms(np.sum(changes, axis=0)) if changes else 0.0


def _seconds(
    chosen: Plan, measured: TimeShares, complete: TimeShares | None, bare: TimeShares | None
) -> float | None:
    """Add up the times of the plan's effects and of everything else, as each was last measured."""
    rows_differ = not chosen.kinds <= {"column"}
    known = [shares for shares in (measured, complete, bare) if shares is not None]
    rest = [shares for shares in known if shares.rows_differ == rows_differ]
    if not rest:
        return None
    total = rest[0].everything_else
    counted: set[str] = set()
    for name in chosen.included:
        found = next((s for s in known if name in s.effects or name in s.together), None)
        if found is None:
            return None
        own = found.together.get(name, name)
        if own not in counted:
            counted.add(own)
            total += found.effects[own]
    return total
