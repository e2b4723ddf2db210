"""Whatever happens, the command line ends with an exit code and at most one line of errors."""

import errno
import os
import subprocess
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import pytest

from occ_model.cli import main

ENCODINGS = (
    "ascii",
    pytest.param("cp1252", marks=pytest.mark.whole),
    pytest.param("cp932", marks=pytest.mark.whole),
)

CLOSED, FULL = ">&-", ">/dev/full"

FULL_DISK = f"occ-model: Writing or reading failed: {os.strerror(errno.ENOSPC)}.\n"


def run(
    *words: str | bytes | Path, redirect: str = "", environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[bytes]:
    """Run a command as a shell does, its standard streams redirected."""
    shell = ("sh", "-c", f'exec "$@" {redirect}', "sh")
    return subprocess.run(
        [*shell, sys.executable, "-m", "occ_model", *words],
        capture_output=True,
        env={**os.environ, **(environment or {})},
        check=False,
    )


def test_a_closed_output_is_a_sentence_before_any_work(tmp_path: Path) -> None:
    path = tmp_path / "x.png"
    done = run("render", "--set", "rows=60", "-o", path, redirect=CLOSED)
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.decode() == (
        "occ-model: Standard output is closed; send it to a file or to the null device.\n"
    )
    assert not path.exists()


@pytest.mark.parametrize(
    "line",
    [
        "presets",
        pytest.param("--help", marks=pytest.mark.whole),
        pytest.param("parameters", marks=pytest.mark.whole),
    ],
)
def test_a_full_output_is_a_sentence(line: str) -> None:
    done = run(line, redirect=FULL)
    assert (done.returncode, done.stderr.decode()) == (1, FULL_DISK)


@pytest.mark.parametrize(
    ("line", "encoding"),
    [
        ("render --help", "cp1252"),
        pytest.param("plan", "cp932", marks=pytest.mark.whole),
        pytest.param("plan", "ascii", marks=pytest.mark.whole),
        pytest.param("parameters", "ascii", marks=pytest.mark.whole),
        pytest.param("presets phone-68us", "cp932", marks=pytest.mark.whole),
    ],
)
def test_letters_that_the_terminal_lacks_are_replaced(
    encoding: str,
    line: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("COLUMNS", "80")  # of lines of help
    with suppress(SystemExit):  # with which help ends
        main(line.split())
    done = run(*line.split(), environment={"PYTHONIOENCODING": encoding})
    assert (done.returncode, done.stderr) == (0, b"")
    # Pairwise, the lines differ at most where the encoding has no letter.
    wanted = capsys.readouterr().out.splitlines()
    found = done.stdout.decode(encoding).splitlines()
    replaced = [text.encode(encoding, "replace").decode(encoding) for text in wanted]
    assert [text.split() for text in found] == [text.split() for text in replaced]


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_a_refusal_is_shown_in_any_encoding(encoding: str) -> None:
    words = ("plan", "--set", "exposure_time=1Hz")
    done = run(*words, environment={"PYTHONIOENCODING": encoding})
    assert done.returncode == 2
    assert done.stderr.startswith(b"occ-model: exposure_time is '1Hz'")
    assert done.stderr.count(b"\n") == 1


def test_a_reader_that_has_stopped_ends_the_command_in_silence() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "occ_model", "parameters"],
        stdout=writer,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (1, b"")


def test_interruptions_are_answered_before_slow_imports() -> None:
    program = "import sys, occ_model.cli; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    loaded = {name for name in done.stdout.split() if name.startswith("occ_model")}
    assert loaded == {
        "occ_model", "occ_model.version", "occ_model.cli", "occ_model.program", "occ_model.errors",
    }  # fmt: skip
    assert {"numpy", "cv2", "argparse"} & set(done.stdout.split()) == set()


PROGRAM = """
import os, signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background process inherits another
from occ_model.errors import OccError
from occ_model.program import run_program

def interrupted():
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(5)

def work():
    if what == "works":
        try:
            interrupted()
        finally:
            print("cleared")
    print("done")
    return 0

def prepare():
    if what == "prepares":
        try:
            interrupted()
        finally:
            print("cleared")
    if what == "refuses":
        raise OccError("It cannot be.")
    return work

what = sys.argv[1]
sys.exit(run_program("own", prepare, is_process=True))
"""


def own_program(what: str, redirect: str = "") -> tuple[int, str, str]:
    """Run a small program as a process: its exit code, what it printed, and its errors."""
    shell = ("sh", "-c", f'exec "$@" {redirect}', "sh")
    words = [*shell, sys.executable, "-c", PROGRAM, what]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=60)
    return done.returncode, done.stdout, done.stderr


def test_an_interruption_ends_preparation_at_once_and_lets_work_clear_up() -> None:
    assert own_program("nothing") == (0, "done\n", "")
    assert own_program("prepares") == (130, "", "own: interrupted.\n")
    assert own_program("works") == (130, "cleared\n", "own: interrupted.\n")


def test_errors_go_nowhere_else_where_their_stream_is_closed() -> None:
    assert own_program("refuses") == (2, "", "own: It cannot be.\n")
    assert own_program("refuses", "2>&-") == (2, "", "")


def test_linear_algebra_of_a_program_has_one_thread_unless_told_otherwise() -> None:
    code = """
import os, sys
from occ_model.program import run_program

def prepare():
    assert "numpy" not in sys.modules, "it reads the variable when it is imported"
    print(os.environ["OPENBLAS_NUM_THREADS"])
    return lambda: 0

sys.exit(run_program("x", prepare, is_process=True))
"""
    plain = {k: v for k, v in os.environ.items() if k != "OPENBLAS_NUM_THREADS"}
    for given, wanted in ({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3"):
        done = subprocess.run(
            [sys.executable, "-c", code], env=plain | given, capture_output=True, text=True,
            check=True,
        )  # fmt: skip
        assert done.stdout == f"{wanted}\n"
