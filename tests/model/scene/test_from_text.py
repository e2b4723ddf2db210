"""Scenes as a user gives them: by a file, and by name=value."""

import os
from pathlib import Path

import pytest
from each_case import each_case

from occ_model.errors import ParameterError, SceneFileError
from occ_model.scene.from_text import change_scene, read_scene_file
from occ_model.scene.scene import Scene


@each_case(
    [
        ("switching_frequency=14kHz", "switching_frequency", 14e3),
        ("exposure_time = 68 us", "exposure_time", 68e-6),
        ("  exposure_time=1/8000", "exposure_time", 1 / 8000),
        ("distance=60cm", "distance", 0.6),
        ("yaw=0.5 rad", "yaw", 0.5),
        ("exposure_time=0.000136", "exposure_time", 136e-6),
        ("exposure_time=136 s", "exposure_time", 136.0),
        ("switching_frequency=20000", "switching_frequency", 20e3),
        ("rows=300", "rows", 300),
        ("code=0b1011001110", "code", 718),
        ("code=0x3ff", "code", 1023),
        ("code=007", "code", 7),
        ("code= 0000 ", "code", 0),
        ("distance=1,5 m", "distance", 1.5),
        ("exposure_time=0,136 ms", "exposure_time", 136e-6),
        ("averaging=light", "averaging", "light"),
        ("pattern=0101 1100", "pattern", "01011100"),
        ("pattern=", "pattern", ""),
    ]
)
def test_a_setting_is_read_as_its_kind_of_parameter_is_written(
    setting: str, name: str, value: float | str
) -> None:
    start = Scene().replace(pattern="1")
    assert change_scene(start, [setting]) == start.replace(**{name: value})


def test_the_order_of_settings_does_not_matter() -> None:
    settings = ["code=4095", "bits=12"]
    assert change_scene(Scene(), settings) == Scene().replace(code=4095, bits=12)
    assert change_scene(Scene(), settings[::-1]) == Scene().replace(code=4095, bits=12)


def test_the_last_of_two_settings_of_one_parameter_holds() -> None:
    assert change_scene(Scene(), ["iso=200", "iso=400"]).value("iso") == 400


@pytest.mark.parametrize(
    ("setting", "sentence"),
    [
        ("iso", r"^'iso' is not a setting; write NAME=VALUE\.$"),
        ("", r"^'' is not a setting; write NAME=VALUE\.$"),
        ("=100", r"^There is no parameter ''; known are "),
        ("is=100", r"^There is no parameter 'is'; did you mean iso\?$"),
        ("iso=", r"^iso is '', which is not a number; allowed: 1 to "),
        ("iso=100=200", r"^iso is '100=200', which is not a number; allowed: "),
        (
            "exposure_time=136",
            r"^exposure_time is '136' without a unit, which is 136 s and may be "
            r"meant as 136 µs; allowed: 1 ns to 1000000 s, written with its unit\.$",
        ),
    ],
)
def test_a_bad_setting_is_refused_in_a_sentence(setting: str, sentence: str) -> None:
    with pytest.raises(ParameterError, match=sentence):
        change_scene(Scene(), ["gamma=2", setting])


def test_an_unreadable_scene_file_is_refused_with_the_reason(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def fail(*_arguments: object) -> str:
        raise OSError(5, os.strerror(5))

    path = tmp_path / "scene.toml"
    path.write_text("format = 1")
    monkeypatch.setattr(os, "read", fail)
    with pytest.raises(SceneFileError, match=r"scene\.toml cannot be read: Input/output error\.$"):
        read_scene_file(path)


def test_a_refused_scene_file_is_named_with_the_reason(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text("format = 1\n[film]\n")
    with pytest.raises(SceneFileError) as refused:
        read_scene_file(path)
    assert str(refused.value).startswith(f"{path} cannot be read. A scene file has no table [film]")
