"""Whatever comes in at a door, a result or a documented sentence comes out, soon."""

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from hard_cases import laws
from hard_cases.attack.program import Outcomes, attack, doors
from hard_cases.attack.promise import Door

EVERYDAY, WHOLE = 36, int(os.environ.get("OCC_ATTACK", 800))
"""Cases at all doors together; ``OCC_ATTACK`` asks for more."""

FIRST = int(os.environ.get("OCC_ATTACK_SEED", 0))
"""The first seed; others try what has not been tried before."""

DOORS = doors()
PROGRAM = Path(__file__).with_name("program.py")

# What writes these is Qt, of stored values and of no screen, and the writer of whole films.
NOISE = (
    "Trying to construct an instance of an invalid type",
    "This plugin does not support propagateSizeHints",
    "OpenCV: FFMPEG: ",
)


def fraction_of(door: Door, cases: int) -> int:
    return cases * door.fraction // sum(each.fraction for each in DOORS.values())


def start(cases: Mapping[str, int]) -> subprocess.Popen[str]:
    """Start to try cases at doors in a process that makes errors of warnings."""
    words = [f"{name}={number}" for name, number in cases.items()]
    return subprocess.Popen(
        [sys.executable, "-W", "error", str(PROGRAM), str(FIRST), *words],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def check_complaints(complaints: str) -> None:
    """See that nothing else was written."""
    assert [line for line in complaints.splitlines() if not line.startswith(NOISE)] == []


def check(process: subprocess.Popen[str], memory: int) -> dict[str, Outcomes]:
    """See that no case broke the promise, and that nothing else was written."""
    written, complaints = process.communicate()
    last = written.splitlines()[-1] if written else "no case"
    assert process.returncode == 0, f"{last} ended the process: {complaints[-3000:]}"
    reported = json.loads(last)
    found = {name: Outcomes(**outcomes) for name, outcomes in reported["doors"].items()}
    for name, outcomes in found.items():
        fallen = outcomes.fallen
        law = f"{name}: a result or a sentence"
        laws.merge(law, DOORS[name].what, outcomes.cases, float(len(fallen)))
        assert not fallen, f"{PROGRAM} SEED '{name}=1' shows what fell: {fallen}"
    check_complaints(complaints)
    assert reported["memory"] < memory, f"{reported['memory']:.0f} MB"
    return found


@pytest.mark.parametrize("name", [name for name in DOORS if fraction_of(DOORS[name], EVERYDAY)])
def test_some_hostile_inputs_end_in_a_result_or_a_sentence(
    name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    door = DOORS[name]
    found = attack(door, range(FIRST, FIRST + fraction_of(door, EVERYDAY)))
    assert not found.fallen
    check_complaints(capfd.readouterr().err)


@pytest.mark.whole
@pytest.mark.parametrize("name", DOORS)
def test_hostile_inputs_end_in_a_result_or_a_sentence(name: str) -> None:
    door = DOORS[name]
    found = check(start({name: fraction_of(door, WHOLE)}), door.memory)[name]
    if name == "photos":  # damaged so that both come of them
        assert min(found.results, found.sentences) > found.cases / 10
