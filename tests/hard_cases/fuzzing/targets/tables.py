"""Tables: the results of a sweep that is resumed, and the table of many photos."""

import csv
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import damage
import damaged_photos
import numpy as np

import occ_model as occ
from hard_cases.fuzzing.mutations import encode_text, mutate_text, random_number
from hard_cases.fuzzing.target import FuzzTarget
from occ_model.errors import one_line
from occ_model.photo.many.other_programs import lines_to_paste
from occ_model.results.photo_table import csv_text
from occ_model.results.sweep_csv import csv_row
from occ_model.results.sweep_request import RateSettings, SweepPoint, SweepRequest
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.sweep.request_check import build_request
from occ_model.study.sweep.sweep import run_sweep


@cache
def _sweep() -> tuple[SweepRequest, bytes]:
    """Return a small sweep, whose first points the model refuses, and its complete table."""
    scene = occ.load_preset("phone-136us").replace(yaw=1.3, rows=20, panel_height=0.01)
    axes = {"distance": [0.1, 1.0, 1.8], "switching_frequency": [4e3, 15e3]}
    request = build_request(scene, axes, RateSettings(1, ("threshold", "matched"), 3))
    with TemporaryDirectory() as folder:
        path = Path(folder, "results.csv")
        run_sweep(request, results=path)
        return request, path.read_bytes()


def _replace_counts(random: Random, request: SweepRequest, whole: bytes) -> bytes:
    """Replace counts in the rows of a point, and the rates and intervals computed from them."""
    lines = whole.decode().splitlines(keepends=True)
    first = next(place for place, line in enumerate(lines) if line[0] != "#") + 1
    first += len(request.settings.decoders) * random.randrange(request.point_count)
    for place in range(first, first + len(request.settings.decoders)):
        row = next(csv.reader([lines[place]]))
        for cell in random.sample((5, 6, 10), random.choice((1, 1, 2))):
            row[cell] = (
                random_number(random) if random.random() < 0.7 else str(random.randint(-9, 30))
            )
        try:
            right, sent, read = (int(row[cell]) for cell in (5, 6, 10))
            index = (place - first) // len(request.settings.decoders)
            row[7] = repr(100.0 * right / sent)
            row[8], row[9] = map(repr, interval_of_pictures(right, sent, request.settings.images))
            point = SweepPoint(index, sent, (right,), "", (read,))
            row[11] = repr(request.bits_a_second(point, 0))
        except (ValueError, ArithmeticError):
            pass
        lines[place] = csv_row(row)
    return "".join(lines).encode()


def _resume_sweep(random: Random, folder: Path) -> list[str]:
    request, whole = _sweep()
    path = folder / "results.csv"
    kind = random.random()
    if kind < 0.3:
        content = _replace_counts(random, request, whole)
    elif kind < 0.5:
        content = encode_text(random, mutate_text(random, whole.decode()))
    elif kind < 0.7:
        content = whole[: random.randrange(len(whole))]
    else:
        content = damage.damage_bytes(np.random.default_rng(random.getrandbits(32)), whole)
    path.write_bytes(content)
    try:
        table = run_sweep(request, results=path)
    except occ.OutputError:
        assert path.read_bytes() == content, "a refused file was changed"
        raise
    bits = request.scene.transmitter.payload_length
    for point in table.each_point():
        assert point.sent in (0, request.settings.images * bits)
        for right, read in zip(point.right, point.whole, strict=True):
            assert 0 <= read * bits <= right <= point.sent
    assert kind < 0.3 or path.read_bytes() == whole
    return []


_PHOTO_NAMES = ("photo", "a,b", "a;b", "=1+1", "a\nb", "é", "#")


def _match_photos(random: Random, folder: Path) -> list[str]:
    scene = occ.load_preset("phone-68us").replace(pattern="10", switching_frequency=5e3)
    paths = []
    for number in range(random.choice((1, 2, 4))):
        make = random.choice((damaged_photos.make_damaged, damaged_photos.make_unusual))
        path = folder / f"{random.choice(_PHOTO_NAMES)}-{number}"
        path.write_bytes(make(random.getrandbits(32))[1])
        paths.append(path)
    table = occ.match_photos(paths, scene, estimate=random.choice(("readout_time",)), jobs=1)
    assert [row.path for row in table.rows] == paths
    text = csv_text(table, list(lines_to_paste(table).values()))
    data = text[text.index("\nfile,") + 1 :]
    rows = list(csv.DictReader(data.splitlines(keepends=True), strict=True))
    assert [row["file"] for row in rows] == [one_line(str(path), 10_000) for path in paths]
    assert [row["verdict"] for row in rows] == [row.verdict for row in table.rows]
    return [*table.notes, *(row.note for row in table.rows if row.note)]


def _try_any(random: Random, folder: Path) -> list[str]:
    return random.choice((_resume_sweep, _resume_sweep, _match_photos))(random, folder)


TABLES = FuzzTarget(
    "tables", "results of a resumed sweep, many photos", _try_any,
    (occ.OutputError, occ.PhotoError, occ.SceneFileError, occ.ParameterError), fraction=40,
    patience=20.0,
)  # fmt: skip
