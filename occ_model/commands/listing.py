"""The commands ``codes``, ``presets`` and ``parameters`` of ``occ-model``, which list these."""

import argparse
from collections.abc import Callable, Iterable, Sequence

from occ_model.commands.options import Commands
from occ_model.errors import OccError, one_line
from occ_model.receiver.decode import decoder_named, decoders
from occ_model.receiver.decoder import Decoder
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import preset_named, read_presets
from occ_model.scene.units import HERTZ
from occ_model.transmitter.framings.framing import Framing
from occ_model.transmitter.line_codes.line_code import LineCode
from occ_model.transmitter.registry import FRAMINGS, LINE_CODES
from occ_model.transmitter.scheme import Scheme

_MAX_NOTE_CHARACTERS = 1000  # characters of a value's note


def add_to(commands: Commands) -> None:
    parser = commands.add_parser("codes", help="list line codes, framings and decoders")
    parser.add_argument("--markdown", action="store_true", help="as tables")
    parser.set_defaults(command=_print_codes)
    parser = commands.add_parser("presets", help="list the presets, or one with its sources")
    parser.add_argument("name", nargs="?", help="the preset to show in full")
    parser.set_defaults(command=_print_presets)
    parser = commands.add_parser("parameters", help="list the parameters that --set can set")
    parser.add_argument("--markdown", action="store_true", help="as a table")
    parser.set_defaults(command=_print_parameters)


def _print_presets(options: argparse.Namespace) -> int:
    if options.name is None:
        loaded = read_presets()
        for preset in loaded.every:
            print(f"{preset.name:20}{one_line(preset.title)}")
        for name, reason in loaded.problems.items():
            print(f"{name:20}cannot be used: {reason}")
        return 0
    preset = preset_named(options.name)
    print(one_line(preset.title))
    for name, declaration in PARAMETERS.items():
        if not declaration.is_of(preset.scene.transmitter.light):
            continue
        value = declaration.format(preset.scene.value(name))  # type: ignore[arg-type]
        note = preset.sources.get(name, "")
        if name in preset.assumed:
            note = f"assumed: {preset.assumed[name]}"
        print(f"{name:26}{value:23} {one_line(note, _MAX_NOTE_CHARACTERS)}".rstrip())
    return 0


def _print_parameters(options: argparse.Namespace) -> int:
    if options.markdown:
        print(parameter_table())
        return 0
    for name, declaration in PARAMETERS.items():
        print(f"{name:26}{declaration.meaning}")
        print(f"{'':26}allowed: {declaration.allowed}")
        if declaration.lights:
            print(f"{'':26}light: {', '.join(declaration.lights)}")
    return 0


def _markdown_table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [f"| {' | '.join(heads)} |", f"|{'---|' * len(heads)}"]
    return "\n".join([*lines, *(f"| {' | '.join(cells)} |" for cells in rows)])


def parameter_table() -> str:
    """Write all parameters as a Markdown table: name and symbol, meaning, default and range."""
    rows = []
    for name, declaration in PARAMETERS.items():
        symbol = f", {declaration.symbol}" if declaration.symbol else ""
        default = declaration.format(declaration.default)  # type: ignore[arg-type]
        allowed = declaration.allowed.replace("a whole number from", "whole,")
        rows.append((f"`{name}`{symbol}", declaration.meaning, default, allowed))
    return _markdown_table(("name", "meaning", "default", "allowed"), rows)


_EXAMPLE = ("manchester", 10)  # line code and bits for which the lengths of frames are compared


def _print_codes(options: argparse.Namespace) -> int:
    if options.markdown:
        print(line_code_table())
        print()
        print(framing_table())
        return 0
    print("line codes")
    for name in LINE_CODES.names():
        print(f"  {name:26}{_title_of(LINE_CODES.get, name)}")
    print("framings")
    for name in FRAMINGS.names():
        print(f"  {name:26}{_title_of(FRAMINGS.get, name)}")
    print("decoders")
    for name in decoders():
        print(f"  {name:26}{_title_of(decoder_named, name)}")
    return 0


def _title_of(find: Callable[[str], LineCode | Framing | Decoder], name: str) -> str:
    """Return the title of a code or decoder, or why it cannot be used."""
    try:
        return find(name).title
    except OccError as error:
        return str(error)


def line_code_table() -> str:
    """Write the declared properties of the built-in line codes as a Markdown table."""
    heads = (
        "line code", "chips a bit", "without a bit", "longest run, chips", "ones and zeros",
        "slowest wave", "its flicker unseen from", "one wrong chip",
    )  # fmt: skip
    return _markdown_table(heads, map(_line_code_cells, LINE_CODES.load_built_in().values()))


def _line_code_cells(code: LineCode) -> tuple[str, ...]:
    least = code.least_switching_frequency
    return (
        f"`{code.name}`",
        f"{float(code.chips_a_bit):g}",
        f"{100 * float(code.overhead):.0f} %",
        "no limit" if code.longest_run is None else str(code.longest_run),
        _balance_text(code),
        "no limit" if code.longest_run is None else f"f / {2 * code.longest_run}",
        "no frequency" if least is None else HERTZ.format(least),
        "found or harmless" if code.finds_wrong_chip else "may pass",
    )


def _balance_text(code: LineCode) -> str:
    if code.disparity is None:
        return "any"
    return f"differ by up to {code.disparity}" if code.disparity else "as many"


def framing_table() -> str:
    """Write the properties of the built-in framings as a Markdown table."""
    name, bits = _EXAMPLE
    heads = ("framing", "a frame", f"chips for {bits} bits, `{name}`", "checks the payload")
    return _markdown_table(heads, map(_framing_cells, FRAMINGS.load_built_in().values()))


def _framing_cells(framing: Framing) -> tuple[str, ...]:
    name, bits = _EXAMPLE
    scheme = Scheme(LINE_CODES.get(name), framing, "", "none", bits)
    checks = "yes" if framing.checks else "no"
    return f"`{framing.name}`", framing.title, str(scheme.length), checks
