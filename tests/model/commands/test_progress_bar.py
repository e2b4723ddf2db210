"""A progress bar stops no command, neither by the user's settings nor by a full disk."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from occ_model.commands.options import print_above_bar, progress_bar


def test_the_users_settings_of_tqdm_do_not_affect_bars() -> None:
    program = (
        "from occ_model.commands.options import progress_bar\n"
        "with progress_bar(total=1, disable=False) as bar: bar.update()\n"
    )
    settings = {"TQDM_MININTERVAL": "abc", "TQDM_NCOLS": "abc", "TQDM_ASCII": "x"}
    done = subprocess.run(
        [sys.executable, "-c", program],
        stderr=subprocess.PIPE,
        env={**os.environ, **settings},
        text=True,
        check=True,
    )
    assert "1/1" in done.stderr


def test_a_bar_that_cannot_be_written_stops_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    with Path("/dev/full").open("w") as full:
        monkeypatch.setattr(sys, "stderr", full)
        with progress_bar(total=2, disable=False, mininterval=0.0) as bar:
            for _ in range(2):
                bar.update()
        print_above_bar("A sentence.")
