"""The command for limits prints what the search has found, in a table and in sentences."""

import re
from collections.abc import Iterator

import numpy as np
import pytest
from model.study.conftest import Decoding, correct_within, replace_reading

import occ_model as occ
from occ_model.cli import main
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene


def test_the_command_states_the_bits_received_per_second(
    decoding: Decoding, capsys: pytest.CaptureFixture[str]
) -> None:
    decoding(correct_within((0.0, 20e3)))
    scene = ["--set", "columns=1000", "--set", "readout_time=40us", "--set", "bits=16"]
    command = ["limits", *scene, "--decoder", "threshold", "--images", "1", "--jobs", "1"]
    # The readout of a picture's columns takes 40 ms, so there are at most 25 pictures per second.
    for frames_a_second, bits in ((10, 160), (60, 400)):
        assert main([*command, "--fps", str(frames_a_second)]) == 0
        assert capsys.readouterr().out.splitlines()[2].endswith(f" {bits}")


def test_the_command_answers_with_one_table_of_all_decoders(
    decoding: Decoding, capsys: pytest.CaptureFixture[str]
) -> None:
    decoding(correct_within((0.0, 2e3), (4e3, 14e3)))
    assert main(["limits", "--preset", "phone-136us", "--images", "2", "--jobs", "1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split("  ")[0] == "decoder"
    rows = [[cell for cell in line.split("  ") if cell] for line in lines[2:6]]
    assert [cells[0].strip() for cells in rows] == ["threshold", "matched", "equalizer", "sequence"]
    for cells in rows:
        assert cells[1].strip() == "500 Hz (not searched beyond)"
        assert re.fullmatch(r" ?(1\.9\d*|2) kHz", cells[2])
        assert re.fullmatch(r" ?from 4[.\d]* kHz to 1[34][.\d]* kHz", cells[3].rstrip())
    place = lines.index(
        "  Below 3.468 kHz a picture does not contain two packets, and not always the two "
        "headers that this decoder needs."
    )
    assert place < lines.index("The matched decoder, switching frequency:")
    assert lines[-1].endswith("; above 1.17 ms, completely lit columns are saturated.")


def test_the_commands_table_and_sentences_state_the_same_ends(
    decoding: Decoding, capsys: pytest.CaptureFixture[str]
) -> None:
    """If the rate falls slowly, more images move an end that the search has found."""

    def read_more_rarely(frequency: float, image: int, seed: int) -> float:
        lost = (frequency / 40e3) ** 2
        return float(np.random.default_rng([seed, image, int(frequency)]).random() > lost)

    decoding(read_more_rarely)
    command = ["limits", "--decoder", "threshold", "--images", "5", "--rate", "90", "--jobs", "1"]
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    highest = re.split(" {2,}", lines[2])[2]
    last_interval = lines.index("The threshold decoder, exposure time:") - 1
    assert lines[last_interval].startswith(f"  {highest}: ")


def test_the_command_fails_where_nothing_is_read(capsys: pytest.CaptureFixture[str]) -> None:
    dark = ["--set", "luminance=0", "--set", "illuminance=0"]
    assert main(["limits", "--decoder", "matched", "--images", "1", *dark]) == 1
    printed = capsys.readouterr().out
    assert "at no switching frequency from 500 Hz to 100 kHz" in printed
    assert "without light nothing saturates" in printed


def test_the_rate_at_the_scenes_own_values_is_that_of_its_own_code(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Few images are enough to accept a value, so a range can contain one that is misread once."""
    own = occ.load_preset("phone-68us").replace(code=5)

    def once_wrong(
        scene: Scene, settings: RateSettings, *_: object, first: int = 0, **_kept: bool
    ) -> Iterator[tuple[int]]:
        for image in range(first, settings.images):
            yield (0 if scene == own and image == 7 else 10,)

    replace_reading(monkeypatch, once_wrong)
    command = ["limits", "--set", "code=5", "--decoder", "matched", "--jobs", "1", "--fps", "20"]
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    assert " sending code 5: " in lines[0]
    assert [cell.strip() for cell in lines[2].split("  ") if cell][3] == "no"
    assert (
        "  At 10 kHz it read 19 of 20 pictures of code 5, 95 % of the bits (76.4 to 99.1 %): "
        "190 bits a second, if other codes are read as well."
    ) in lines
