"""The command ``occ-model transmit``: a folder with everything needed to blink a scene."""

from pathlib import Path

import pytest
from model.commands.conftest import Command

import occ_model as occ
from occ_model.boards.sketch import board_named, file_names
from occ_model.figures import transmitter_files
from occ_model.scene.provenance import scene_inside

FILES = {
    "waveform.csv", "waveform.vcd", "waveform.wav",
    "wiring.pdf", "wiring.svg", "wiring.png", "scene.toml",
}  # fmt: skip

SCENE = ("--preset", "phone-68us", "--set", "switching_frequency=14.7kHz")


@pytest.fixture
def without_drawings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write empty drawings of the wiring: drawing takes long."""
    monkeypatch.setattr(transmitter_files, "wiring_bytes", lambda *_: b"")


@pytest.mark.usefixtures("plain_figures")
def test_the_folder_has_sketch_waveform_wiring_and_scene(
    tmp_path: Path, run: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, drawn = tmp_path / "blink", transmitter_files.wiring_bytes
    monkeypatch.setattr(  # drawing takes long, so that one of three pictures is enough
        transmitter_files, "wiring_bytes", lambda *how: drawn(*how) if how[1] == "svg" else b""
    )
    said = run("transmit", *SCENE, "--board", "arduino-uno", "-o", folder).out
    assert {path.name for path in folder.iterdir()} == {"blink.ino", *FILES}
    asked = occ.load_preset("phone-68us").replace(switching_frequency=14.7e3)
    assert (folder / "blink.ino").read_text() == occ.transmitter_sketch(asked, "arduino-uno")
    assert said.startswith(f"{folder}: blink.ino, ")
    assert "14.7058824 kHz, +400 ppm from the 14.7 kHz asked" in said
    assert "Do not look into a bright LED" in said
    # The scene has the frequency that is sent.
    scene = occ.Scene.from_toml((folder / "scene.toml").read_text())
    sent = asked.replace(switching_frequency=16e6 / 1088)
    assert scene == sent
    for name in ("waveform.csv", "wiring.svg"):
        assert scene_inside(folder / name) == sent


@pytest.mark.parametrize(
    ("board", "folder", "sketch"),
    [
        ("arduino-nano", "lamp-2", "lamp-2.ino"),
        ("esp32", "my lamp", "blink.ino"),
        ("esp32", ".lamp", "blink.ino"),
        ("raspberry-pi-pico", "lamp", "main.py"),
    ],
)
def test_the_sketch_has_the_name_that_the_board_needs(
    tmp_path: Path, board: str, folder: str, sketch: str
) -> None:
    assert set(file_names(tmp_path / folder, board_named(board))) == {sketch, *FILES}


@pytest.mark.usefixtures("without_drawings")
def test_without_a_wav_file_the_reason_is_stated(tmp_path: Path, run: Command) -> None:
    folder = tmp_path / "fast"
    said = run("transmit", "--set", "switching_frequency=120kHz", "-o", folder).out
    assert not (folder / "waveform.wav").exists()
    assert "A WAV file has up to 192 kHz" in said


@pytest.mark.usefixtures("without_drawings")
def test_a_lamp_is_written_with_its_true_frequency_and_duty(
    tmp_path: Path, command: Command
) -> None:
    folder = tmp_path / "lamp"
    lamp = ("--set", "light=lamp", "--set", "lamp_frequency=239Hz", "--set", "duty=30%")
    said = command("transmit", *lamp, "-o", folder).out
    assert "duty cycle 29.9952199 %, for the 30 % asked" in said
    assert "523 samples a period" in said
    sent = occ.Scene.from_toml((folder / "scene.toml").read_text()).transmitter
    assert (sent.light, sent.lamp_frequency, sent.duty) == ("lamp", 16e6 / 66_944, 2510 / 8368)
    rows = [line for line in (folder / "waveform.csv").read_text().splitlines() if line[0] != "#"]
    assert rows == ["part,clock cycles,time in s,lit", "0,0,0,1", "1,20080,0.001255,0",
                    "2,66944,0.004184,1"]  # fmt: skip
    refused = command("transmit", "--set", "light=mains", "-o", folder)
    assert refused.code != 0
    assert "a pin is either on or off" in refused.err
