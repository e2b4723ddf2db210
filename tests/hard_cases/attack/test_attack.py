"""Whatever comes in at a door, a result or a documented sentence comes out, soon."""

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from hard_cases import laws
from hard_cases.attack.program import doors
from hard_cases.attack.promise import Door

EVERYDAY, WHOLE = 250, int(os.environ.get("OCC_ATTACK", 6_000))
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


def share_of(door: Door, cases: int) -> int:
    return cases * door.share // sum(each.share for each in DOORS.values())


def start(cases: Mapping[str, int]) -> subprocess.Popen[str]:
    """Start to try cases at doors in a process that makes errors of warnings."""
    words = [f"{name}={number}" for name, number in cases.items()]
    return subprocess.Popen(
        [sys.executable, "-W", "error", str(PROGRAM), str(FIRST), *words],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def check(process: subprocess.Popen[str], memory: int) -> None:
    """See that no case broke the promise, and that nothing else was written."""
    written, complaints = process.communicate()
    last = written.splitlines()[-1] if written else "no case"
    assert process.returncode == 0, f"{last} ended the process: {complaints[-3000:]}"
    found = json.loads(last)
    for name, outcomes in found["doors"].items():
        fallen = outcomes["fallen"]
        number = outcomes["results"] + outcomes["sentences"] + len(fallen)
        law = f"{name}: a result or a sentence"
        laws.merge(law, DOORS[name].what, number, float(len(fallen)))
        assert not fallen, f"{PROGRAM} SEED '{name}=1' shows what fell: {fallen}"
    unexpected = [line for line in complaints.splitlines() if not line.startswith(NOISE)]
    assert unexpected == []
    assert found["memory"] < memory, f"{found['memory']:.0f} MB"


def test_some_hostile_inputs_end_in_a_result_or_a_sentence() -> None:
    shares = {name: share_of(door, EVERYDAY) for name, door in DOORS.items()}
    cases = {name: share for name, share in shares.items() if share}
    first = {name: cases.pop(name) for name in ("photos", "RAW files", "films", "tables", "scenes")}
    most = max(door.memory for door in DOORS.values())
    for process in [start(first), start(cases)]:
        check(process, most)


@pytest.mark.whole
@pytest.mark.parametrize("name", DOORS)
def test_hostile_inputs_end_in_a_result_or_a_sentence(name: str) -> None:
    door = DOORS[name]
    check(start({name: share_of(door, WHOLE)}), door.memory)


@pytest.mark.whole
def test_both_results_and_sentences_come_of_damaged_photos() -> None:
    written, _ = start({"photos": 300}).communicate()
    photos = json.loads(written.splitlines()[-1])["doors"]["photos"]
    assert min(photos["results"], photos["sentences"]) > 30
