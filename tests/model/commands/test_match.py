"""The command ``match`` with one photo and with several."""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from interruption import run_and_interrupt
from matches import match_of_lamp, match_with
from model.commands.conftest import Command
from PIL import Image

import occ_model as occ
from occ_model.commands import match, match_many
from occ_model.files.resources import resource_path
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.table import table_of
from occ_model.results.photo_table import PhotoRow, PhotoTable
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import sent_chips

SCENE = occ.load_preset("phone-68us").replace(
    rows=40, columns=600, pattern="10", switching_frequency=5e3, readout_time=9e-6,
    exposure_time=80e-6, panel_width=3.0, enhancement="none", averaging="light",
)  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("photos")
    for seed in range(2):
        image = occ.render(SCENE.replace(start_time=seed * 3e-5), tolerance=0.0, seed=seed).image
        Image.fromarray(np.rot90(image)).save(folder / f"{seed}.png")
    (folder / "damaged.png").write_bytes(b"\x89PNG nothing")
    return folder


def words(folder: Path, *more: str) -> list[str]:
    photos = sorted(map(str, folder.glob("*.png")))
    return ["match", *photos, "--led-frequency", "2.5kHz", "--jobs", "1", "--sent", "scene", *more]


def test_table_mean_and_lines_to_paste_are_printed(
    folder: Path, tmp_path: Path, run: Command
) -> None:
    out = tmp_path / "readout.csv"
    many = words(folder, "--out", str(out))
    many.remove(str(folder / "1.png"))
    said = run(*many).lines
    assert [line.split()[:2] for line in said[:2]] == [
        ["0.png", "sure"],
        ["damaged.png", "unreadable"],
    ]
    assert "photos                2: 1 sure, 1 unreadable" in said
    (mean,) = (line for line in said if line.startswith("readout_time"))
    assert float(mean.split()[1]) == pytest.approx(9.0, rel=1e-3)
    (frame,) = (line for line in said if line.startswith("readout of the frame"))
    assert float(frame.split()[4]) == pytest.approx(600 * 9e-3, rel=1e-3)
    drone, video, note = said[-4:-1]
    assert "direction in Gyroflow's line is assumed" in note
    assert drone.startswith("OpenDroneMap: --rolling-shutter --rolling-shutter-readout 5.")
    assert float(drone.split()[-1]) == pytest.approx(5.4, rel=1e-3)
    assert video.startswith(f'Gyroflow: "frame_readout_time": {drone.split()[-1]}, ')
    assert video.endswith('"frame_readout_direction": "TopToBottom"')
    assert f"# {note}" in out.read_text().splitlines()
    rows = csv.DictReader(line for line in out.read_text().splitlines() if line[0] != "#")
    assert [row["verdict"] for row in rows] == ["sure", "unreadable"]


@pytest.mark.whole
def test_an_assumed_frequency_is_before_every_time(
    folder: Path, tmp_path: Path, run: Command
) -> None:
    known = tmp_path / "known.toml"
    known.write_text(SCENE.to_toml(), encoding="utf-8")
    photos = [folder / "0.png", folder / "1.png"]
    said = run("match", *photos, "--scene", known, "--jobs", "1").lines
    condition = "if it is a lamp of 2.5 kHz: "
    assert sum(condition in line for line in said) == 4  # the exposures are doubtful


def test_no_sure_photo_is_a_failure(folder: Path, command: Command) -> None:
    damaged = folder / "damaged.png"
    failed = command("match", damaged, damaged, "--jobs", "1")
    assert failed.code == 1
    assert "No photo is sure" in failed.out


def test_an_interrupt_is_one_line_and_leaves_no_table(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: Command
) -> None:
    def stop(*_: object, progress: Callable[[int, int], None], **__: object) -> NoReturn:
        progress(2, 3)
        raise KeyboardInterrupt

    monkeypatch.setattr(match_many, "match_photos", stop)
    out = tmp_path / "readout.csv"
    assert command(*words(folder, "--out", str(out))) == (
        130, "", "occ-model: stopped after 2 of 3 photos; nothing was written.\n"
    )  # fmt: skip
    assert not out.exists()


@pytest.mark.whole
@pytest.mark.parametrize("delay", [0.0, 0.8, 1.6, 3.0])
def test_interrupts_end_all_processes_with_one_line(
    folder: Path, tmp_path: Path, delay: float
) -> None:
    out = tmp_path / "readout.csv"
    many = words(folder, "--jobs", "2", "--out", str(out))
    many[1:1] = [str(folder / "0.png")] * 60
    code, error = run_and_interrupt("occ_model.cli", many, delay)
    assert code == 130
    assert error.startswith("occ-model: ")
    assert error.count("\n") == 1
    assert not out.exists()


def test_a_photo_of_another_lamp_is_corrected_by_its_own_frequency(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Command
) -> None:
    paths, out = [folder / "0.png", tmp_path / "a=b.png"], tmp_path / "x.csv"
    asked: list[dict[int, float]] = []

    def match_lamps_of(
        paths: list[Path], scene: Scene, known: dict[int, float], **_: object
    ) -> PhotoTable:
        asked.append(known)
        rows = [
            PhotoRow(path, "sure", match=match_with(), given=known.get(place))
            for place, path in enumerate(paths)
        ]
        return table_of(MatchSettings(scene), rows)

    monkeypatch.setattr(match_many, "match_photos", match_lamps_of)
    one = ["match", *paths, "--led-frequency", "2.5kHz", "--jobs", "1", "--out", out]
    said = run(*one, "--known", "a=b.png=4kHz").lines
    assert asked == [{1: 4e3}]
    assert ["given: 4 kHz" in line for line in said[:2]] == [False, True]
    assert "F = 4 kHz, given" in out.read_text()


SAMPLE = resource_path("photos") / "packets-6khz.jpg"
PART = "146:1053,344:1100"


def lines_of(text: str) -> dict[str, str]:
    return {line[:22].strip(): line[22:] for line in text.splitlines()}


def test_the_chips_in_view_are_printed_without_a_known_code(run: Command) -> None:
    lines = lines_of(run("match", SAMPLE, "--chips", "--region", PART).out)
    sent = "".join(map(str, sent_chips(read_scene_file(SAMPLE.with_suffix(".toml")).transmitter)))
    assert lines["chips"] in sent * 9
    assert lines["chips in view"].startswith(f"{len(lines['chips'])}, ")
    reading = occ.read_chips(occ.load_photo(SAMPLE), (146, 1053, 344, 1100))
    assert lines["chips"] == reading.text
    assert lines["chip length"] == f"{reading.columns_per_chip:.3f} columns"
    first, last = reading.region.first_column, reading.region.last_column - 1
    assert lines["region"].startswith(f"columns {first} to {last}, rows ")


def test_the_cameras_exposure_is_below_the_fitted_one(
    run: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    sample = SAMPLE.with_name("led-1khz.jpg")
    found = match_of_lamp(pattern_was_read=False, exposure_time=68.5e-6)
    monkeypatch.setattr(match, "match_photo", lambda *_, **__: found)
    out = run("match", sample, "--led-frequency", "1kHz").out
    names = [line[:22].strip() for line in out.splitlines()]
    place = names.index("exposure_time")
    assert names[place + 1] == "noted by the camera"
    lines = lines_of(out)
    assert lines["noted by the camera"] == "68 µs"
    assert lines["duty cycle"] == "50 % (given)"
    assert lines["exposure_time"].startswith("68.5")
    assert float(lines["exposure in periods"]) == pytest.approx(68.5e-6 * 1e3, rel=5e-3)
    assert "chip" not in out
