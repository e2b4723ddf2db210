"""The command ``camera``: a camera is measured by pictures of a lit room."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from model.commands.conftest import Command, Outcome
from PIL import Image


@pytest.fixture(scope="module")
def wall(tmp_path_factory: pytest.TempPathFactory) -> str:
    """An even wall under light of 120 Hz, whose 320 lines are read in 28 ms."""
    light = 0.3 * (1.0 + 0.3 * np.cos(2.0 * math.pi * 120.0 * 28e-3 * np.arange(320) / 320))
    values = 255.0 * (1.055 * light ** (1.0 / 2.4) - 0.055)
    path = tmp_path_factory.mktemp("wall") / "wall.png"
    Image.fromarray(np.repeat(np.rint(values)[:, None], 60, axis=1).astype(np.uint8)).save(path)
    return str(path)


def test_the_answer_comes_first(wall: str, run: Command) -> None:
    first, *others = run("camera", "--mains", "60Hz", wall).lines
    assert first.startswith("Your camera reads a line in 87.")
    assert first.endswith(": doubtful.")
    assert any("320 lines" in line for line in others)


def check_readout_time(found: Outcome, expected: float) -> None:
    """Check the readout time of a measurement as JSON, in SI units."""
    measured = json.loads(found.out)
    error = measured["uncertainties"]["readout_time"]
    assert measured["readout_time"] == pytest.approx(expected, abs=3.0 * error)


def test_json_holds_si_units(wall: str, run: Command) -> None:
    check_readout_time(run("camera", "--mains", "60Hz", wall, "--json"), 28e-3 / 320)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--mains", "0"], "mains_frequency is 0 Hz"),
        (["more.png", "again.png"], "PICTURE is given 3 times"),
        (["missing.png"], "missing.png"),
        (["again.png", "--flash", "2ms"], "one picture of a flash"),
        (["--flash", "2 parsecs"], "--flash"),
    ],
)
def test_wrong_command_lines_are_refused(
    wall: str, words: list[str], said: str, command: Command
) -> None:
    refused = command("camera", wall, *words)
    assert refused.code == 2
    assert said in refused.err


def test_a_flash_of_known_length_measures_a_camera(tmp_path: Path, run: Command) -> None:
    """Lines of 20 us, of which a flash of 2 ms and an exposure of 0.5 ms light 125."""
    line = np.arange(400)
    shared = np.minimum(line * 20e-6 + 5e-4, 4.9e-3) - np.maximum(line * 20e-6, 2.9e-3)
    light = 0.02 + 0.6 * np.maximum(shared, 0.0) / 5e-4
    values = np.rint(255.0 * light ** (1 / 2.2)).astype(np.uint8)
    path = tmp_path / "flash.png"
    Image.fromarray(np.repeat(values[:, None], 60, axis=1)).save(path)
    said = run("camera", "--flash", "2ms", path).out
    assert "the exposure is longer than the flash" in said
    check_readout_time(run("camera", "--flash", "2ms", path, "--json"), 20e-6)
