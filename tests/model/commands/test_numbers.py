"""Numbers in options are read as in settings: a comma is a decimal comma, or refused."""

import argparse
import math

import pytest

from occ_model.cli import main
from occ_model.commands.command_line import read_command_line
from occ_model.commands.options import number, simulation_settings_of, whole_number


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
def test_what_is_no_number_or_two_is_refused_with_a_sentence(
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
