"""What the command ``occ-model match`` prints of one photo."""

import pytest

import occ_model as occ
from occ_model.cli import main
from occ_model.files.resources import resource_path
from occ_model.scene.from_text import read_scene_file
from occ_model.transmitter.packet import sent_chips

SAMPLE = resource_path("photos") / "packets-6khz.jpg"
PART = "146:1053,344:1100"


def lines_of(text: str) -> dict[str, str]:
    return {line[:22].strip(): line[22:] for line in text.splitlines()}


def printed(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    capsys.readouterr()
    assert main(["match", *map(str, arguments)]) == 0
    return capsys.readouterr().out


def test_the_chips_in_view_are_printed_without_a_known_code(
    capsys: pytest.CaptureFixture[str],
) -> None:
    lines = lines_of(printed(capsys, SAMPLE, "--chips", "--region", PART))
    sent = "".join(map(str, sent_chips(read_scene_file(SAMPLE.with_suffix(".toml")).transmitter)))
    assert lines["chips"] in sent * 9
    assert lines["chips in view"].startswith(f"{len(lines['chips'])}, ")
    reading = occ.read_chips(occ.load_photo(SAMPLE), (146, 1053, 344, 1100))
    assert lines["chips"] == reading.text
    assert lines["chip length"] == f"{reading.columns_per_chip:.3f} columns"
    first, last = reading.region.first_column, reading.region.last_column - 1
    assert lines["region"].startswith(f"columns {first} to {last}, rows ")


def test_the_cameras_exposure_stands_under_the_fitted_one(
    capsys: pytest.CaptureFixture[str],
) -> None:
    sample = SAMPLE.with_name("led-1khz.jpg")
    out = printed(capsys, sample, "--led-frequency", "1kHz")
    names = [line[:22].strip() for line in out.splitlines()]
    place = names.index("exposure_time")
    assert names[place + 1] == "noted by the camera"
    lines = lines_of(out)
    assert lines["noted by the camera"] == "68 µs"
    assert lines["duty"] == "lit for 50 % of a period (given)"
    exposure = float(lines["exposure_time"].split()[0])
    # Written to whole microseconds and to three digits.
    chips = float(lines["exposure in chips"])
    assert chips == pytest.approx(exposure * 2e-3, abs=0.5 * 2e-3 + 5e-4)
