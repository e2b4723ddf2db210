"""Commands called in process, with what they print."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from occ_model.cli import main


class Outcome(NamedTuple):
    """The exit code and the output of a command."""

    code: int
    out: str
    err: str

    @property
    def lines(self) -> list[str]:
        return self.out.splitlines()


Command = Callable[..., Outcome]


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Command:
    def run(*words: str | Path) -> Outcome:
        capsys.readouterr()
        code = main([str(word) for word in words])
        return Outcome(code, *capsys.readouterr())

    return run


@pytest.fixture
def run(command: Command) -> Command:
    """Call a command that succeeds."""

    def succeed(*words: str | Path) -> Outcome:
        outcome = command(*words)
        assert outcome.code == 0, outcome.err
        return outcome

    return succeed
