"""The commands ``occ-model presets`` and ``occ-model parameters``: list what can be set."""

import argparse

from occ_model.commands.options import Commands
from occ_model.errors import one_line
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import all_presets, preset_named, unreadable_presets

_MAX_NOTE_CHARACTERS = 1000  # maximum printed length of a value's note


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("presets", help="list the presets, or one with its sources")
    parser.add_argument("name", nargs="?", help="the preset to show whole")
    parser.set_defaults(command=_presets)
    parser = commands.add_parser("parameters", help="list what --set can set")
    parser.add_argument("--markdown", action="store_true", help="as a table")
    parser.set_defaults(command=_parameters)


def _presets(options: argparse.Namespace) -> int:
    if options.name is None:
        for preset in all_presets():
            print(f"{preset.name:20}{one_line(preset.title)}")
        for name, reason in unreadable_presets().items():
            print(f"{name:20}cannot be used: {reason}")
        return 0
    preset = preset_named(options.name)
    print(one_line(preset.title))
    for name, declaration in PARAMETERS.items():
        value = declaration.format(preset.scene.value(name))  # type: ignore[arg-type]
        note = preset.sources.get(name, "")
        if name in preset.assumed:
            note = f"assumed: {preset.assumed[name]}"
        print(f"{name:26}{value:23} {one_line(note, _MAX_NOTE_CHARACTERS)}".rstrip())
    return 0


def _parameters(options: argparse.Namespace) -> int:
    if options.markdown:
        print(parameter_table())
        return 0
    for name, declaration in PARAMETERS.items():
        print(f"{name:26}{declaration.meaning}")
        print(f"{'':26}allowed: {declaration.allowed}")
    return 0


def parameter_table() -> str:
    """Write all parameters as a Markdown table: name, symbol, meaning, default and range."""
    lines = ["| name | symbol | meaning | default | allowed |", "|---|---|---|---|---|"]
    for name, declaration in PARAMETERS.items():
        default = declaration.format(declaration.default)  # type: ignore[arg-type]
        cells = (f"`{name}`", declaration.symbol, declaration.meaning, default, declaration.allowed)
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)
