"""The command ``occ-model bench``: its table, its files, its refusals."""

import csv
from pathlib import Path

import pytest
from model.commands.conftest import Command

FEW = ("--exposure", "1", "--snr", "30", "--bits", "64", "--payload-bits", "64")


@pytest.mark.whole
def test_the_bench_prints_and_writes_one_table(run: Command, tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    decoders = ("--decoder", "threshold", "--decoder", "sequence")
    printed = run("bench", *FEW, *decoders, "--out", folder).lines
    assert [line.split()[:4] for line in printed[1:5]] == [
        ["manchester", "threshold", "1", "30"],
        ["manchester", "sequence", "1", "30"],
        ["manchester", "threshold", "4", "30"],
        ["manchester", "sequence", "4", "30"],
    ]
    lines = (folder / "bench.csv").read_text("utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["decoder"] for row in rows] == ["threshold", "sequence"] * 2
    assert rows[0]["bit error rate"] == "0.0"
    for ending in ("pdf", "png"):
        assert (folder / f"bench.{ending}").stat().st_size > 1000


def test_a_decoder_that_reads_nothing_says_why(run: Command) -> None:
    *_, reason = run("bench", *FEW, "--decoder", "threshold").lines
    assert reason.startswith("threshold: ")
    assert reason.endswith(".")
