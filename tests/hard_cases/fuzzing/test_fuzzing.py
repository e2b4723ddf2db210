"""Random inputs give a result or a documented sentence, within bounds of time and memory."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from hard_cases import laws
from hard_cases.fuzzing.program import Outcomes, fuzz, targets
from hard_cases.fuzzing.target import FuzzTarget

EVERYDAY, WHOLE = 36, int(os.environ.get("OCC_FUZZ", 800))
"""Cases of all targets together; ``OCC_FUZZ`` sets another number of cases with ``--whole``."""

FIRST = int(os.environ.get("OCC_FUZZ_SEED", 0))
"""The first seed; others give cases that have not been tried before."""

TARGETS = targets()
PROGRAM = Path(__file__).with_name("program.py")

# Written by Qt, about stored values and the missing screen, and by the writer of whole films.
EXPECTED_MESSAGES = (
    "Trying to construct an instance of an invalid type",
    "This plugin does not support propagateSizeHints",
    "OpenCV: FFMPEG: ",
)


def cases_of(target: FuzzTarget, cases: int) -> int:
    """Return how many of all cases are for a target."""
    return cases * target.fraction // sum(each.fraction for each in TARGETS.values())


def check_messages(written: str) -> None:
    """Check that only expected messages were written on standard error."""
    assert [line for line in written.splitlines() if not line.startswith(EXPECTED_MESSAGES)] == []


@pytest.mark.parametrize("name", [name for name in TARGETS if cases_of(TARGETS[name], EVERYDAY)])
def test_some_random_inputs_give_a_result_or_a_sentence(
    name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    target = TARGETS[name]
    found = fuzz(target, range(FIRST, FIRST + cases_of(target, EVERYDAY)))
    assert not found.failures
    check_messages(capfd.readouterr().err)


@pytest.mark.whole
@pytest.mark.parametrize("name", TARGETS)
def test_random_inputs_give_a_result_or_a_sentence(name: str) -> None:
    target = TARGETS[name]
    words = [str(PROGRAM), str(FIRST), f"{name}={cases_of(target, WHOLE)}"]
    done = subprocess.run(
        [sys.executable, "-W", "error", *words], capture_output=True, text=True, check=False
    )
    *_, last = done.stdout.splitlines() or ["no case"]
    assert done.returncode == 0, f"{last} ended the process: {done.stderr[-3000:]}"
    found = Outcomes(**json.loads(last))
    failures = found.failures
    laws.merge(f"{name}: a result or a sentence", target.what, found.cases, float(len(failures)))
    assert not failures, f"{PROGRAM} SEED '{name}=1' raises a failure: {failures}"
    check_messages(done.stderr)
    assert found.megabytes < target.memory
    if name == "photos":  # damaged so that there are enough of both
        assert min(found.results, found.sentences) > found.cases / 10
