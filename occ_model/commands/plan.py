"""The command ``occ-model plan``: list the effects that a scene needs, and their changes."""

import argparse

from occ_model.commands.options import (
    Commands,
    add_plan_options,
    add_scene_options,
    scene_of,
    simulation_settings_of,
)
from occ_model.effects.plan import plan_with
from occ_model.scene.simulation_settings import SimulationSettings


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("plan", help="list the effects that a scene needs, and why")
    add_scene_options(parser)
    add_plan_options(parser)
    own = SimulationSettings()
    parser.set_defaults(command=_run, noise=own.noise, seed=own.seed)


def _run(options: argparse.Namespace) -> int:
    scene, settings = scene_of(options), simulation_settings_of(options)
    print(plan_with(scene, settings))
    return 0
