"""``occ-model sweep``: its axes, files, figures and messages."""

import csv
import signal
import subprocess
import sys
import time
from argparse import Namespace
from pathlib import Path

import numpy as np
import pytest
from each_case import each_case
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.commands.bars import run_study
from occ_model.commands.sweep import decoders_of
from occ_model.commands.vary import axes_of
from occ_model.errors import OutputError, ParameterError
from occ_model.figures.sweep import write_sweep_figure
from occ_model.receiver.decode import DECODERS
from occ_model.study.sweep.measure import Progress

VARY = ("--vary", "switching_frequency=4kHz:14kHz:10kHz", "--vary", "distance=0.8m,120cm")


@each_case(
    [
        ("switching_frequency=2kHz:20kHz:2kHz", [2000.0 * step for step in range(1, 11)]),
        ("distance=0.6:1.2:0.2", [0.6, 0.8, 1.0, 1.2]),
        ("distance=60cm:100cm:15cm", [0.6, 0.75, 0.9]),
        ("distance=1,80cm,1200mm", [1.0, 0.8, 1.2]),
        ("exposure_time=10us:1ms:x3", [1e-5, 1e-4, 1e-3]),
        ("gamma=1:4:x4", [1.0, 2.0, 3.0, 4.0]),
        ("bits=4:10:3", [4, 7, 10]),
        ("code=0:9:X4", [0, 3, 6, 9]),
        ("bits=2:4:x9", [2, 3, 4]),
        ("averaging=light,pixel-value", ["light", "pixel-value"]),
        (" yaw = -10deg:10deg:10deg", [-np.pi / 18, 0.0, np.pi / 18]),
        ("edge_time=0:2us:x3", [0.0, 1e-6, 2e-6]),
        # From zero there are no even ratios, even on a logarithmic scale.
        ("luminance=0:2000:x3", [0.0, 1000.0, 2000.0]),
    ]
)
def test_axes_are_read_as_people_write_them(text: str, values: list[object]) -> None:
    ((_, found),) = axes_of([text]).items()
    assert found == pytest.approx(values, rel=1e-11) if values[0] != "light" else found == values
    assert {type(value) for value in found} == {type(value) for value in values}


def test_steps_that_reach_the_end_end_there_exactly() -> None:
    for step in ("0.1", "0.3", "0.7", "1/3"):
        values = axes_of([f"distance=0.1:21.1:{step}"])["distance"]
        assert values[-1] == 21.1
        assert len(values) == round(21.0 / eval(step)) + 1


@each_case(
    [
        ("distance", "'distance' is not an axis; allowed: NAME=a,b,c"),
        ("distnce=1", "did you mean distance"),
        ("distance=1:2", "allowed: low:high:step, low:high:xN"),
        ("averaging=a:b:c", "averaging varies over 'a:b:c'; allowed: values with commas"),
        ("averaging=dark", "averaging is 'dark'; allowed: pixel-value, light"),
        ("distance=2:1:0.1", "from a lower to a higher"),
        ("distance=1:2:0", "steps of '0'; allowed: a step above 0"),
        ("distance=1:2:1kHz", "a step above 0"),
        ("distance=1:2:1.1", "no larger than the range"),
        ("exposure_time=10us:30us:10", "no larger than the range"),  # 10 s
        ("bits=2:9:8", "no larger than the range"),
        ("distance=1:2:x1", "varies in 'x1'; allowed: x2 to x"),
        ("distance=1m:2m:1nm", "values; allowed: up to 1000000"),
        ("distance=1:2:1e-320", "distance varies over too many values; allowed: up to 1000000"),
        ("distance=1:2:x" + "9" * 5000, "; allowed: x2 to x1000000 values"),
        ("bits=2:9:" + "9" * 5000, "a step above 0"),
        ("distance=" + "1," * 10**6 + "1", "distance has too many values; allowed: at most 1,000,"),
        ("x" * 10**5, "allowed: NAME=a,b,c"),
        ("distance=1:1e9:1", "distance is 1e"),
        ("distance=1,,2", "distance is '', which is not a number in m"),
        ("bits=2:9:0.5", "a step above 0"),
    ]
)
def test_impossible_axes_are_refused_with_a_sentence(text: str, words: str) -> None:
    with pytest.raises(ParameterError) as refusal:
        axes_of([text])
    assert words in str(refusal.value)
    assert len(str(refusal.value)) < 600


def test_axes_are_refused_before_all_their_points_are_made() -> None:
    wide = ["iso=100:4000:x30", "distance=0.1:2:x30", "rows=100:400:x30", "gamma=1:3:x30"]
    with pytest.raises(ParameterError) as refusal:
        axes_of([*wide, "yaw=0:1:x1000", "no parameter"])
    assert str(refusal.value) == (
        "The sweep has 30 x 30 x 30 x 30 x 1,000 = 810,000,000 points; allowed: at most 1,000,000."
    )


@pytest.mark.usefixtures("plain_figures")
def test_the_command_writes_the_sweeps_table_and_draws_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, plot = tmp_path / "r.csv", tmp_path / "r.png"
    settings = ("--preset", "phone-136us", "--images", "2", "--seed", "4", "--decoder", "both")
    command = ["sweep", *settings, "--jobs", "1", *VARY, "--out", str(out), "--plot", str(plot)]
    assert main(command) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines() == [
        f"{out}: 4 points, 2 rates each",
        f"{plot}: success rate over switching_frequency and distance",
    ]
    assert printed.err == ""  # a bar is for a terminal
    axes = {"switching_frequency": [4e3, 14e3], "distance": [0.8, 1.2]}
    table = occ.sweep(occ.load_preset("phone-136us"), axes, 2, ("threshold", "matched"), 4)
    assert out.read_text() == "".join(table.csv())
    with Image.open(plot) as picture:
        assert "seed 4" in str(picture.info["Description"])
        assert "images a point" in str(picture.info["Description"])


def test_without_a_file_the_table_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sweep", "--vary", "distance=1,1.5", "--images", "1", "--off", "jpeg"]) == 0
    lines = capsys.readouterr().out.splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["distance (m)"] for row in rows] == ["1.0", "1.5"]
    assert "# effects switched: jpeg off" in lines


def test_ctrl_c_keeps_the_results_and_says_how_to_continue(tmp_path: Path) -> None:
    out = tmp_path / "r.csv"
    program = "import sys; from occ_model.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "sweep", "--vary", "iso=100:4000:1", "--images", "9"]
    running = subprocess.Popen(
        [*command, "--out", out],
        stderr=subprocess.PIPE,
        text=True,
        # A shell that runs tests in the background may make them ignore Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    deadline = time.monotonic() + 30
    while not out.exists() or out.read_bytes().count(b",threshold,") < 5:
        assert time.monotonic() < deadline
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    _, error = running.communicate(timeout=30)
    assert running.returncode == 130
    written = out.read_bytes().count(b",threshold,")
    *_, last = error.splitlines()
    count = int(last.split()[3])
    assert 5 <= written < 3901
    assert count <= written <= count + 1  # it may stop just before the count
    assert last == (
        f"occ-model: stopped after {count} of 3901 points; the results are in {out}, and the same "
        "command continues from there."
    )


@pytest.mark.parametrize(
    ("done", "said"),
    [(None, "stopped before the first point"), (4, "stopped after 4 of 27 points")],
)
def test_a_stopped_study_says_how_far_it_came(
    done: int | None, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    def run(progress: Progress) -> None:
        if done is not None:
            progress(done, 27, 1.0)
        raise KeyboardInterrupt

    assert run_study(run, Namespace(out=None)) is None
    assert capsys.readouterr().err.endswith(
        f"occ-model: {said}; with --out FILE.csv the results would be kept.\n"
    )


@pytest.mark.usefixtures("plain_figures")
def test_points_that_the_model_refuses_are_grey_in_a_map(tmp_path: Path) -> None:
    path = tmp_path / "f.png"
    small = occ.load_preset("phone-136us").replace(rows=60, panel_height=0.01)
    write_sweep_figure(path, occ.sweep(small, {"yaw": [0.0, 1.2], "distance": [0.1, 1.0]}, 1))
    with Image.open(path) as picture:
        grey = (np.asarray(picture.convert("RGB")) == 191).all(axis=2)
    assert 0.05 < grey.mean() < 0.3


@pytest.mark.parametrize(
    "words", [("sweep", "--vary", "distance=1", "--images"), ("match", "a.png", "b.png", "--jobs")]
)
def test_a_number_of_too_many_digits_is_refused_in_short(
    words: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([*words, "9" * 5000])
    assert ended.value.code == 2
    *_, last = capsys.readouterr().err.splitlines()
    assert last.startswith(f"occ-model {words[0]}: error: argument {words[-1]}: '999")
    assert last.endswith(" is not a whole number")
    assert len(last) < 1100


def test_both_are_the_quick_decoders_and_all_every_one() -> None:
    assert decoders_of(["both"]) == ("threshold", "matched")
    assert decoders_of(["sequence", "all"]) == tuple(DECODERS)
    assert decoders_of(["sequence", "matched", "sequence"]) == ("sequence", "matched")


def table_of(**axes: object) -> occ.SweepTable:
    return occ.sweep(occ.load_preset("phone-136us"), axes, 1, ("threshold", "matched"))  # type: ignore[arg-type]


def test_a_figure_that_is_impossible_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="varies iso, bits, rows; allowed in a figure: one"):
        write_sweep_figure(tmp_path / "f.png", table_of(iso=[100.0], bits=[10], rows=[100]))
    with pytest.raises(OutputError, match=r"not have the ending of a figure or table; use \.png, "):
        write_sweep_figure(tmp_path / "f.gif", table_of(iso=[100.0]))
    assert list(tmp_path.iterdir()) == []
