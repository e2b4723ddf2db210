"""The laws of `resources/start.py` on what pip has done."""

import shutil
import sys
from pathlib import Path
from types import ModuleType

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="checks the set-up of Linux")


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
@pytest.mark.parametrize(
    ("extras", "kept", "option"),
    [
        (["gui"], True, "--no-compile "),
        (["gui", "test"], True, "--no-compile "),
        # An application that keeps none would compile the same modules at each of its starts.
        (["gui"], False, ""),
        (["gui", "test"], False, "--no-compile "),
    ],
)
def test_pip_compiles_only_what_nobody_else_would_keep(
    start: ModuleType,
    visible: list[str],
    monkeypatch: pytest.MonkeyPatch,
    extras: list[str],
    kept: bool,
    option: str,
) -> None:
    monkeypatch.delenv(start.UNCOMPILED, raising=False)
    if not kept:
        monkeypatch.setenv(start.UNCOMPILED, "1")
    start.set_up("offscreen", extras)
    (line,) = visible
    pip = f"PIP_DISABLE_PIP_VERSION_CHECK=1 {start.PYTHON} -m pip install"
    assert line == f"{pip} {option}-e .[{','.join(extras)}]"


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
