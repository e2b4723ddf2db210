"""The laws of `resources/start.py`, checked without network, pip or a change to the system."""

import ast
import importlib.util
import json
import os
import select
import shutil
import stat
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import NoReturn

import pytest

PROJECT = Path(__file__).resolve().parents[2]
SCRIPT = PROJECT / "resources" / "start.py"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="checks the set-up of Linux")


@pytest.fixture
def start(tmp_path: Path) -> ModuleType:
    """Import a copy of the script, so that its project is a temporary folder."""
    copy = tmp_path / "resources" / "start.py"
    copy.parent.mkdir()
    shutil.copy(SCRIPT, copy)
    (tmp_path / "pyproject.toml").write_text("[project]\n")
    spec = importlib.util.spec_from_file_location("start", copy)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def visible(start: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Stand in for pip and apt-get: record each command that would run, as one line."""
    lines: list[str] = []

    def record(command: Sequence[str], **settings: str) -> bool:
        lines.append(" ".join([*(f"{name}={value}" for name, value in settings.items()), *command]))
        return True

    monkeypatch.setattr(start, "run_visibly", record)
    return lines


@pytest.fixture
def ready_venv(start: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the system and the virtual environment be as they should."""
    start.VENV.mkdir()
    monkeypatch.setattr(start, "venv_version", lambda: start.RUNNING)
    monkeypatch.setattr(start, "missing_parts", lambda platform, making_venv: {})


def script_of(start: ModuleType) -> Path:
    """Return the copy of the script that was imported."""
    return Path(str(start.__file__))


def put_program(path: Path, body: str) -> None:
    """Write an executable shell script."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)


def run_captured(
    command: Sequence[str], environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run a command in a process of its own, away from the project's folder."""
    return subprocess.run(
        command, capture_output=True, text=True, check=False, cwd="/", env=environment
    )


def put_ready_venv(start: ModuleType) -> None:
    """Make a finished .venv whose Python echoes what it is asked to run."""
    put_program(start.PYTHON, 'if [ "$1" = -I ]; then echo 3 12; else echo "$@"; fi')
    start.STAMP.write_text(json.dumps(start.wanted_stamp("3.12", ["test"])))


def on_path(monkeypatch: pytest.MonkeyPatch, *programs: str) -> None:
    """Let just these programs be found."""
    monkeypatch.setattr(shutil, "which", lambda name: name if name in programs else None)


def lacking(start: ModuleType, monkeypatch: pytest.MonkeyPatch, *answers: dict[str, str]) -> None:
    """Let the system lack these parts, one answer for each time it is asked."""
    queue = list(answers)
    monkeypatch.setattr(start, "missing_parts", lambda platform, making_venv: queue.pop(0))


# The Python that runs the script


@pytest.mark.parametrize("version", [(2, 7), (3, 6), (3, 10), (3, 14), (4, 0)])
def test_an_unsupported_python_is_named_in_the_sentence(
    start: ModuleType, version: tuple[int, int]
) -> None:
    assert "this is Python {}.{}.".format(*version) in start.version_problem(*version)


def test_the_supported_pythons_are_those_of_the_project(start: ModuleType) -> None:
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text())["project"]
    (major, oldest), (_, newest) = start.OLDEST, start.NEWEST
    assert project["requires-python"] == f">={major}.{oldest},<{major}.{newest + 1}"
    for minor in range(oldest, newest + 1):
        assert start.version_problem(major, minor) == ""
        assert f"{major}.{minor}" in start.version_problem(2, 7)


@pytest.mark.parametrize("version", ["(3, 8, 18)", "(3, 14, 0)"])
def test_an_unsupported_python_stops_with_one_sentence(version: str) -> None:
    pretend = f"import runpy, sys; sys.version_info = {version}; runpy.run_path({str(SCRIPT)!r})"
    run = run_captured([sys.executable, "-c", pretend])
    assert run.returncode == 1
    assert run.stderr.startswith("This project needs Python 3.11")
    assert run.stderr.count("\n") == 1


def test_the_script_keeps_to_syntax_that_an_old_python_reads() -> None:
    assert ast.parse(SCRIPT.read_text(), feature_version=(3, 7)).body


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
def test_qt_platform_follows_arguments_then_qts_variable_then_displays(
    start: ModuleType, arguments: list[str], environment: dict[str, str], platform: str
) -> None:
    assert start.qt_platform(arguments, environment) == platform


def test_without_display_the_set_up_is_done_then_a_picture_is_offered(
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


# What the system must have


@pytest.mark.parametrize(
    ("platform", "found_missing"),
    [
        ("offscreen", ["libegl1"]),
        ("", ["libegl1"]),
        ("xcb", ["libegl1", "libxcb-icccm4"]),
        ("wayland", ["libegl1", "libwayland-cursor0"]),
    ],
)
def test_only_libraries_of_the_platform_in_use_are_asked_for(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, platform: str, found_missing: list[str]
) -> None:
    absent = {"libEGL.so.1", "libxcb-icccm.so.4", "libwayland-cursor.so.0"}
    monkeypatch.setattr(start, "loads", lambda library: library not in absent)
    monkeypatch.setattr(start, "has_font", lambda: True)
    assert list(start.missing_parts(platform, False).values()) == found_missing


def test_a_library_counts_as_there_when_the_linker_loads_it(start: ModuleType) -> None:
    assert start.loads("libc.so.6")
    assert not start.loads("libnothing-of-this-name.so.1")


@pytest.mark.parametrize(("programs", "asked_for"), [(["apt-get"], True), ([], False)])
def test_a_font_is_asked_for_only_where_its_package_is_known(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, programs: list[str], asked_for: bool
) -> None:
    on_path(monkeypatch, *programs)
    monkeypatch.setattr(start, "loads", lambda library: True)
    monkeypatch.setattr(start, "has_font", lambda: False)
    assert ("fonts-dejavu-core" in start.missing_parts("", False).values()) == asked_for


def test_a_font_in_the_home_folder_counts(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def below_home(folder: str) -> Path:
        return Path(folder) if folder.startswith(str(tmp_path)) else tmp_path / "none"

    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setattr(start, "Path", below_home)
    assert not start.has_font()
    font = tmp_path / ".local" / "share" / "fonts" / "family" / "plain.ttf"
    font.parent.mkdir(parents=True)
    font.touch()
    assert start.has_font()


@pytest.mark.parametrize("making_venv", [True, False])
def test_a_python_without_ensurepip_needs_its_venv_package_only_to_make_a_venv(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, making_venv: bool
) -> None:
    monkeypatch.setattr(start, "loads", lambda library: True)
    monkeypatch.setattr(start, "has_font", lambda: True)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    packages = list(start.missing_parts("", making_venv).values())
    assert packages == ([f"python{start.RUNNING}-venv"] if making_venv else [])


@pytest.mark.parametrize(
    ("user", "programs", "sudo_code", "terminal", "prefix"),
    [
        (0, [], 1, False, []),
        (0, ["sudo"], 1, True, []),
        (1000, [], 1, True, None),
        (1000, ["sudo"], 0, False, ["sudo"]),
        (1000, ["sudo"], 1, True, ["sudo"]),
        (1000, ["sudo"], 1, False, None),
    ],
)
def test_sudo_is_used_when_it_asks_nothing_or_there_is_a_terminal_to_ask_on(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    user: int,
    programs: list[str],
    sudo_code: int,
    terminal: bool,
    prefix: list[str] | None,
) -> None:
    on_path(monkeypatch, *programs)
    monkeypatch.setattr(os, "geteuid", lambda: user)
    monkeypatch.setattr(os, "isatty", lambda descriptor: terminal)
    answer = SimpleNamespace(returncode=sudo_code)
    monkeypatch.setattr(subprocess, "run", lambda command, **options: answer)
    assert start.root_prefix() == prefix


def test_a_complete_system_is_left_alone(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, visible: list[str]
) -> None:
    lacking(start, monkeypatch, {})
    start.provide_system_parts("xcb", making_venv=True)
    assert visible == []


@pytest.mark.parametrize(("user", "prefix"), [(0, ""), (1000, "sudo ")])
def test_only_missing_packages_are_installed_after_a_fresh_list(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    visible: list[str],
    user: int,
    prefix: str,
) -> None:
    on_path(monkeypatch, "apt-get", "sudo")
    monkeypatch.setattr(start, "root_prefix", prefix.split)
    lacking(start, monkeypatch, {"libEGL.so.1": "libegl1", "a font": "fonts-dejavu-core"}, {})
    start.provide_system_parts("offscreen", making_venv=False)
    apt = f"{prefix}env DEBIAN_FRONTEND=noninteractive apt-get"
    install = "install -y --no-install-recommends libegl1 fonts-dejavu-core"
    assert visible == [f"{apt} update", f"{apt} {install}"]


@pytest.mark.parametrize(("programs", "sudo"), [(["apt-get"], ""), (["apt-get", "sudo"], "sudo ")])
def test_without_the_right_to_install_the_line_to_run_by_hand_is_named(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    visible: list[str],
    programs: list[str],
    sudo: str,
) -> None:
    on_path(monkeypatch, *programs)
    monkeypatch.setattr(start, "root_prefix", lambda: None)
    lacking(start, monkeypatch, {"libEGL.so.1": "libegl1"})
    with pytest.raises(start.SetUpError) as problem:
        start.provide_system_parts("offscreen", making_venv=False)
    assert "This system lacks libEGL.so.1." in str(problem.value)
    install = f"{sudo}apt-get install -y --no-install-recommends libegl1"
    assert f"\n    {sudo}apt-get update && {install}" in str(problem.value)
    assert visible == []


def test_without_apt_get_the_missing_libraries_are_named(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, visible: list[str]
) -> None:
    on_path(monkeypatch, "sudo")
    lacking(start, monkeypatch, {"libEGL.so.1": "libegl1", "libGL.so.1": "libgl1"})
    with pytest.raises(start.SetUpError, match=r"lacks libEGL\.so\.1, libGL\.so\.1\."):
        start.provide_system_parts("offscreen", making_venv=False)
    assert visible == []


def test_a_failed_update_of_the_list_does_not_stop_the_installation(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    on_path(monkeypatch, "apt-get")
    monkeypatch.setattr(start, "root_prefix", list)
    ran: list[str] = []

    def only_install_works(command: Sequence[str]) -> bool:
        ran.append(command[-1])
        return "install" in command

    monkeypatch.setattr(start, "run_visibly", only_install_works)
    lacking(start, monkeypatch, {"libEGL.so.1": "libegl1"}, {})
    start.provide_system_parts("offscreen", making_venv=False)
    assert ran == ["update", "libegl1"]


@pytest.mark.parametrize(
    ("installs", "words"), [(False, "apt-get could not install"), (True, "still lacks libEGL.so.1")]
)
def test_an_installation_that_brings_nothing_is_an_error(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, installs: bool, words: str
) -> None:
    on_path(monkeypatch, "apt-get")
    monkeypatch.setattr(start, "root_prefix", list)
    monkeypatch.setattr(start, "run_visibly", lambda command: installs)
    lacking(start, monkeypatch, *[{"libEGL.so.1": "libegl1"}] * 2)
    with pytest.raises(start.SetUpError, match=words):
        start.provide_system_parts("offscreen", making_venv=False)


# The virtual environment


@pytest.mark.parametrize(
    ("body", "version"),
    [
        ("echo 3 11", "3.11"),
        ("echo 3 13", "3.13"),
        ("echo 3 10", ""),
        ("echo 3 14", ""),
        ("echo 3 11; exit 1", ""),
    ],
)
def test_a_venv_serves_when_its_python_answers_with_a_supported_version(
    start: ModuleType, body: str, version: str
) -> None:
    put_program(start.PYTHON, body)
    assert start.venv_version() == version


def damage_nothing(start: ModuleType) -> None:
    """Leave a venv as it is."""


def damage_python(start: ModuleType) -> None:
    """Take away the Python that a venv links to."""
    start.PYTHON.unlink()
    start.PYTHON.symlink_to(start.ROOT / "removed")


def damage_making(start: ModuleType) -> None:
    """Stop a venv in the making."""
    start.UNFINISHED.touch()


def damage_place(start: ModuleType) -> None:
    """Move a venv with its project."""
    start.STAMP.write_text(json.dumps({"root": "/elsewhere"}))


@pytest.mark.parametrize(
    ("damage", "usable"),
    [
        (damage_nothing, True),
        (damage_python, False),
        (damage_making, False),
        (damage_place, False),
    ],
)
def test_a_half_made_or_moved_venv_does_not_serve(
    start: ModuleType, damage: Callable[[ModuleType], None], usable: bool
) -> None:
    put_program(start.PYTHON, "echo 3 12")
    damage(start)
    assert bool(start.venv_version()) == usable


def test_a_venv_without_pip_does_not_serve(start: ModuleType) -> None:
    assert start.venv_version() == ""
    make = [sys.executable, "-m", "venv", "--without-pip", str(start.VENV)]
    subprocess.run(make, check=True)
    assert start.PYTHON.exists()
    assert start.venv_version() == ""


def test_making_a_venv_replaces_what_was_there_and_marks_it_finished(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    start.VENV.mkdir()
    (start.VENV / "rest").touch()

    def make(command: Sequence[str], **options: object) -> SimpleNamespace:
        assert start.UNFINISHED.exists()
        return SimpleNamespace(returncode=0)

    monkeypatch.setattr(subprocess, "run", make)
    start.make_venv()
    assert list(start.VENV.iterdir()) == []


def test_a_failed_making_says_so_and_leaves_the_venv_marked(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    failure = SimpleNamespace(returncode=1, stdout="", stderr="the disk is full")
    monkeypatch.setattr(subprocess, "run", lambda command, **options: failure)
    with pytest.raises(start.SetUpError, match="could not make the virtual environment"):
        start.make_venv()
    assert "the disk is full" in capsys.readouterr().err
    assert start.UNFINISHED.exists()


def test_a_link_in_place_of_the_venv_is_replaced_and_its_target_kept(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    kept = tmp_path / "target" / "kept"
    kept.parent.mkdir()
    kept.touch()
    start.VENV.symlink_to(kept.parent)
    monkeypatch.setattr(subprocess, "run", lambda command, **options: SimpleNamespace(returncode=0))
    start.make_venv()
    assert kept.exists()
    assert not start.VENV.is_symlink()


# What pip has done


@pytest.mark.usefixtures("ready_venv")
def test_pip_runs_only_for_extras_not_yet_there(start: ModuleType, visible: list[str]) -> None:
    for extras in ([], [], ["test"], ["test"], []):
        start.set_up("offscreen", extras)
    pip = f"PIP_DISABLE_PIP_VERSION_CHECK=1 {start.PYTHON} -m pip install -e"
    assert visible == [f"{pip} .", f"{pip} .[test]"]


@pytest.mark.usefixtures("ready_venv")
def test_a_changed_project_is_installed_again_with_the_extras_it_had(
    start: ModuleType, visible: list[str]
) -> None:
    start.set_up("offscreen", ["test"])
    (start.ROOT / "pyproject.toml").write_text("[project]\nname = 'other'\n")
    start.set_up("offscreen", [])
    assert [line.split()[-1] for line in visible] == [".[test]", ".[test]"]


def test_a_stamp_of_another_project_python_or_folder_does_not_serve(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    stamp = start.wanted_stamp("3.12", ["test"])
    assert start.serves(stamp, start.wanted_stamp("3.12", ["test"]))
    assert not start.serves(stamp, start.wanted_stamp("3.13", ["test"]))
    project = start.ROOT / "pyproject.toml"
    copy = tmp_path / "copy" / "pyproject.toml"
    copy.parent.mkdir()
    shutil.copy(project, copy)
    with monkeypatch.context() as elsewhere:
        elsewhere.setattr(start, "ROOT", copy.parent)
        assert not start.serves(stamp, start.wanted_stamp("3.12", ["test"]))
    project.write_text("[project]\nname = 'other'\n")
    assert not start.serves(stamp, start.wanted_stamp("3.12", ["test"]))


@pytest.mark.parametrize("text", ["", "{", "[1]", "null"])
def test_a_damaged_stamp_counts_as_none(start: ModuleType, text: str) -> None:
    start.VENV.mkdir()
    start.STAMP.write_text(text)
    assert start.read_stamp() == {}


@pytest.mark.usefixtures("ready_venv", "visible")
def test_a_failed_pip_leaves_no_stamp(start: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    start.set_up("offscreen", [])
    assert start.STAMP.exists()
    monkeypatch.setattr(start, "run_visibly", lambda command, **settings: False)
    with pytest.raises(start.SetUpError, match="pip could not install"):
        start.set_up("offscreen", ["test"])
    assert not start.STAMP.exists()


# The start itself


def test_a_second_start_adds_little_and_leaves_standard_output_to_the_application(
    start: ModuleType, tmp_path: Path
) -> None:
    put_ready_venv(start)
    command = [sys.executable, str(script_of(start)), "--version", "two words"]
    # No program is in reach, so that the start cannot install anything.
    environment = {"PATH": str(tmp_path), "HOME": str(tmp_path)}
    began = time.monotonic()
    run = run_captured(command, environment)
    assert time.monotonic() - began < 2
    assert run.stdout == "-m occ_gui --version two words\n"
    assert run.returncode == 0


def test_what_the_set_up_runs_speaks_on_standard_error(
    start: ModuleType, capfd: pytest.CaptureFixture[str]
) -> None:
    assert start.run_visibly(["sh", "-c", "echo $WORDS"], WORDS="from pip")
    assert not start.run_visibly(["sh", "-c", "exit 3"])
    assert capfd.readouterr() == ("", "from pip\n")


def test_the_application_takes_the_place_of_the_script_with_its_arguments(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    became: list[Sequence[str]] = []
    monkeypatch.setattr(start, "set_up", lambda platform, extras: None)

    def become(program: str, command: Sequence[str]) -> NoReturn:
        became.append(command)
        raise SystemExit

    monkeypatch.setattr(os, "execv", become)
    with pytest.raises(SystemExit):
        start.main(["--screenshot", "a b.png"])
    assert became == [[str(start.PYTHON), "-m", "occ_gui", "--screenshot", "a b.png"]]


@pytest.mark.parametrize(("codes", "exit_code"), [([0] * 5, 0), ([1, 0, 1, 0, 0], 1), ([1] * 5, 1)])
def test_every_check_runs_and_any_failure_counts(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    codes: list[int],
    exit_code: int,
) -> None:
    ran: list[list[str]] = []

    def run(command: list[str], **options: object) -> SimpleNamespace:
        ran.append([Path(command[0]).name, *command[1:]])
        return SimpleNamespace(returncode=codes[len(ran) - 1])

    monkeypatch.setattr(subprocess, "run", run)
    assert start.run_checks(["-k", "one or two"]) == exit_code
    assert ran == [
        ["ruff", "check", "."],
        ["ruff", "format", "--check", "."],
        ["mypy"],
        ["lint-imports"],
        ["pytest", "-k", "one or two"],
    ]
    summary = capsys.readouterr().out.splitlines()[-1]
    assert ("mypy" in summary) == bool(codes[2])
    assert ("lint-imports" in summary) == bool(codes[3])


@pytest.mark.parametrize(("given", "used"), [(None, "offscreen"), ("minimal", "minimal")])
def test_the_checks_run_without_a_display_unless_told_otherwise(
    start: ModuleType, monkeypatch: pytest.MonkeyPatch, given: str | None, used: str
) -> None:
    monkeypatch.setenv("QT_QPA_PLATFORM", given or "")
    if given is None:
        monkeypatch.delenv("QT_QPA_PLATFORM")
    set_ups: list[tuple[str, list[str]]] = []
    monkeypatch.setattr(
        start, "set_up", lambda platform, extras: set_ups.append((platform, extras))
    )
    monkeypatch.setattr(start, "run_checks", lambda arguments: 7 if arguments == ["-x"] else 0)
    assert start.main(["test", "-x"]) == 7
    assert set_ups == [(used, ["test"])]
    assert os.environ["QT_QPA_PLATFORM"] == used


@pytest.mark.parametrize(
    ("failure", "exit_code", "words"),
    [
        (KeyboardInterrupt(), 130, ""),
        (PermissionError(13, "Permission denied"), 1, "Permission denied"),
    ],
)
def test_a_set_up_that_stops_leaves_no_traceback(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    failure: BaseException,
    exit_code: int,
    words: str,
) -> None:
    def stop(platform: str, extras: Sequence[str]) -> None:
        raise failure

    monkeypatch.setattr(start, "set_up", stop)
    assert start.main(["--help"]) == exit_code
    output = capsys.readouterr()
    assert words in output.err
    assert bool(output.err) == bool(words)
    assert output.out == ""


def test_a_start_waits_while_another_sets_up_and_then_goes_on(
    start: ModuleType, tmp_path: Path
) -> None:
    put_ready_venv(start)
    command = [sys.executable, str(script_of(start)), "--version"]
    environment = {"PATH": str(tmp_path), "HOME": str(tmp_path)}
    with start.one_at_a_time():
        other = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
        )
        assert other.stderr is not None
        assert select.select([other.stderr], [], [], 10)[0], "the other start said nothing"
        assert other.poll() is None
    output, errors = other.communicate(timeout=10)
    assert errors.startswith("Waiting for another start")
    assert output == "-m occ_gui --version\n"


def test_ci_runs_the_checks_from_the_project_and_passes_their_exit_code_on(tmp_path: Path) -> None:
    script = PROJECT / ".ci" / "run"
    assert script.stat().st_mode & stat.S_IXUSR
    put_program(tmp_path / "python3", 'echo "$PWD" "$@"; exit 5')
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    run = run_captured(["bash", str(script)], environment)
    assert run.stdout.split() == [str(PROJECT), "resources/start.py", "test"]
    assert run.returncode == 5
