"""A progress bar stops no command: not by the user's settings, nor by a disk that is full."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

SWEEP = ["sweep", "--vary", "distance=1m", "--images", "1", "--set", "rows=60"]


def run(error: int, **settings: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "occ_model", *SWEEP],
        stdout=subprocess.PIPE,
        stderr=error,
        env={**os.environ, **settings},
        check=False,
    )


@pytest.mark.parametrize(
    "setting",
    [
        "MININTERVAL=abc",
        pytest.param("NCOLS=abc", marks=pytest.mark.whole),
        pytest.param("ASCII=x", marks=pytest.mark.whole),
    ],
)
def test_the_users_settings_of_tqdm_stop_no_sweep(setting: str) -> None:
    name, _, value = setting.partition("=")
    done = run(subprocess.DEVNULL, **{f"TQDM_{name}": value})
    assert (done.returncode, done.stdout.splitlines()[-1][:4]) == (0, b"1.0,")


def test_a_bar_that_cannot_be_written_loses_no_result() -> None:
    with Path("/dev/full").open("wb", buffering=0) as full:
        done = run(full.fileno())
    assert (done.returncode, done.stdout.splitlines()[-1][:4]) == (0, b"1.0,")
