"""Whatever happens, the command line ends with an exit code and at most one line of errors."""

import errno
import os
import subprocess
import sys
from pathlib import Path

REDIRECTED = ("sh", "-c", 'exec "$@" {}', "sh")
CLOSED, FULL = ">&-", ">/dev/full"

FULL_DISK = f"own: Writing or reading failed: {os.strerror(errno.ENOSPC)}.\n"


def test_a_closed_output_is_a_sentence_before_any_work(tmp_path: Path) -> None:
    path = tmp_path / "x.png"
    words = [*REDIRECTED, sys.executable, "-m", "occ_model", "render", "-o", str(path)]
    words[2] = words[2].format(CLOSED)
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "occ-model: Standard output is closed; send it to a file or to the null device.\n"
    )
    assert not path.exists()


def test_interruptions_are_answered_before_slow_imports() -> None:
    program = "import sys, occ_model.cli; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    loaded = {name for name in done.stdout.split() if name.startswith("occ_model")}
    assert loaded == {
        "occ_model", "occ_model.cli", "occ_model.program", "occ_model.errors",
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
    if what == "prints":
        print("\\xb5 \\u03a9")
    print("done")
    return 0

def prepare():
    if what == "prepares":
        try:
            interrupted()
        finally:
            print("cleared")
    if what == "refuses":
        raise OccError("It cannot be 1 \\xb5s.")
    return work

what = sys.argv[1]
sys.exit(run_program("own", prepare, is_process=True))
"""


def own_program(what: str, redirect: str = "", encoding: str = "utf-8") -> tuple[int, str, str]:
    """Run a small program as a process: its exit code, what it printed, and its errors."""
    shell, option, line, name = REDIRECTED
    words = [shell, option, line.format(redirect), name, sys.executable, "-c", PROGRAM, what]
    done = subprocess.run(
        words, capture_output=True, encoding=encoding, check=False, timeout=60,
        env={**os.environ, "PYTHONIOENCODING": encoding, "PYTHONUNBUFFERED": ""},
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def test_a_full_output_is_a_sentence() -> None:
    assert own_program("nothing", FULL) == (1, "", FULL_DISK)


def test_a_reader_that_has_stopped_ends_the_program_in_silence() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    words = [sys.executable, "-c", PROGRAM, "nothing"]
    done = subprocess.run(words, stdout=writer, stderr=subprocess.PIPE, check=False)
    os.close(writer)
    assert (done.returncode, done.stderr) == (1, b"")


def test_letters_that_an_encoding_lacks_are_replaced() -> None:
    for encoding, letters, unit in (("ascii", "? ?", r"\xb5s"), ("cp1252", "µ ?", "µs")):
        assert own_program("prints", encoding=encoding) == (0, f"{letters}\ndone\n", "")
        refused = own_program("refuses", encoding=encoding)
        assert refused == (2, "", f"own: It cannot be 1 {unit}.\n")


def test_an_interruption_ends_preparation_at_once_and_lets_work_clear_up() -> None:
    assert own_program("nothing") == (0, "done\n", "")
    assert own_program("prepares") == (130, "", "own: interrupted.\n")
    assert own_program("works") == (130, "cleared\n", "own: interrupted.\n")


def test_errors_go_nowhere_else_where_their_stream_is_closed() -> None:
    assert own_program("refuses") == (2, "", "own: It cannot be 1 µs.\n")
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
