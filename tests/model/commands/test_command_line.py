"""The parsers of all commands: their modules, their defaults, and numbers in options."""

import argparse
import inspect
import math
from collections.abc import Callable

import pytest

import occ_model as occ
from occ_model.cli import main
from occ_model.commands import limits, sweep
from occ_model.commands.command_line import commands_of, make_parser, read_command_line
from occ_model.commands.options import number, simulation_settings_of, whole_number


def test_without_such_a_command_all_are_listed() -> None:
    whole = make_parser()
    assert len(commands_of(whole)) > 15
    assert make_parser("no-command").format_help() == whole.format_help()


def test_a_command_s_parser_is_the_same_alone_and_among_all() -> None:
    for name, parser in commands_of(make_parser()).items():
        alone = commands_of(make_parser(name))
        assert len(alone) < 5, "others are imported with it"
        assert alone[name].format_help() == parser.format_help() != ""


NAMES = {"pictures": "pictures", "images": "images", "seed": "seed", "rate": "rate",
         "fps": "frames_a_second"}  # fmt: skip


@pytest.mark.parametrize(
    ("module", "name", "function"),
    [
        (sweep, "sweep", occ.sweep),
        (limits, "limits", occ.limits),
        (limits, "most-bits", occ.most_bits),
    ],
)
def test_defaults_of_a_command_are_those_of_its_function(
    module: object, name: str, function: Callable[..., object]
) -> None:
    commands = argparse.ArgumentParser().add_subparsers()
    module.add_to(commands)  # type: ignore[attr-defined]
    parser = commands.choices[name]
    declared = inspect.signature(function).parameters
    given = {name: parser.get_default(option) for option, name in NAMES.items()}
    compared = {
        name: (value, declared[name].default)
        for name, value in given.items()
        if value is not None and name in declared
    }
    assert len(compared) >= 2
    assert all(value == own for value, own in compared.values()), compared


@pytest.mark.parametrize(
    ("text", "value"),
    [("0.5", 0.5), ("0,5", 0.5), (",5", 0.5), ("12,5", 12.5), ("1e-3", 1e-3), ("inf", math.inf)],
)
def test_a_decimal_comma_is_read_like_a_point(text: str, value: float) -> None:
    assert number(text) == value
    options = read_command_line(["plan", "--tolerance", text])
    assert simulation_settings_of(options).tolerance == value


@pytest.mark.parametrize(
    ("text", "reason"),
    [("1,000", "means 1 with a decimal comma and 1000 with"), ("half", "is not a number")],
)
@pytest.mark.parametrize(
    "words",
    [
        ["plan", "--tolerance"],
        ["limits", "--rate"],
        ["sweep", "--vary", "distance=1", "--tolerance"],
    ],
)
def test_a_text_of_no_number_or_of_two_is_refused_with_a_sentence(
    words: list[str], text: str, reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([*words, text])
    assert ended.value.code == 2
    *_, last = capsys.readouterr().err.splitlines()
    assert f"error: argument {words[-1]}: '{text}' {reason}" in last


@pytest.mark.parametrize("text", ["1,5", "1,000", "1.5", "many", ""])
def test_a_count_is_a_whole_number_without_a_comma(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="is not a whole number"):
        whole_number(text)
    assert whole_number("20") == 20
