"""The command ``occ-model bench``: its table, its files, its refusals."""

import csv
from pathlib import Path

import pytest
from model.study.bench.test_data_set import make_data_set

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


def test_a_data_set_is_read_by_its_table(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    table = make_data_set(tmp_path, (2.0,))
    name = "\x1b[31m0.png"  # which would colour the rest of a terminal
    (tmp_path / "images" / "0.png").rename(tmp_path / "images" / name)
    table.write_text(table.read_text("utf-8").replace("0.png", name), "utf-8")
    assert main(["bench", "--data", str(table), "--decoder", "sequence"]) == 0
    _, line = capsys.readouterr().out.splitlines()
    picture, exposure, rows, decoder, chips, correlation, _ = line.split()
    assert (picture, exposure, rows, decoder) == (
        r"\x1b[31m0.png", "2.00", "5.0", "sequence",
    )  # fmt: skip
    assert int(chips) > 200
    assert float(correlation) > 0.99
