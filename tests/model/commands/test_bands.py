"""``occ-model bands`` tells the depth of the bars and what shows none."""

import pytest

from occ_model.cli import main

_LAMP = (
    "bands", "--set", "pattern=1110", "--set", "switching_frequency=1.92kHz",
    "--set", "exposure_time=2ms", "--set", "illuminance=0lx",
)  # fmt: skip


def test_a_dimmed_lamp_gets_its_depth_and_its_shutter_speeds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(_LAMP) == 0
    lines = capsys.readouterr().out.splitlines()
    # 0.96 of 480 Hz's periods: 0.04 of one is missing, of 0.72 that are lit.
    assert lines[0].startswith("Bars at 2 ms: 5.56 % of the mean light peak to peak")
    assert "The lamp's bars vanish at whole multiples of 2.083 ms." in lines
    rows = {line.split(" s ")[0]: line for line in lines if line.startswith("1/")}
    assert rows["1/120"].endswith("0 %       no bars")
    assert rows["1/60"].endswith("no bars if the camera keeps the former")
    assert rows["1/100"].endswith("%")
    assert any("percent flicker 100 %" in line for line in lines)
