"""Laws of a sweep's file: what is written stays, and only the same sweep continues it."""

import csv
import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from amount import amount

import occ_model as occ
from occ_model.errors import quote
from occ_model.results.sweep import SweepTable
from occ_model.scene.scene import Scene

BOTH = ("threshold", "matched")
AXES: dict[str, list[float]] = {"distance": [0.1, 1.0, 1.8], "switching_frequency": [4e3, 15e3]}
REFUSED = {"yaw": 1.3, "rows": 60, "panel_height": 0.01}


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A scene whose nearest points the model refuses."""
    return occ.load_preset("phone-136us").replace(**REFUSED)


def run_sweep(scene: Scene, file: Path | None, **others: object) -> SweepTable:
    settings = {"axes": AXES, "images": 1, "decoder": BOTH, "seed": 3, **others}
    return occ.sweep(scene, results=file, **settings)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def table(scene: Scene) -> SweepTable:
    found = run_sweep(scene, None)
    assert len(found.notes) == 2
    return found


@pytest.fixture(scope="module")
def complete_file(table: SweepTable) -> bytes:
    """Return the contents of a complete file."""
    return "".join(table.csv()).encode()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "r.csv"


def header_size(complete_file: bytes) -> int:
    names = complete_file.index(b"\ndistance (m),") + 1
    return complete_file.index(b"\n", names) + 1


def test_the_file_is_the_table_in_order_with_its_scene(
    scene: Scene, table: SweepTable, complete_file: bytes, path: Path
) -> None:
    assert run_sweep(scene, path) == table
    assert path.read_bytes() == complete_file
    table.to_csv(path.with_name("t.csv"))
    assert path.with_name("t.csv").read_bytes() == complete_file
    lines = complete_file.decode().splitlines()
    comments = "\n".join(line[2:] for line in lines if line.startswith("#"))
    assert Scene.from_toml(comments[comments.index("format = 1\n") :]) == scene
    assert f"occ_model {occ.__version__}" in comments
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [float(row["success rate (%)"] or "nan") for row in rows] == pytest.approx(
        [float("nan") if row.rate is None else row.rate for row in table.rows], nan_ok=True
    )
    assert rows[0]["note"] == table.rows[0].note != ""


def test_a_complete_file_is_read_and_nothing_is_measured(
    scene: Scene, table: SweepTable, complete_file: bytes, path: Path
) -> None:
    path.write_bytes(complete_file)
    counts: list[int] = []
    assert run_sweep(scene, path, progress=lambda done, *_: counts.append(done)) == table
    assert counts == [6]
    assert path.read_bytes() == complete_file


def test_a_truncated_file_is_completed_with_the_missing_points(
    scene: Scene,
    table: SweepTable,
    complete_file: bytes,
    path: Path,
) -> None:
    begin = header_size(complete_file)
    cuts = {
        0,
        1,
        begin - 1,
        begin,
        begin + 1,
        len(complete_file) - 1,
        *range(begin, len(complete_file), amount(211, 61)),
    }
    for cut in sorted(cuts):
        path.write_bytes(complete_file[:cut])
        counts: list[int] = []
        assert run_sweep(scene, path, progress=lambda done, *_, c=counts: c.append(done)) == table
        assert path.read_bytes() == complete_file
        there = complete_file[begin:cut].count(b"\n") // len(BOTH)
        assert sorted({there, *counts}) == list(range(there, 7))  # each measured point adds one


def test_a_file_with_rows_in_any_order_is_continued_and_sorted(
    scene: Scene, table: SweepTable, complete_file: bytes, path: Path
) -> None:
    begin = header_size(complete_file)
    lines = complete_file[begin:].splitlines(keepends=True)
    points = [b"".join(lines[first : first + 2]) for first in range(0, len(lines), 2)]
    path.write_bytes(complete_file[:begin] + points[4] + points[0] + points[5])
    assert run_sweep(scene, path) == table
    assert path.read_bytes() == complete_file


@pytest.mark.parametrize(
    ("others", "words"),
    [
        ({"seed": 4}, "'seed 3, of every point' where this one has 'seed 4"),
        ({"images": 2}, "images 1"),
        ({"decoder": "matched"}, "decoders threshold, matched"),
        ({"axes": {**AXES, "distance": [0.1, 1.0]}}, "axis distance"),
        ({"axes": dict(reversed(AXES.items()))}, "Success rate over distance"),
        ({"tolerance": 0.25}, "tolerance 0.5"),
        ({"force": {"jpeg": False}}, "effects switched: none"),
        ({"path": "image"}, "path auto"),
    ],
)
def test_the_file_of_another_sweep_is_refused_and_unchanged(
    scene: Scene, complete_file: bytes, path: Path, others: dict[str, object], words: str
) -> None:
    path.write_bytes(complete_file)
    with pytest.raises(occ.OutputError, match=f"contains the results of another sweep.*{words}"):
        run_sweep(scene, path, **others)
    assert path.read_bytes() == complete_file


def test_another_scene_or_format_is_another_sweep(
    scene: Scene, complete_file: bytes, path: Path
) -> None:
    path.write_bytes(complete_file)
    with pytest.raises(occ.OutputError, match=r"'iso = 100.0' where this one has 'iso = 200.0'"):
        run_sweep(scene.replace(iso=200.0), path)
    path.write_bytes(complete_file.replace(b"\n", b"\r\n"))
    with pytest.raises(occ.OutputError, match="was changed by another program"):
        run_sweep(scene, path)
    newer = complete_file.replace(b"# format 3 of", b"# format 4 of")
    path.write_bytes(newer)
    with pytest.raises(occ.OutputError, match="format 4"):
        run_sweep(scene, path)
    assert path.read_bytes() == newer


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text + b"1.0,4000.0,threshold,1,3,10,10,100.0,1,1,\n" * 2,
        lambda text: text + b"hello\nworld\n",
        lambda text: text.replace(b",matched,1,3,", b",matched,1,4,", 1),
        lambda text: text + b"".join(text.splitlines(keepends=True)[-2:]),
        lambda text: text + b"\0" * 30 + b"\n\n",
        lambda text: text + b"1" * 100_000,
    ],
)
def test_foreign_lines_are_refused_and_kept(
    scene: Scene, complete_file: bytes, path: Path, change: Callable[[bytes], bytes]
) -> None:
    path.write_bytes(change(complete_file))
    with pytest.raises(occ.OutputError, match=r"Line \d+ of .* is not a new row of this sweep"):
        run_sweep(scene, path)
    assert path.read_bytes() == change(complete_file)


RIGHT, SENT, READ = 5, 6, 10  # the cells of a row with two axes

HUGE = "9" * 5000


@pytest.mark.parametrize(
    ("cells", "said"),
    [
        ({RIGHT: "-10"}, "right bits is '-10'; allowed: 10."),
        ({RIGHT: "11"}, "right bits is '11'; allowed: 10."),
        ({RIGHT: "9"}, "right bits is '9'; allowed: 10."),
        ({RIGHT: "nan"}, "right bits is 'nan'; allowed: 10."),
        ({RIGHT: "1e1"}, "right bits is '1e1'; allowed: 10."),
        ({RIGHT: "\u0661"}, "right bits is '\u0661'; allowed: 10."),
        ({RIGHT: HUGE}, f"right bits is {quote(HUGE)}; allowed: 10."),
        ({RIGHT: "12", READ: "0"}, "right bits is '12'; allowed: 0 to 9."),
        ({RIGHT: "10", READ: "0"}, "right bits is '10'; allowed: 0 to 9."),
        ({SENT: "20"}, "sent bits is '20'; allowed: 10."),
        ({SENT: "-10"}, "sent bits is '-10'; allowed: 10."),
        ({SENT: ""}, "sent bits is ''; allowed: 10."),
        ({SENT: "inf"}, "sent bits is 'inf'; allowed: 10."),
        ({READ: "2"}, "images read whole is '2'; allowed: 0 to 1."),
        ({READ: "-1"}, "images read whole is '-1'; allowed: 0 to 1."),
    ],
)
def test_impossible_counts_are_refused_with_line_and_value(
    scene: Scene, complete_file: bytes, path: Path, cells: dict[int, str], said: str
) -> None:
    lines = complete_file.decode().splitlines()
    place = next(n for n, line in enumerate(lines) if line.startswith("1.0,15000.0,matched,"))
    row = lines[place].split(",")
    assert (row[RIGHT], row[SENT], row[READ]) == ("10", "10", "1")
    for cell, count in cells.items():
        row[cell] = count
    if cells.keys() == {RIGHT} and cells[RIGHT] in ("11", "9"):  # the values derived from it agree
        row[7] = repr(10.0 * int(cells[RIGHT]))
    content = "\n".join([*lines[:place], ",".join(row), *lines[place + 1 :], ""]).encode()
    path.write_bytes(content)
    with pytest.raises(occ.OutputError) as refused:
        run_sweep(scene, path)
    assert str(refused.value) == (
        f"{path}, line {place + 1}: {said} Correct or remove the line, or name another file."
    )
    assert path.read_bytes() == content


def test_counts_with_a_varied_payload_are_limited_by_its_own_bits(scene: Scene, path: Path) -> None:
    axes = {"distance": [1.0], "bits": [10, 12]}
    found = run_sweep(scene, path, axes=axes)
    assert found.sent.tolist() == [[10, 12]]
    assert run_sweep(scene, path, axes=axes) == found
    path.write_bytes(path.read_bytes().replace(b",12,100.0,", b",10,100.0,"))
    with pytest.raises(occ.OutputError, match=r"sent bits is '10'; allowed: 12\."):
        run_sweep(scene, path, axes=axes)


def test_a_path_that_cannot_hold_results_is_refused(scene: Scene, tmp_path: Path) -> None:
    foreign = tmp_path / "foreign.csv"
    foreign.write_text("a,b\n1,2\n")
    for path, words in (
        (foreign, "contains no results of a sweep; name another file"),
        (tmp_path, "is a folder"),
        (Path(os.devnull), "is a device"),
        (tmp_path / "no" / "r.csv", "its folder does not exist; name one that does"),
        (foreign / "r.csv", "cannot be written: Not a directory"),
    ):
        with pytest.raises(occ.OutputError, match=words):
            run_sweep(scene, path)
    assert foreign.read_text() == "a,b\n1,2\n"


@pytest.mark.parametrize("space", [0, 1, 3, 4.5])
def test_a_full_disk_gives_a_sentence_and_keeps_what_was_written(
    scene: Scene,
    table: SweepTable,
    complete_file: bytes,
    path: Path,
    monkeypatch: pytest.MonkeyPatch,
    space: float,
) -> None:
    real, left = os.write, space

    def write(descriptor: int, text: memoryview) -> int:
        nonlocal left
        left -= 1
        if left < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return real(descriptor, text[:40] if left == 0.5 else text)

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", write)
        with pytest.raises(occ.OutputError, match="cannot be written: No space left on device"):
            run_sweep(scene, path)
    kept = path.read_bytes()
    assert kept == b"" or kept.endswith(b"\n")
    assert kept.count(b"\n") == (
        0 if space < 1 else complete_file[: header_size(complete_file)].count(b"\n")
    ) + (2 * max(0, int(space) - 1 - (space == 4.5)))
    assert run_sweep(scene, path) == table


def test_two_sweeps_on_one_file_are_refused(
    scene: Scene, table: SweepTable, complete_file: bytes, path: Path
) -> None:
    refusals: list[str] = []

    def second(done: int, *_: object) -> None:
        if done == 2:
            with pytest.raises(occ.OutputError) as refusal:
                run_sweep(scene, path)
            refusals.append(str(refusal.value))

    assert run_sweep(scene, path, progress=second) == table
    assert refusals == [
        f"{path} is being written by another sweep; wait for it, or name another file."
    ]
    assert path.read_bytes() == complete_file


def test_a_link_is_followed(scene: Scene, complete_file: bytes, path: Path) -> None:
    link = path.with_name("link.csv")
    link.symlink_to(path)
    run_sweep(scene, link)
    assert link.is_symlink()
    assert path.read_bytes() == complete_file


def test_results_are_not_appended_to_a_write_protected_file(
    scene: Scene, complete_file: bytes, path: Path
) -> None:
    part = complete_file[: header_size(complete_file)]
    path.write_bytes(part)
    path.chmod(0o444)
    with pytest.raises(occ.OutputError, match=r"r\.csv is write-protected; name another file"):
        run_sweep(scene, path)
    assert path.read_bytes() == part
