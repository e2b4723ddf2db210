"""Common options of commands (scene, simulated effects, files of studies), and their parser."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, NoReturn, TypeAlias

from occ_model.effects.registry import NAMES
from occ_model.errors import ParameterError, one_line, quote
from occ_model.receiver.decode import DECODERS, decoders
from occ_model.scene.colour_scenes import EFFECTS_OFF, check_monochrome
from occ_model.scene.from_text import DEFAULT_PRESET, change_scene, read_scene_file
from occ_model.scene.parameters import parameter_named
from occ_model.scene.parameters.colour import COLOURS
from occ_model.scene.presets import load_preset
from occ_model.scene.scene import (
    OBSERVABLES,
    Scene,
    SimulationSettings,
)
from occ_model.scene.units import NONE

if TYPE_CHECKING:  # argparse's class cannot be subscripted at run time
    Commands: TypeAlias = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands: TypeAlias = argparse._SubParsersAction


EFFECTS = (*NAMES, *EFFECTS_OFF)
"""Names of effects, with those of a colour camera's pictures and films."""

_MAX_MESSAGE_CHARACTERS = 1000  # all allowed values fit; longer input is cut


class Parser(argparse.ArgumentParser):
    """A parser that raises errors when it prints help, and whose messages are short."""

    def print_help(self, file: IO[str] | None = None) -> None:  # type: ignore[override]
        """Print the help, and raise errors, which argparse would ignore."""
        print(self.format_help(), end="", file=file or sys.stdout)

    def error(self, message: str) -> NoReturn:
        """Exit with the usage and a message of bounded length."""
        super().error(one_line(message, _MAX_MESSAGE_CHARACTERS))


def number(text: str) -> float:
    """Parse the number of an option, with a decimal point or comma, or ``inf``."""
    meanings = NONE.meanings(text)
    if len(meanings) > 1:
        comma, thousands = (NONE.format(value) for value in meanings)
        raise argparse.ArgumentTypeError(
            f"{quote(text)} means {comma} with a decimal comma and {thousands} with a comma "
            "between thousands; write it without that comma"
        )
    try:
        return meanings[0] if meanings else float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{quote(text)} is not a number") from None


def whole_number(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{quote(text)} is not a whole number") from None


def decoder_name(text: str) -> str:
    """Check the name of a decoder, without importing a plug-in."""
    if text not in DECODERS and text not in decoders():
        raise argparse.ArgumentTypeError(
            f"there is no decoder {quote(text)}; known: {', '.join(decoders())}"
        )
    return text


def add_option(
    parser: argparse._ActionsContainer,
    flag: str,
    default: float | str,
    meaning: str = "",
    **arguments: Any,
) -> None:
    """Add an option whose default is in its help, and sets its type."""
    kinds = {int: whole_number, float: number}
    if type(default) in kinds:  # a window checks whether a text is the default
        arguments["type"] = kinds[type(default)]
    default_text = "%(default)g" if isinstance(default, float) else "%(default)s"
    help_text = f"{meaning}; default: {default_text}" if meaning else f"default: {default_text}"
    parser.add_argument(flag, default=default, help=help_text, **arguments)


def add_scene_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that choose a scene; :func:`scene_of` reads them."""
    start = parser.add_mutually_exclusive_group()
    add_option(start, "--preset", DEFAULT_PRESET)
    start.add_argument(
        "--scene", type=Path, metavar="FILE", help="a scene file in place of a preset"
    )
    parser.add_argument(
        "--colour", choices=COLOURS,
        help="of a colour camera: only the LED and the pixels of this colour",
    )  # fmt: skip
    parser.add_argument(
        "--set",
        dest="settings",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="change a parameter, such as switching_frequency=10kHz, or light=lamp and duty=30%%; "
        "may be repeated",
    )


def scene_of(options: argparse.Namespace, *, may_have_colours: bool = False) -> Scene:
    """Return the chosen scene, or one colour of it; only some commands work for all three."""
    scene = read_scene_file(options.scene) if options.scene else load_preset(options.preset)
    new_scene = change_scene(scene, options.settings)
    light = new_scene.transmitter.light
    for setting in options.settings:
        declared = parameter_named(setting.partition("=")[0].strip())
        if not declared.is_of(light):
            lights = " or ".join(f"light={name}" for name in declared.lights)
            raise ParameterError(
                f"{declared.name} changes nothing in the light {light}; set {lights} as well.",
                parameters=(declared.name, "light"),
            )
    if options.colour:
        return new_scene.colour(options.colour)
    if not may_have_colours:
        check_monochrome(new_scene)
    return new_scene


def add_plan_options(parser: argparse.ArgumentParser, effects: Sequence[str] = NAMES) -> None:
    defaults = SimulationSettings()
    add_option(
        parser, "--tolerance", defaults.tolerance, "how much omitted effects may change, in levels "
        "of the stretched profile; 0: simulate all effects, inf: none", metavar="LEVELS",
    )  # fmt: skip
    add_option(
        parser,
        "--observable",
        defaults.observable,
        "the quantity of the tolerance",
        choices=OBSERVABLES,
    )
    add_switches(parser, effects)


def add_switches(parser: argparse.ArgumentParser, effects: Sequence[str] = NAMES) -> None:
    """Add the options that switch effects on or off, for :func:`forced_effects`."""
    for switch, meaning in (("on", "simulate an effect"), ("off", "leave an effect out")):
        parser.add_argument(
            f"--{switch}",
            action="append",
            default=[],
            metavar="EFFECT",
            help=f"{meaning} whatever its estimate, one of {', '.join(effects)}; may be repeated",
        )


def add_simulation_options(parser: argparse.ArgumentParser, effects: Sequence[str] = NAMES) -> None:
    add_plan_options(parser, effects)
    # An option of former versions, now ignored: noise is always drawn for every pixel.
    parser.add_argument("--noise", help=argparse.SUPPRESS)
    add_option(parser, "--seed", SimulationSettings().seed)


def simulation_settings_of(
    options: argparse.Namespace, effects: Sequence[str] = NAMES
) -> SimulationSettings:
    return SimulationSettings(
        options.tolerance, options.observable, forced_effects(options), seed=options.seed
    ).check(effects)


def forced_effects(options: argparse.Namespace) -> dict[str, bool]:
    """Return the effects that a command line switches on or off."""
    for name in set(options.on) & set(options.off):
        raise ParameterError(
            f"effect {quote(name)} is switched both on and off; allowed: one of them."
        )
    return {**dict.fromkeys(options.on, True), **dict.fromkeys(options.off, False)}


def is_stated(name: str, options: argparse.Namespace) -> bool:
    """Return whether the command line states a parameter, rather than a preset or a file."""
    names = {setting.partition("=")[0].strip() for setting in options.settings}
    return name in names or (name == "lamp_frequency" and options.led_frequency is not None)


def add_work_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for where a study runs, and where its results go."""
    add_option(parser, "--jobs", 1, "processes", metavar="N")
    parser.add_argument(
        "--out", type=Path, metavar="FILE.csv",
        help="file of results, point by point; if it has a part of them, only the rest is measured",
    )  # fmt: skip
    parser.epilog = (
        "If it is stopped, by Ctrl-C or otherwise, the results so far are in the file of --out; "
        "the same command continues from there."
    )
