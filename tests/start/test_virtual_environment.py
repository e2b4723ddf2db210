"""The laws of `resources/start.py` on the virtual environment and on what pip has done in it."""

import json
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
from start.conftest import put_program

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="checks the set-up of Linux")


@pytest.mark.parametrize(
    ("body", "version"),
    [
        ("echo 3 11", "3.11"),
        ("echo 3 13", "3.13"),
        ("echo 3 10", ""),
        ("echo 3 99", "3.99"),
        ("echo 3 11; exit 1", ""),
    ],
)
def test_a_venv_serves_when_its_python_is_supported(
    start: ModuleType, body: str, version: str
) -> None:
    put_program(start.PYTHON, body)
    assert start.venv_version() == version


def test_a_half_made_or_moved_venv_does_not_serve(start: ModuleType) -> None:
    put_program(start.PYTHON, "echo 3 12")
    assert start.venv_version()
    start.UNFINISHED.touch()
    assert not start.venv_version()
    start.UNFINISHED.unlink()
    start.STAMP.write_text(json.dumps({"root": "/elsewhere"}))
    assert not start.venv_version()
    start.STAMP.unlink()
    start.PYTHON.unlink()
    start.PYTHON.symlink_to(start.ROOT / "removed")
    assert not start.venv_version()


def test_a_venv_without_pip_does_not_serve(start: ModuleType) -> None:
    assert start.venv_version() == ""
    make = [sys.executable, "-m", "venv", "--without-pip", str(start.VENV)]
    subprocess.run(make, check=True)
    assert start.PYTHON.exists()
    assert start.venv_version() == ""


def test_making_a_venv_replaces_the_old_and_marks_it_finished(
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


@pytest.fixture
def ready_venv(start: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the system and the virtual environment be as they should."""
    start.VENV.mkdir()
    monkeypatch.setattr(start, "venv_version", lambda: start.RUNNING)
    monkeypatch.setattr(start, "missing_parts", lambda platform, making_venv: {})


@pytest.mark.usefixtures("ready_venv")
def test_pip_runs_only_for_extras_not_yet_there(start: ModuleType, visible: list[str]) -> None:
    for extras in (["gui"], ["gui"], ["gui", "test"], ["gui", "test"], ["gui"]):
        start.set_up("offscreen", extras)
    assert [line.split()[-1] for line in visible] == [".[gui]", ".[gui,test]"]


@pytest.mark.usefixtures("ready_venv")
def test_a_changed_project_is_installed_with_the_same_extras(
    start: ModuleType, visible: list[str]
) -> None:
    start.set_up("offscreen", ["gui", "test"])
    (start.ROOT / "pyproject.toml").write_text("[project]\nname = 'other'\n")
    start.set_up("offscreen", ["gui"])
    assert [line.split()[-1] for line in visible] == [".[gui,test]", ".[gui,test]"]


def test_a_stamp_of_another_installation_does_not_serve(
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
    start.set_up("offscreen", ["gui"])
    assert start.STAMP.exists()
    monkeypatch.setattr(start, "run_visibly", lambda command, **settings: False)
    with pytest.raises(start.SetUpError, match="pip could not install"):
        start.set_up("offscreen", ["gui", "test"])
    assert not start.STAMP.exists()
