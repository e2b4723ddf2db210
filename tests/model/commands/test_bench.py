"""The command ``occ-model bench``: its table, its files, its refusals."""

import csv
from pathlib import Path

import pytest

from occ_model.cli import main

FEW = ("--exposure", "1", "--snr", "30", "--bits", "64", "--payload-bits", "64")


@pytest.mark.whole
def test_the_bench_prints_and_writes_one_table(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    folder = tmp_path / "bench"
    decoders = ("--decoder", "threshold", "--decoder", "sequence")
    assert main(["bench", *FEW, *decoders, "--out", str(folder)]) == 0
    printed = capsys.readouterr().out.splitlines()
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


def test_a_decoder_that_reads_nothing_says_why(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", *FEW, "--decoder", "threshold"]) == 0
    *_, reason = capsys.readouterr().out.splitlines()
    assert reason.startswith("threshold: ")
    assert reason.endswith(".")
