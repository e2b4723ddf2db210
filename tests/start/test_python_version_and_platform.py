"""The laws of `resources/start.py` on the Python that runs it and on where the window goes."""

import ast
import re
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import pytest
from start.conftest import run_captured

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="checks the set-up of Linux")


# The Python that runs the script


def test_the_supported_pythons_are_those_of_the_project(
    start: ModuleType, project_folder: Path
) -> None:
    project = tomllib.loads((project_folder / "pyproject.toml").read_text())["project"]
    (major, oldest), (_, newest) = start.OLDEST, start.NEWEST_TRIED
    assert project["requires-python"] == f">={major}.{oldest}"
    tried = [f"{major}.{minor}" for minor in range(oldest, newest + 1)]
    named = re.findall(r"Python :: (\d+\.\d+)", " ".join(project["classifiers"]))
    assert named == tried
    assert {start.version_problem(major, minor) for minor in range(oldest, newest + 9)} == {""}
    assert f"{major}.{oldest}" in start.version_problem(2, 7)


def test_an_unsupported_python_stops_with_one_sentence(script: Path) -> None:
    pretend = f"import runpy, sys; sys.version_info = (3, 8, 18); runpy.run_path({str(script)!r})"
    run = run_captured([sys.executable, "-c", pretend])
    assert run.returncode == 1
    assert run.stderr.startswith("This project needs Python 3.11 or newer")
    assert run.stderr.count("\n") == 1


def test_the_script_keeps_to_syntax_that_an_old_python_reads(script: Path) -> None:
    assert ast.parse(script.read_text(), feature_version=(3, 7)).body


# Where the window goes


@pytest.mark.parametrize(
    ("arguments", "environment", "platform"),
    [
        ([], {}, ""),
        ([], {"DISPLAY": ":0"}, "xcb"),
        ([], {"DISPLAY": ""}, ""),
        ([], {"WAYLAND_DISPLAY": "wayland-0"}, "wayland"),
        ([], {"WAYLAND_DISPLAY": "wayland-0", "DISPLAY": ":0"}, "wayland"),
        ([], {"WAYLAND_DISPLAY": "wayland-0", "DISPLAY": ":0", "QT_QPA_PLATFORM": "xcb"}, "xcb"),
        ([], {"QT_QPA_PLATFORM": "xcb"}, ""),
        ([], {"QT_QPA_PLATFORM": "offscreen"}, "offscreen"),
        ([], {"QT_QPA_PLATFORM": "vnc:size=800x600", "DISPLAY": ":0"}, "vnc"),
        ([], {"QT_QPA_PLATFORM": "minimal;xcb"}, "minimal"),
        (["--screenshot", "window.png"], {}, "offscreen"),
        (["--screenshot=window.png"], {"DISPLAY": ":0"}, "offscreen"),
        (["--help"], {}, "offscreen"),
        (["--version"], {}, "offscreen"),
        (["picture.png"], {}, ""),
    ],
)
def test_the_platform_follows_arguments_then_qt_then_displays(
    start: ModuleType, arguments: list[str], environment: dict[str, str], platform: str
) -> None:
    assert start.qt_platform(arguments, environment) == platform


def test_without_a_display_the_set_up_runs_and_offers_a_picture(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for variable in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(variable, raising=False)
    done: list[str] = []
    monkeypatch.setattr(start, "set_up", lambda platform, extras: done.append(platform))
    assert start.main([]) == 1
    assert done == [""]
    output = capsys.readouterr()
    assert "--screenshot window.png" in output.err
    assert output.out == ""
