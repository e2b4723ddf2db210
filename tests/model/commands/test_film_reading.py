"""The command ``decode`` with a film."""

from pathlib import Path

import pytest

from occ_model.cli import main
from occ_model.files.film_kinds import is_film

SCENE = [
    "--preset", "phone-68us", "--set", "columns=720", "--set", "rows=32",
    "--set", "readout_time=36us", "--set", "switching_frequency=3kHz",
    "--set", "exposure_time=150us", "--set", "distance=0.5", "--set", "panel_height=1.5",
    "--set", "panel_width=0.8", "--set", "framing=c-ook", "--set", "line_code=manchester",
]  # fmt: skip


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("film") / "film.mkv"
    made = ["film", *SCENE, "--set", "payload=text:four", "--frames", "24", "-o", str(path)]
    assert main(made) == 0
    return path


def test_a_film_is_read_and_reported(film: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["decode", str(film), *SCENE, "--set", "payload=text:????"]) == 0
    printed = capsys.readouterr().out.splitlines()
    lines = {line[:18].strip(): line[18:] for line in printed}
    assert lines["payload"] == "four"
    assert lines["payload complete"].startswith("after ")
    assert lines["bits"] == "".join(f"{ord(letter):08b}" for letter in "four")
    assert lines["frequency"].startswith(("2.9", "3.0"))
    assert lines["frequency"].endswith("Hz")
    assert "±" in lines["gap"]


def test_following_prints_a_line_a_frame(film: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["decode", str(film), *SCENE, "--set", "payload=text:????", "--follow"]) == 0
    lines = capsys.readouterr().out.splitlines()
    followed = [line for line in lines if line.startswith("frame ")][:24]
    assert len(followed) == 24
    assert "four" in followed[-1]


def test_a_film_of_another_scheme_fails_with_a_sentence(
    film: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["decode", str(film), *SCENE, "--set", "framing=raw"]) == 1
    words = capsys.readouterr().err.splitlines()[-1]
    assert "none of" in words
    assert "chips" in words


@pytest.mark.parametrize("percent", ["nan", "-5", "0", "51"])
def test_a_tolerance_is_refused_in_percent_as_it_was_given(
    percent: str, film: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = f"--readout-tolerance={percent}"
    assert main(["decode", str(film), *SCENE, given]) == 2
    words = f"--readout-tolerance is {percent} %; allowed: above 0 % up to 50 %."
    assert words in capsys.readouterr().err


def test_a_film_is_told_from_a_picture_by_its_content(film: Path, tmp_path: Path) -> None:
    assert is_film(film)
    for name, start in (
        ("photo.heic", b"\x00\x00\x00\x18ftypheic\x00\x00\x00\x00"),
        ("photo.png", b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR....IDAT...acTL"),
        ("photo.jpg", b"\xff\xd8\xff\xe0"),
    ):
        (tmp_path / name).write_bytes(start + bytes(64))
        assert not is_film(tmp_path / name)
    animated = tmp_path / "animated.png"
    animated.write_bytes(b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR....acTL....IDAT" + bytes(64))
    assert is_film(animated)
    assert not is_film(tmp_path / "missing.mkv")
