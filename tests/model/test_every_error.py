"""Each wrong value of a parameter ends a command with one sentence."""

import math
from collections.abc import Iterator
from functools import cache

import pytest
from every_error import (
    WRONG,
    check_sentence,
    wrong_texts,
)
from model.plugins.installed_package import forget_plugins

import occ_model as occ
from occ_model.cli import main
from occ_model.commands import command_line
from occ_model.program import EXIT_MISUSE
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS


@pytest.fixture
def ended_with(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[BaseException]]:
    """Yield what the commands raise from now on; one parser serves them all."""
    raised: list[BaseException] = []
    run = command_line.run_command

    def note(options: object) -> int:
        try:
            return run(options)  # type: ignore[arg-type]
        except BaseException as error:
            raised.append(error)
            raise

    monkeypatch.setattr(command_line, "run_command", note)
    monkeypatch.setattr(command_line, "make_parser", cache(command_line.make_parser))
    yield raised
    forget_plugins()


def test_every_wrong_value_is_named_with_its_unit_and_range(
    ended_with: list[BaseException], capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in WRONG:
        assert main(["plan", "--set", f"{name}={text}"]) == EXIT_MISUSE, (name, text)
        out, err = capsys.readouterr()
        assert out == ""
        assert type(ended_with[-1]) is occ.ParameterError
        prefix, _, sentence = err.rstrip("\n").partition(": ")
        assert prefix == "occ-model"
        check_sentence(sentence, PARAMETERS[name], text, f"{name} is ")


@pytest.mark.parametrize("text", wrong_texts(PARAMETERS["lamp_frequency"]))
def test_a_wrong_frequency_of_the_lamp_is_named_as_it_was_given(
    text: str, ended_with: list[BaseException]
) -> None:
    main(["match", "photo.png", "--led-frequency", text])
    check_sentence(str(ended_with[0]), PARAMETERS["lamp_frequency"], text, "--led-frequency is ")


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_number_that_is_not_finite_is_named_with_its_unit_and_range(value: float) -> None:
    for name, declared in PARAMETERS.items():
        if isinstance(declared, Quantity) and declared.high != value:
            with pytest.raises(occ.ParameterError) as refusal:
                occ.Scene().replace(**{name: value})
            unit = declared.format(value).removeprefix(str(value))
            assert str(refusal.value) == f"{name} is {value}{unit}; allowed: {declared.allowed}."
