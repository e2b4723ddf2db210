"""The laws of `resources/start.py` on the start itself."""

import json
import os
import select
import stat
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import NoReturn

import pytest
from start.conftest import put_program, run_captured

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="checks the set-up of Linux")


@pytest.fixture
def echoing_venv(start: ModuleType) -> None:
    """Make a finished .venv whose Python echoes what it is asked to run."""
    put_program(start.PYTHON, 'if [ "$1" = -I ]; then echo 3 12; else echo "$@"; fi')
    start.STAMP.write_text(json.dumps(start.wanted_stamp("3.12", ["gui", "test"])))


def script_of(start: ModuleType) -> Path:
    """Return the copy of the script that was imported."""
    return Path(str(start.__file__))


@pytest.mark.usefixtures("echoing_venv")
def test_a_second_start_installs_and_prints_nothing_of_its_own(
    start: ModuleType, tmp_path: Path
) -> None:
    command = [sys.executable, str(script_of(start)), "--version", "two words"]
    # No program is in reach, so that the start cannot install anything.
    environment = {"PATH": str(tmp_path), "HOME": str(tmp_path)}
    run = run_captured(command, environment)
    assert run.stdout == "-m occ_gui --version two words\n"
    assert run.returncode == 0
    assert "Installing" not in run.stderr


def test_what_the_set_up_runs_speaks_on_standard_error(
    start: ModuleType, capfd: pytest.CaptureFixture[str]
) -> None:
    assert start.run_visibly(["sh", "-c", "echo $WORDS"], WORDS="from pip")
    assert not start.run_visibly(["sh", "-c", "exit 3"])
    assert capfd.readouterr() == ("", "from pip\n")


def test_the_application_replaces_the_script_with_its_arguments(
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


TESTS = "pytest -n auto --dist worksteal --durations 10 -k words"
CHECKS = (TESTS, "ruff check .", "ruff format --check .", "mypy", "lint-imports")


@pytest.mark.parametrize("failing", [(), ("mypy",), (TESTS,), ("ruff check .", "mypy"), CHECKS])
def test_every_check_runs_is_told_of_in_a_line_and_any_failure_counts(
    start: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    failing: tuple[str, ...],
) -> None:
    says = 'it="$(basename "$0") $*"; echo "words of $it"; echo "the last of $it"'
    fails = 'case "$FAILING" in *"<${it% }>"*) exit 1;; esac'
    for check in CHECKS:
        put_program(start.PROGRAMS / check.split()[0], f"{says}; {fails}")
    monkeypatch.setenv("FAILING", "".join(f"<{check}>" for check in failing))
    assert start.run_checks(["-k", "words"]) == int(bool(failing))
    first, *lines, summary = capfd.readouterr().out.splitlines()
    assert first == TESTS
    told = [line for line in lines if line.startswith(("passed ", "FAILED "))]
    for check, line in zip(CHECKS, told, strict=True):
        verdict, _, rest = line.partition(" s  ")
        assert verdict.startswith("FAILED" if check in failing else "passed")
        is_shown = check == TESTS or check in failing
        assert rest.rstrip() == check + ("" if is_shown else f": the last of {check}")
        assert any(each.startswith(f"words of {check}") for each in lines) == is_shown
    assert summary == (f"Failed: {'; '.join(failing)}" if failing else "Every check passed.")


@pytest.mark.parametrize(("given", "used"), [(None, "offscreen"), ("minimal", "minimal")])
def test_the_checks_run_without_a_display_by_default(
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
    assert set_ups == [(used, ["gui", "test"])]
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


@pytest.mark.usefixtures("echoing_venv")
def test_a_start_waits_while_another_sets_up_and_then_goes_on(
    start: ModuleType, tmp_path: Path
) -> None:
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


def test_ci_runs_the_checks_and_passes_their_exit_code_on(
    project_folder: Path, tmp_path: Path
) -> None:
    script = project_folder / ".ci" / "run"
    assert script.stat().st_mode & stat.S_IXUSR
    put_program(tmp_path / "python3", 'echo "$PWD" "$@"; exit 5')
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    run = run_captured(["bash", str(script)], environment)
    assert run.stdout.split() == [str(project_folder), "resources/start.py", "test"]
    assert run.returncode == 5
