"""A command without options does what the function that it calls does without arguments."""

import argparse
import inspect
from collections.abc import Callable

import pytest

import occ_model as occ
from occ_model.commands import limits, most_bits, sweep

NAMES = {"pictures": "pictures", "images": "images", "seed": "seed", "rate": "rate",
         "fps": "frames_a_second"}  # fmt: skip


@pytest.mark.parametrize(
    ("module", "function"), [(sweep, occ.sweep), (limits, occ.limits), (most_bits, occ.most_bits)]
)
def test_defaults_of_a_command_are_those_of_its_function(
    module: object, function: Callable[..., object]
) -> None:
    commands = argparse.ArgumentParser().add_subparsers()
    module.add_to(commands)  # type: ignore[attr-defined]
    (parser,) = commands.choices.values()
    declared = inspect.signature(function).parameters
    given = {name: parser.get_default(option) for option, name in NAMES.items()}
    compared = {
        name: (value, declared[name].default)
        for name, value in given.items()
        if value is not None and name in declared
    }
    assert len(compared) >= 2
    assert all(value == own for value, own in compared.values()), compared
