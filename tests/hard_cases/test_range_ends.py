"""At both ends of every parameter's range, every question is answered in bounded memory."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from hard_cases.range_ends import MEMORY, cases

PROGRAM = Path(__file__).with_name("range_ends.py")
PROCESSES = 4
EVERYDAY = 90  # step between the cases that are tested every day


def check(first: int, step: int) -> None:
    asked = subprocess.run(
        [sys.executable, "-W", "error", str(PROGRAM), str(first), str(step)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    lines = asked.stdout.splitlines() or ["no case"]
    assert asked.returncode == 0, f"{lines[-1]} ended the process: {asked.stderr[-3000:]}"
    found = json.loads(lines[-1])
    assert not found["failures"], found["failures"]
    assert found["cases"] == len(cases()[first::step])
    assert found["asked"] > found["refused"] > 0
    megabytes, what = found["most_megabytes"]
    assert megabytes < MEMORY, what


def test_some_ends_of_ranges_are_answered_in_bounded_memory() -> None:
    check(EVERYDAY // 2, EVERYDAY)


@pytest.mark.whole
@pytest.mark.parametrize("first", range(PROCESSES))
def test_all_ends_of_ranges_are_answered_in_bounded_memory(first: int) -> None:
    check(first, PROCESSES)


def test_a_fast_flicker_beside_a_slow_lamp_is_answered_in_bounded_memory() -> None:
    """The pair whose product once was the length of an array."""
    pair = {"switching_frequency": 1.0, "flicker_frequency": 1e9}
    check(cases().index(pair), len(cases()))
