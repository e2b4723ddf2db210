"""What the tests of `resources/start.py` share: none needs network, pip or a changed system."""

import importlib.util
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType

import pytest

_PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture
def project_folder() -> Path:
    """The folder of the project itself, which no test changes."""
    return _PROJECT


@pytest.fixture
def script(project_folder: Path) -> Path:
    """The script as the project has it."""
    return project_folder / "resources" / "start.py"


@pytest.fixture
def start(tmp_path: Path, script: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Import a copy of the script, so that its project is a temporary folder, outside CI."""
    monkeypatch.delenv("CI", raising=False)
    copy = tmp_path / "resources" / "start.py"
    copy.parent.mkdir()
    shutil.copy(script, copy)
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
