"""No command overwrites a file that it reads, or another that it writes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from matches import match_with
from program_options import all_actions

from occ_model.cli import main
from occ_model.commands import match
from occ_model.commands.files import INPUTS, OUTPUTS, is_same_file


def test_every_option_that_names_a_file_is_known() -> None:
    """A new command must declare what it reads and writes."""
    assert {each.dest for each in all_actions() if each.type is Path} == {*INPUTS, *OUTPUTS}


def test_paths_are_one_file_whatever_way_they_take(tmp_path: Path) -> None:
    assert not is_same_file(tmp_path / "q.png", tmp_path / "p.png")
    assert not is_same_file(tmp_path / "a" / "q.png", tmp_path / "b" / "q.png")
    assert is_same_file(tmp_path / "a" / "q.png", tmp_path / "a" / "." / "q.png")


def test_names_that_are_not_utf_8_are_read_written_and_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(match, "match_photo", lambda *_, **__: match_with())
    name = os.fsdecode(b"caf\xe9 \xff\xfe \x1b[31m")
    picture, scene, table = (tmp_path / (name + ending) for ending in (".png", ".toml", ".csv"))

    def run(*words: str | Path) -> None:
        assert main(list(map(str, words))) == 0
        assert all(line.isprintable() for line in capsys.readouterr().out.splitlines())

    command = [sys.executable, "-m", "occ_model", "render", "--set", "rows=60", "-o"]
    done = subprocess.run([*command, str(picture)], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    shown = done.stdout.decode("utf-8")
    assert ".png: " in shown
    assert all(line.isprintable() for line in shown.splitlines())
    run("match", picture, "--out", scene)
    run("plan", "--scene", scene)
    run("sweep", "--vary", "iso=100", "--images", "1", "--out", table)
    run("plan", "--scene", table)
    assert sorted(tmp_path.iterdir()) == sorted((picture, scene, table))
