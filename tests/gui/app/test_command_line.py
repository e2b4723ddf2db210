"""``occ-gui`` from the command line: screenshots, and sentences that refuse wrong options."""

import sys
from pathlib import Path

import pytest
from gui.starts import UNMEASURED, Starts
from PIL import Image
from PySide6.QtCore import QPoint, QTimer

import occ_model as occ
from occ_gui.accuracy.accuracy_plot import COLOURS
from occ_gui.app.application import Application
from occ_gui.app.command_line import main, make_parser
from occ_gui.app.screenshot import take_screenshot, wait_until_shown
from occ_gui.app.system_libraries import find_missing_libraries
from occ_gui.detection_map.wiring import BackgroundRates

DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")

REGION = (0xE6, 0x9F, 0x00)
"""Colour of the rectangle around the region that the decoder read."""

SMALL = "--set=rows=200"
"""Option for a picture that is simulated quickly."""

DRAFT = tuple(getattr(COLOURS["draft"], part)() for part in ("red", "green", "blue"))
"""Colour of the last points of an accuracy study."""


def is_one_sentence(text: str) -> bool:
    return text.startswith("occ-gui: ") and text.endswith(".\n") and text.count("\n") == 1


def test_a_screenshot_of_the_requested_size_is_written(
    tmp_path: Path, starts: Starts, photo_file: Path
) -> None:
    picture = tmp_path / "window.png"
    process = starts.run(
        "--screenshot", picture, "--size", "1920x1080", "--photo", photo_file,
        "--overlay", "split", "--dock", "photo", SMALL, program=UNMEASURED,
    )  # fmt: skip
    assert (process.returncode, process.stdout, process.stderr) == (0, "", "")
    with Image.open(picture) as image:
        assert image.format == "PNG"
        assert image.size == (1920, 1080)
        colours = {colour for _, colour in image.convert("RGB").getcolors(2**24) or []}
    assert REGION in colours, "the picture was taken before the simulation was shown"


def test_a_scene_without_a_picture_has_no_screenshot(application: Application) -> None:
    application.scene_store.change(distance=0.1, yaw=1.2)
    with pytest.raises(occ.OccError, match="behind the camera"):
        wait_until_shown(application)


def test_a_screenshot_waits_for_the_visible_study_and_the_rates_at_the_sliders(
    application: Application, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    states = list[bool]()
    # The rates finish after all other work.
    monkeypatch.setattr(BackgroundRates, "is_idle", property(lambda _: states.count(True) > 2))
    application.scene_store.change(rows=60, columns=100)
    application.settings.set_tolerance(2.0)
    application.window.bring_to_front("accuracy")
    timer = QTimer(application.window)
    timer.timeout.connect(lambda: states.append(application.is_idle))
    timer.start(20)
    take_screenshot(application, tmp_path / "w.png")
    assert states.count(True) > 2
    plot = application.view("accuracy").plot.plot
    corner = plot.mapTo(application.window, QPoint(0, 0))
    box = (corner.x(), corner.y(), corner.x() + plot.width(), corner.y() + plot.height())
    with Image.open(tmp_path / "w.png") as image:
        drawn = image.convert("RGB").crop(box)
        colours = {colour for _, colour in drawn.getcolors(2**24) or []}
    assert DRAFT in colours, "the picture was taken before the last points were shown"


@pytest.mark.parametrize("name", ["photo.png", "link.png"])
def test_a_screenshot_is_not_written_over_the_photo(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    photo = tmp_path / "photo.png"
    Image.new("L", (100, 60), 90).save(photo)
    (tmp_path / "link.png").symlink_to(photo)
    before = photo.read_bytes()
    assert main(["--photo", str(photo), "--screenshot", str(tmp_path / name)]) == 2
    error = capsys.readouterr().err
    assert is_one_sentence(error)
    assert "the same file as the file of --photo" in error
    assert photo.read_bytes() == before


def test_an_impossible_screenshot_is_refused_in_a_sentence_and_leaves_no_file(
    tmp_path: Path, starts: Starts
) -> None:
    folder, flat = tmp_path / "out", tmp_path / "flat.png"
    folder.mkdir()
    Image.new("L", (100, 60), 90).save(flat)  # without stripes
    process = starts.run(
        "--screenshot", folder / "w.png", "--photo", flat, "--match", SMALL, program=UNMEASURED
    )
    assert process.returncode == 2
    assert is_one_sentence(process.stderr)
    assert list(folder.iterdir()) == []
    assert sorted(tmp_path.iterdir()) == [flat, folder]


def test_an_unknown_pane_is_refused_with_a_list_of_all(starts: Starts) -> None:
    process = starts.run("--dock", "histogram", SMALL, program=UNMEASURED)
    assert (process.returncode, process.stdout) == (2, "")
    assert is_one_sentence(process.stderr)
    assert "no pane 'histogram'; allowed: controls, decode, photo" in process.stderr


def refusal(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Return the line that answers a mistake."""
    try:
        code: object = main(arguments)
    except SystemExit as left:
        code = left.code
    answer = capsys.readouterr()
    assert (code, answer.out) == (2, "")
    last = answer.err.removesuffix("\n").split("\n")[-1]
    assert last.startswith("occ-gui: ")
    assert last.isprintable()
    return last


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--set", "iso=lots"], "iso"),
        (["--set", "iso"], "'iso'"),
        (["--set", "shutter=1"], "shutter"),
        (["--set", "distance=-1 m"], "distance"),
        (["--scene", "missing.toml"], "missing.toml"),
        (["--tolerance", "-1"], "tolerance"),
        (["--on", "sparkle"], "'sparkle'"),
        (["--on", "jpeg", "--off", "jpeg"], "'jpeg'"),
        (["--seed", "-1"], "seed"),
        (["--match"], "--photo"),
        (["--preset", "fone-68us"], "phone-68us"),
        (["--preset", "phone-68us", "--scene", "mine.toml"], "not allowed with"),
        (["--screenshot", "/none/window.jpg"], ".png"),
        (["--screenshot", "/"], ".png"),
        (["--screenshot", "/none/w.png"], "/none"),
        (["--screenshot", "w.png", "--photo", "missing.jpg"], "missing.jpg"),
        # The unknown preset ends the program in case the size is accepted.
        *(
            ([f"--size={size}", "--preset", "none at all"], repr(size))
            for size in ("big", "1280x800x3", "99999x99999", "-5x100")
        ),
    ],
)
def test_a_mistake_is_refused_before_any_window(
    capsys: pytest.CaptureFixture[str], arguments: list[str], words: str
) -> None:
    assert words in refusal(arguments, capsys)


def test_a_wrong_option_is_refused_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    last = refusal(["--no-such=\x1b[31m" + "9" * 5000], capsys)
    assert last.startswith("occ-gui: error: unrecognized arguments: --no-such=\\x1b[31m999")
    assert len(last) < 1100


def test_without_a_display_a_screenshot_is_suggested(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in DISPLAYS:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    assert "no display" in refusal([], capsys)


def test_a_display_that_does_not_answer_gives_a_sentence(starts: Starts) -> None:
    process = starts.run(QT_QPA_PLATFORM="xcb", DISPLAY=":59999")
    assert process.returncode == 2
    *_, sentence = process.stderr.splitlines(keepends=True)
    assert is_one_sentence(sentence)
    missing = find_missing_libraries("xcb")
    assert all(library in sentence for library in missing or ["no display"])


def test_files_need_no_option() -> None:
    options = make_parser().parse_args(["scene.occ.toml", "photo.jpg"])
    assert options.files == [Path("scene.occ.toml"), Path("photo.jpg")]
    assert make_parser().parse_args([]).files == []
