"""The command line, called in process."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from model.commands.conftest import Command, Outcome
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.results.frame import PICTURES
from occ_model.scene.parameters import PARAMETERS

SMALL = ("--set", "rows=300")


def report(outcome: Outcome) -> dict[str, str]:
    """Parse the table that decode prints for a code that it has read."""
    assert (outcome.code, outcome.err) == (0, "")
    pairs = (line.split("  ", 1) for line in outcome.out.splitlines())
    return {name: value.strip() for name, value in pairs}


def test_overexposure_is_named_first_if_it_is_the_cause(command: Command, tmp_path: Path) -> None:
    path = tmp_path / "white.png"
    scene = (*SMALL, "--preset", "phone-136us", "--set", "iso=12800")
    rendered = command("render", *scene, "-o", path)
    assert "\nOverexposed: 8" in rendered.out
    for decoder in ("threshold", "matched", "sequence"):
        failed = command("decode", path, *scene, "--decoder", decoder)
        assert failed.code == 1
        cause, symptom = failed.err.splitlines()
        assert cause.startswith("Overexposed. The lit panel would have the level 860.6")
        assert not symptom.startswith("Overexposed")
    # It is no cause if the picture is read, or would not be read without it either.
    other = (*SMALL, "--preset", "phone-136us", "--set", "iso=6400")
    command("render", *other, "-o", path)
    read = command("decode", path, *other)
    assert read.code == 0
    assert read.err.startswith("Overexposed: 66 %")
    fast = (*other, "--set", "switching_frequency=20kHz")
    command("render", *fast, "-o", path)
    symptom, fact = command("decode", path, *fast).err.splitlines()
    assert symptom.startswith("The first two headers")
    assert fact.startswith("Overexposed: ")


def test_pixels_that_an_enhancement_makes_white_are_not_called_overexposed(
    command: Command, tmp_path: Path
) -> None:
    path = tmp_path / "even.png"
    rendered = command("render", *SMALL, "--tolerance", "inf", "-o", path)
    assert "Overexposed" not in rendered.out
    assert command("decode", path).err == ""


@pytest.mark.parametrize(
    ("name", "code"), [("picture.png", 0), ("picture.JPG", 718), ("picture.png", 1023)]
)
def test_decode_reads_the_picture_that_render_writes(
    command: Command, tmp_path: Path, name: str, code: int
) -> None:
    path = tmp_path / name
    rendered = command("render", *SMALL, "--set", f"code={code}", "-o", path)
    assert (rendered.code, rendered.err) == (0, "")
    assert rendered.out.startswith(f"{path}: 3456 columns, 300 rows, simulated in ")
    with Image.open(path) as picture:
        assert picture.size == (3456, 300)
    read = report(command("decode", path))
    assert (read["code"], read["bits"]) == (f"{code}", f"{code:010b}")
    sent = occ.packet(occ.Scene().replace(code=code))
    assert "".join(map(str, sent)) in read["chips"]


def test_a_saved_scene_renders_the_same_picture_again(command: Command, tmp_path: Path) -> None:
    first, again, file = tmp_path / "1.png", tmp_path / "2.png", tmp_path / "scene.toml"
    made = command("render", *SMALL, "--set", "code=5", "-o", first, "--save-scene", file)
    assert made.code == 0
    scene = occ.load_preset("phone-68us").replace(rows=300, code=5)
    assert occ.Scene.from_toml(file.read_text("utf-8")) == scene
    assert command("render", "--scene", file, "-o", again).code == 0
    assert first.read_bytes() == again.read_bytes()


def test_decode_turns_a_picture_whose_rows_were_scanned(command: Command, tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    assert command("render", *SMALL, "-o", path).code == 0
    with Image.open(path) as picture:
        turned = picture.transpose(Image.Transpose.TRANSPOSE)
    turned.save(path)
    assert report(command("decode", path))["code"] == "718"
    assert report(command("decode", path, "--scan-axis", "lines"))["code"] == "718"
    assert command("decode", path, "--scan-axis", "columns").code == 1


def test_a_picture_without_stripes_is_not_turned_away_from_the_scenes_size(
    command: Command, tmp_path: Path
) -> None:
    """The window does not turn this picture either, so that both give the same result."""
    path = tmp_path / "picture.png"
    dark = ("--set", "rows=900", "--set", "columns=300", "--set", "luminance=0.5")
    assert command("render", *dark, "-o", path).code == 0
    assert occ.load_photo(path).image.shape == (300, 900)  # noise alone does not show the scan axis
    failed = command("decode", path, *dark)
    assert failed.code == 1
    assert failed.out.startswith("region       columns 0 to 299, rows 0 to 899")
    scene = occ.load_preset("phone-68us").replace(rows=900, columns=300, luminance=0.5)
    assert failed.err.strip() == occ.decode(occ.render(scene).image, scene).failure


@pytest.mark.parametrize("level", [0, 255])
def test_a_picture_without_a_code_fails_with_the_reason(
    command: Command, tmp_path: Path, level: int
) -> None:
    path = tmp_path / "flat.png"
    Image.new("L", (40, 30), level).save(path)
    outcome = command("decode", path)
    assert outcome.code == 1
    assert outcome.err == f"No panel found: every pixel has the grey level {level}.\n"
    assert "code" not in outcome.out


def test_presets_lists_every_preset_with_its_title(command: Command) -> None:
    lines = command("presets").out.splitlines()
    assert [line.split()[0] for line in lines] == list(occ.presets())
    assert all(len(line.split()) > 2 for line in lines)


@pytest.mark.parametrize("name", occ.presets())
def test_a_preset_is_shown_with_every_value_and_its_note(command: Command, name: str) -> None:
    outcome = command("presets", name)
    title, *lines = outcome.out.splitlines()
    assert (outcome.code, title in command("presets").out) == (0, True)
    scene = occ.load_preset(name)
    declaration: Any
    light = scene.transmitter.light
    shown = {name: each for name, each in PARAMETERS.items() if each.is_of(light)}
    for line, (parameter, declaration) in zip(lines, shown.items(), strict=True):
        value = declaration.format(scene.value(parameter))
        assert line.startswith(f"{parameter:26}{value}".rstrip())
    assert sum(" assumed: not stated; " in line for line in lines) >= 6
    assert sum(" paper, I" in line for line in lines) >= (10 if light == "code" else 4)


def test_parameters_lists_what_can_be_set_and_what_is_allowed(command: Command) -> None:
    outcome = command("parameters")
    assert outcome.code == 0
    for name, declaration in PARAMETERS.items():
        meaning, allowed = f"{name:26}{declaration.meaning}", f"allowed: {declaration.allowed}"
        lights = f"{'':26}light: {', '.join(declaration.lights)}\n" if declaration.lights else ""
        assert f"{meaning}\n{'':26}{allowed}\n{lights}" in outcome.out


@pytest.mark.parametrize("line", ["", "fly", "render", "decode", "decode x.png --decoder none"])
def test_an_unknown_command_gives_the_usage(capsys: pytest.CaptureFixture[str], line: str) -> None:
    with pytest.raises(SystemExit) as ended:
        main(line.split())
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith("usage: occ-model ")


def test_the_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert (ended.value.code, capsys.readouterr().out) == (0, f"occ-model {occ.__version__}\n")


@pytest.mark.parametrize("picture_kind", PICTURES)
def test_the_picture_asked_for_is_written_and_named(
    command: Command, tmp_path: Path, picture_kind: str
) -> None:
    path = tmp_path / "picture.png"
    settings = (*SMALL, "--set", "switching_frequency=6kHz", "--set", " exposure_time = 68 us")
    words = ("--preset", "tablet-61us", *settings, "--picture", picture_kind, "--out", path)
    assert f"{picture_kind}'s picture" in command("render", *words).out
    changes = {"rows": 300, "switching_frequency": 6e3, "exposure_time": 68e-6}
    frame = occ.render(occ.load_preset("tablet-61us").replace(**changes))
    with Image.open(path) as picture:
        assert np.array_equal(np.asarray(picture), frame.picture(picture_kind))
        assert picture.info["Description"] == frame.picture_title(picture_kind)


_LAMP = (
    "bands", "--set", "pattern=1110", "--set", "switching_frequency=1.92kHz",
    "--set", "exposure_time=2ms", "--set", "illuminance=0lx",
)  # fmt: skip


def test_bands_reports_a_dimmed_lamp_s_depth_and_shutter_speeds(run: Command) -> None:
    lines = run(*_LAMP).lines
    # 0.96 of a period at 480 Hz: 0.04 of one is missing, of 0.72 that are lit.
    assert lines[0].startswith("Use 1/120 or 1/240 s: no bars. At 1/500 s they are 5.56 % of ")
    assert any(line.startswith("Bars at 2 ms: 5.56 % of the mean light") for line in lines)
    assert "The lamp's bars vanish at whole multiples of 2.083 ms." in lines
    rows = {line.split(" s ")[0]: line for line in lines if line.startswith("1/")}
    assert rows["1/120"].endswith("0 %       no bars")
    assert rows["1/60"].endswith("no bars if the camera uses the nominal time")
    assert rows["1/100"].endswith("%")
    assert any("percent flicker 100 %" in line for line in lines)


@pytest.mark.parametrize(
    ("lamp", "shutter", "sentence"),
    [("240Hz 30%", "1/100", "Use 1/48 or 1/120 s: no bars. At 1/100 s they are 41.7 {OF}."),
     ("240 Hz 30 %", "1/120", "No bars at 1/120 s."),
     ("mains 50Hz", "1/125", "Use 1/50 or 1/100 s: no bars. At 1/125 s they are 14 {OF}."),
     ("60Hz 1/16 rows", "1/1000", "Use 1/60 s, if kept exactly: no bars. At 1/1000 s they are "
      "1600 {OF}.")],
)  # fmt: skip
def test_bands_answers_for_a_lamp_in_its_own_words(
    run: Command, lamp: str, shutter: str, sentence: str
) -> None:
    first, *details = run("bands", "--lamp", lamp, "--shutter", shutter).lines
    assert first == sentence.replace("{OF}", "% of the mean light from dark to bright")
    assert details[0].startswith("  Lamp o")
    assert ("rows of this panel" in details[-1]) == ("rows" in lamp)
    known = run("bands", "--lamp", lamp, "--shutter", shutter, "--readout", "12us").lines
    lines = ", 347 lines from bar to bar." if lamp == "240Hz 30%" else "."
    assert known[0].endswith(lines)


@pytest.mark.parametrize("lamp", ["", "lamp", "240Hz", "mains", "mains 50Hz 30%", "60Hz 2/16 rows"])
def test_a_lamp_in_other_words_is_refused_with_examples(command: Command, lamp: str) -> None:
    refused = command("bands", "--lamp", lamp)
    assert refused.code == 2
    assert "allowed: " in refused.err


def test_what_hides_the_bars_of_a_picture_is_named(run: Command) -> None:
    pulses = "bands --set pattern=10 --set"
    for words, what, bars in (
        ("switching_frequency=64kHz --set readout_time=31.25us --set exposure_time=10us",
         "columns all start at the same phase", "196 %"),
        ("switching_frequency=240Hz --set exposure_time=10ms", "is overexposed", "32.7 %"),
    ):  # fmt: skip
        lines = run(*f"{pulses} {words}".split()).lines
        place = next(at for at, line in enumerate(lines) if line.startswith("Bars at"))
        first, second, third = lines[place : place + 3]
        assert f"{bars} of the mean light from dark to bright" in first
        assert "in pixel values 0 % and 0 %" in second
        assert third.startswith("  Not visible, since ")
        assert what in third


COLOUR = ("--preset", "phone-68us-colour", "--set", "rows=240", "--set", "panel_height=5cm")


@pytest.mark.parametrize("demosaicing", ["none", "bilinear"])
def test_a_colour_camera_is_rendered_and_read(
    command: Command, tmp_path: Path, demosaicing: str
) -> None:
    options = (*COLOUR, "--set", f"demosaicing={demosaicing}")
    made = command(
        "render", *options, "-o", tmp_path / "x.png", "--save-scene", tmp_path / "x.toml"
    )
    assert (made.code, made.err) == (0, "")
    read = command("decode", tmp_path / "x.png", "--scene", tmp_path / "x.toml")
    assert read.code == 0
    assert read.out.splitlines()[0] == "colours      red 718, green 345, blue 201"


def test_a_film_in_three_colours_is_made_and_read(command: Command, tmp_path: Path) -> None:
    for ending in (".mkv", ".png", ".gif", ".mp4"):
        film = tmp_path / f"x{ending}"
        made = command("film", *COLOUR, "--frames", "2", "-o", film)
        assert made.code == 0
        assert ("lossy" in made.out) == (ending in (".gif", ".mp4"))
    read = command("decode", tmp_path / "x.mkv", *COLOUR)
    assert read.code == 0
    stated = [line.split()[-1] for line in read.out.splitlines() if line[:3] in "Red Gre Blu pay"]
    assert stated == ["Red:", "718", "Green:", "345", "Blue:", "201"]
    followed = command("decode", tmp_path / "x.mkv", *COLOUR, "--follow")
    assert [line.split()[0] for line in followed.out.splitlines()[:3]] == ["red", "green", "blue"]
    for option in (("--offset-to", tmp_path / "x.mkv"), ("--channel", "red")):
        refused = command("decode", tmp_path / "x.mkv", *COLOUR, *option)
        assert (refused.code, "one LED" in refused.err) == (2, True)


def test_a_calibration_gives_the_matrix_that_the_camera_has(
    command: Command, tmp_path: Path
) -> None:
    mixing = ("--set", "mixing=0.8 0.15 0.05 / 0.1 0.6 0.3 / 0.05 0.2 0.75")
    command("render", *COLOUR, *mixing, "-o", tmp_path / "x.png")
    full = occ.load_preset("phone-68us-colour").replace(rows=240, panel_height=0.05)
    names = []
    for colour in ("red", "green", "blue", "dark"):
        lit = {"red": 0, "green": 1, "blue": 2}.get(colour)
        matrix = np.array([[0.8, 0.15, 0.05], [0.1, 0.6, 0.3], [0.05, 0.2, 0.75]])
        # The light of one LED alone is that of its column of the matrix, white on each channel.
        share = np.ones(3) if lit is None else matrix[:, lit]
        diagonal = " / ".join(
            " ".join(f"{share[row] if row == column else 0.0:g}" for column in range(3))
            for row in range(3)
        )
        steady = full.replace(
            mixing=diagonal, colour_light="white", light="waveform", levels="1", illuminance=0.0,
            luminance=0.0 if lit is None else 3600.0,
        )  # fmt: skip
        names.append(tmp_path / f"{colour}.png")
        Image.fromarray(occ.render_colour(steady, tolerance=float("inf")).image).save(names[-1])
    read = command("decode", tmp_path / "x.png", *COLOUR, "--calibration", *names)
    assert read.code == 0
    found = report(read)["mixing"].replace("/", " ").split()
    matrix = np.array([float(number) for number in found]).reshape(3, 3)
    expected = np.array([[0.8, 0.15, 0.05], [0.1, 0.6, 0.3], [0.05, 0.2, 0.75]])
    assert matrix / matrix.sum() == pytest.approx(expected / 3.0, abs=3e-3)
    assert "red 718, green 345, blue 201" in read.out


def test_commands_of_one_colour_ask_which(command: Command) -> None:
    asked = command("sweep", *COLOUR, "--vary", "distance=1m")
    assert asked.code == 2
    assert "--colour red" in asked.err
    answer = command("plan", *COLOUR, "--colour", "red")
    assert answer.code == 0
    assert "Crosstalk" not in answer.out
    assert "Crosstalk" in command("plan", *COLOUR).out
    crosstalk = ("--set", "crosstalk=10%", "--off", "mixing")
    assert "levels: switched off" in command("plan", *COLOUR, *crosstalk).out
