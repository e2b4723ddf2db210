"""Scenes as a user asks for them: by preset, from a file, and by ``name=value``."""

import argparse
from collections.abc import Iterable
from pathlib import Path

from occ_model.effects.registry import NAMES
from occ_model.errors import OutputError, ParameterError, SceneFileError, one_line, shown
from occ_model.files.reading import read_text
from occ_model.files.writing import write_whole
from occ_model.scene.argument_checks import check_choice, check_seed
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import parameter_named
from occ_model.scene.presets import load_preset
from occ_model.scene.scene import Scene
from occ_model.scene.scene_inside import ENDINGS, SCENE_ENDING, scene_inside
from occ_model.scene.simulation_settings import (
    NOISE_SOURCES,
    OBSERVABLES,
    TOLERANCE,
    SimulationSettings,
)

DEFAULT_PRESET = "phone-68us"
"""The scene where none is asked for: one that all models and decoders have an answer to."""


def read_scene_file(path: Path) -> Scene:
    """Read a scene file, or the scene inside a figure or table that was exported.

    Raises
    ------
    SceneFileError
        It cannot be read, or is no scene file.
    ParameterError
        A value in it is not of its kind or out of range.
    """
    if path.suffix.lower() in ENDINGS:
        return scene_inside(path)
    text = read_text(path)
    try:
        return Scene.from_toml(text)
    except SceneFileError as error:
        raise SceneFileError(f"{one_line(str(path))} cannot be read. {error}") from None


def check_scene_path(path: Path) -> None:
    """Refuse to save a scene where it would not be opened again.

    Other endings mean figures, tables and photos, to whoever opens a file.

    Raises
    ------
    OutputError
        The file's ending is not that of scenes.
    """
    if path.suffix.lower() != SCENE_ENDING:
        raise OutputError(
            f"{one_line(str(path))} has no ending of a scene file; use {SCENE_ENDING}."
        )


def write_scene_file(path: Path, scene: Scene) -> None:
    """Write a scene so that :func:`read_scene_file` reads it.

    Raises
    ------
    OutputError
        The file's ending is not that of scenes, or it cannot be written.
    """
    check_scene_path(path)
    write_whole(path, scene.to_toml().encode("utf-8"))


def with_settings(scene: Scene, settings: Iterable[str]) -> Scene:
    """Change a scene by texts such as ``"switching_frequency=10kHz"``.

    Raises
    ------
    ParameterError
        A text has no ``=``, its name is unknown, or its value cannot be read or is out of range.
    """
    changes: dict[str, ParameterValue] = {}
    for setting in settings:
        name, equals, text = setting.partition("=")
        if not equals:
            raise ParameterError(f"{shown(setting)} is no setting; write NAME=VALUE.")
        changes[name.strip()] = parameter_named(name.strip()).parse(text)
    return scene.replace(**changes)


def add_scene_options(parser: argparse.ArgumentParser) -> None:
    """Let a command line say which scene is meant; :func:`scene_of` reads it."""
    start = parser.add_mutually_exclusive_group()
    start.add_argument("--preset", default=DEFAULT_PRESET, help="default: %(default)s")
    start.add_argument("--scene", type=Path, metavar="FILE", help="a scene file instead")
    parser.add_argument(
        "--set",
        dest="settings",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="change a parameter, such as switching_frequency=10kHz; may be repeated",
    )


def scene_of(options: argparse.Namespace) -> Scene:
    """Make the scene that a command line asks for.

    Raises
    ------
    OccError
        There is no such preset, file or parameter, or a value is out of range.
    """
    scene = read_scene_file(options.scene) if options.scene else load_preset(options.preset)
    return with_settings(scene, options.settings)


def add_plan_options(parser: argparse.ArgumentParser) -> None:
    """Let a command line say which effects are simulated."""
    own = SimulationSettings()
    parser.add_argument(
        "--tolerance",
        type=float,
        default=own.tolerance,
        metavar="LEVELS",
        help="what effects left out may change, in levels of the stretched profile; "
        "0: simulate all, inf: none; default: %(default)s",
    )
    parser.add_argument(
        "--observable",
        choices=OBSERVABLES,
        default=own.observable,
        help="what the tolerance is of; default: %(default)s",
    )
    for switch, meaning in (("on", "simulate an effect"), ("off", "leave an effect out")):
        parser.add_argument(
            f"--{switch}",
            action="append",
            default=[],
            metavar="EFFECT",
            help=f"{meaning} whatever its bound, one of {', '.join(NAMES)}; may be repeated",
        )


def add_noise_options(parser: argparse.ArgumentParser) -> None:
    """Let a command line say where noise comes from."""
    own = SimulationSettings()
    parser.add_argument(
        "--noise",
        choices=NOISE_SOURCES,
        default=own.noise,
        help="exact: drawn for each pixel; reused: many times faster; default: %(default)s",
    )
    parser.add_argument("--seed", type=int, default=own.seed, help="default: %(default)s")


def add_simulation_options(parser: argparse.ArgumentParser) -> None:
    """Let a command line say how a scene is simulated; :func:`simulation_settings_of` reads it."""
    add_plan_options(parser)
    add_noise_options(parser)


def simulation_settings_of(options: argparse.Namespace) -> SimulationSettings:
    """Read how a scene is to be simulated.

    Raises
    ------
    ParameterError
        There is no such effect, one is switched both on and off, or the tolerance or the seed
        cannot be.
    """
    TOLERANCE.check(options.tolerance)
    check_seed(options.seed)
    for name in (*options.on, *options.off):
        check_choice("effect", name, NAMES)
    for name in set(options.on) & set(options.off):
        raise ParameterError(
            f"effect {shown(name)} is switched both on and off; allowed: one of them."
        )
    return SimulationSettings(
        tolerance=options.tolerance,
        observable=options.observable,
        force={**dict.fromkeys(options.on, True), **dict.fromkeys(options.off, False)},
        noise=options.noise,
        seed=options.seed,
    )
