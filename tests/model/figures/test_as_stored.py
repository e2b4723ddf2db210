"""Figures match their stored descriptions of each text, line and patch.

`pytest tests/model/figures/test_as_stored.py --renew-snapshots` stores new descriptions; look at
the figures first. Descriptions are texts, so that a commit shows what has changed.
"""

from collections.abc import Callable
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from accuracy_points import EACH_WAY
from matches import match_with
from matplotlib.figure import Figure
from model.figures.artists import describe_figure, find_cut_texts, is_alike

import occ_model as occ
from occ_model.boards.arduino import UNO
from occ_model.boards.board import TransmitterBoard
from occ_model.boards.pico import PICO
from occ_model.boards.transmission import prepare_transmission
from occ_model.figures import paper
from occ_model.figures.accuracy import accuracy_drawing
from occ_model.figures.bands import bands_drawing, flicker_drawing
from occ_model.figures.bench import bench_drawing
from occ_model.figures.decoding import decode_drawing
from occ_model.figures.drawing import Drawing, house_style
from occ_model.figures.lesson_report import draw_page
from occ_model.figures.sweep import sweep_drawing
from occ_model.figures.transmitter_files import wiring_figure
from occ_model.figures.window_panes import picture_drawing, profile_drawing
from occ_model.results.bit_errors import BenchPoint, BenchRequest, BitErrors
from occ_model.results.frame import Frame
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import RateSettings, ShownQuantity, SweepRequest
from occ_model.results.teaching import AnsweredStep, CheckedAnswer
from occ_model.study.confidence import wilson_interval
from occ_model.study.paper_grid import (
    DISTANCES as PAPERS_DISTANCES,
    FREQUENCIES as PAPERS_FREQUENCIES,
)
from occ_model.teaching.lessons import lessons

STORED = Path(__file__).with_name("stored")
SCENE = occ.load_preset("phone-68us").replace(rows=60, panel_height=2.0)

Compare = Callable[..., None]


@pytest.fixture
def is_as_stored(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Compare a figure with its stored description, or store a new one with --renew-snapshots.

    Placing all texts takes much longer, which only `test_page.py` does.
    """

    def compare(name: str, figure: Figure, *more: object) -> None:
        lines = [*describe_figure(figure), *map(str, more)]
        assert not (request.config.getoption("--whole") and find_cut_texts(figure))
        path = STORED / f"{name}.txt"
        if request.config.getoption("--renew-snapshots"):
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            return
        stored = path.read_text(encoding="utf-8").splitlines()
        assert is_alike(lines, stored), "\n".join(
            f"- {old}\n+ {new}" for old, new in zip(stored, lines, strict=False) if old != new
        )

    return compare


def draw_in_style(drawing: Drawing) -> Figure:
    with house_style():
        return drawing.draw()


@pytest.fixture(scope="module")
def frame() -> Frame:
    return occ.render(SCENE, tolerance=np.inf)


@pytest.mark.parametrize("board", [UNO, PICO], ids=lambda board: board.name)
def test_the_circuit_of_a_board(board: TransmitterBoard, is_as_stored: Compare) -> None:
    with house_style():
        figure = wiring_figure(prepare_transmission(occ.load_preset("phone-68us"), board))
    is_as_stored(f"wiring-{board.name}", figure)


def test_the_errors_over_the_time(is_as_stored: Compare) -> None:
    drawing = accuracy_drawing(EACH_WAY)
    is_as_stored("accuracy", draw_in_style(drawing), *drawing.header, *drawing.rows())


def test_the_bit_errors_of_a_bench(is_as_stored: Compare) -> None:
    request = BenchRequest(decoders=("threshold", "sequence"), exposures=(0.5, 2.0, 4.0))
    points = [
        BenchPoint(
            "manchester", axis, exposure, decibels,
            BitErrors(decoder, 1000, wrong, 0.0 if wrong == 30 else wrong / 1400,
                      (wrong + 9) / 900, 10, 10 - wrong // 100, 0.5, 0.9, 0.01, 0.02),
            "why" * (wrong > 200),
        )
        for axis, places in (
            ("exposure", [(0.5, 30.0), (2.0, 30.0), (4.0, 30.0)]),
            ("noise", [(4.0, 10.0), (4.0, 30.0)]),
        )
        for step, (exposure, decibels) in enumerate(places)
        for decoder, wrong in (("threshold", 250 * step + 20), ("sequence", 30 * step))
    ]  # fmt: skip
    drawing = bench_drawing(request, points, 30.0)
    is_as_stored("bench", draw_in_style(drawing), *drawing.header, *drawing.rows())


def table_of(axes: dict[str, tuple[float, ...]]) -> SweepTable:
    """Return rates of two decoders that decrease along the axes; the last point is refused."""
    decoders = ("threshold", "matched")
    shape = tuple(map(len, axes.values()))
    sent = np.full(shape, 100)
    fall = np.add.outer(*map(np.arange, shape)) if len(shape) == 2 else np.arange(*shape)
    right = np.stack([np.maximum(100 - 9 * fall, 0), np.maximum(100 - 4 * fall, 0)], axis=-1)
    sent.flat[-1], right.reshape(-1, 2)[-1] = 0, 0
    ends = np.array([
        [wilson_interval(int(r), int(n)) if n else (np.nan, np.nan) for r in each]
        for each, n in zip(right.reshape(-1, 2), sent.flat, strict=True)
    ]).reshape(*shape, 2, 2)  # fmt: skip
    settings = RateSettings(10, decoders, 3, 0.5, {}, "auto", 30.0)
    request = SweepRequest(occ.load_preset("phone-68us"), axes, settings)
    notes = {int(sent.size) - 1: "The panel is behind the camera."}
    return SweepTable(
        request, sent, right, ends[..., 0], ends[..., 1], notes, right // 10
    )  # fmt: skip


FREQUENCIES = (1e3, 2e3, 4e3, 8e3, 16e3)
DISTANCES = (0.5, 1.0, 1.5, 2.0)


@pytest.mark.parametrize("shown", ["rate", "bits"])
@pytest.mark.parametrize("count", [1, 2])
def test_the_rates_of_a_sweep(count: int, shown: ShownQuantity, is_as_stored: Compare) -> None:
    axes = {"switching_frequency": FREQUENCIES, "distance": DISTANCES}
    drawing = sweep_drawing(table_of(dict(list(axes.items())[:count])), shown)
    is_as_stored(f"sweep-{count}-{shown}", draw_in_style(drawing), *drawing.header, *drawing.rows())


def test_the_papers_maps_of_rates(is_as_stored: Compare, monkeypatch: pytest.MonkeyPatch) -> None:
    axes = {"switching_frequency": PAPERS_FREQUENCIES, "distance": PAPERS_DISTANCES}
    with house_style():
        figure = paper.rate_maps({"one": table_of(axes), "two": table_of(axes)})
    is_as_stored("paper-rates", figure)


class KeptFigures:
    """Keeps figures and tables that would be written to files."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.figures: list[Figure] = []
        self.tables: list[list[object]] = []
        monkeypatch.setattr(paper, "save_figure", lambda one, *_: self.figures.append(one))
        monkeypatch.setattr(
            paper, "write_table", lambda _path, header, rows, _: self.tables.append(
                [*header, *[row for place, row in enumerate(rows) if place % 97 == 0]]
            )
        )  # fmt: skip
        monkeypatch.setattr(
            paper,
            "load_preset",
            lambda name: occ.load_preset(name).replace(rows=60, panel_height=0.02),
        )


def test_the_papers_process_and_profile(
    is_as_stored: Compare, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    written = KeptFigures(monkeypatch)
    with house_style():
        paper.write_process_figure(tmp_path)
        paper.write_profile_figure(tmp_path, 3, "phone-68us", None)
        paper.write_profile_figure(tmp_path, 4, "phone-136us", None)
    for name, figure, table in zip(
        ("process", "profile", "profile-without-band"), written.figures, written.tables,
        strict=True,
    ):  # fmt: skip
        is_as_stored(f"paper-{name}", figure, *table)


@pytest.mark.parametrize("decoder", ["threshold", "matched"])
def test_the_steps_of_a_decoder(decoder: str, frame: Frame, is_as_stored: Compare) -> None:
    drawing = decode_drawing(SCENE, occ.decode(frame.image, SCENE, decoder))
    rows = [row for place, row in enumerate(drawing.rows()) if place % 97 == 0]
    is_as_stored(f"decoding-{decoder}", draw_in_style(drawing), *drawing.header, *rows)


def test_a_decoding_that_failed_at_once(is_as_stored: Compare) -> None:
    result = occ.DecodeResult("threshold", failure="The panel is not in the picture.")
    drawing = decode_drawing(SCENE, result)
    is_as_stored("decoding-failed", draw_in_style(drawing), *drawing.header, *drawing.rows())


def test_the_picture_and_its_profile(frame: Frame, is_as_stored: Compare) -> None:
    region = occ.decode(frame.image, SCENE).region
    picture = picture_drawing(frame, region, frame.image, about="the same again")
    is_as_stored("picture", draw_in_style(picture), *list(picture.rows())[:2])
    photo = occ.compare(frame.profile[800:2000] * 0.7 + 3.0, frame.profile, 800.0)
    profile = profile_drawing(frame, occ.band_profile(SCENE), comparison=photo)
    rows = [row for place, row in enumerate(profile.rows()) if place % 97 == 0]
    is_as_stored("profile", draw_in_style(profile), *profile.header, *rows)
    plain = profile_drawing(frame, None, "It is undefined.", columns=slice(400, 900))
    is_as_stored("profile-alone", draw_in_style(plain))


def test_a_page_of_a_report(is_as_stored: Compare) -> None:
    (sheet, *_) = [lesson for lesson in lessons().lessons if lesson.is_sheet]
    match = match_with(scene=SCENE, reasons=("Only 1.2 periods of 4 chips are in view.",))
    answer = CheckedAnswer("about 12", "right", "That is what the picture shows.")
    step = sheet.steps[-1]
    scene = SCENE.replace(columns=600)
    steps = [AnsweredStep(step, answer, scene), AnsweredStep(step, None, scene, match, "mine.jpg")]
    with house_style():
        figure = draw_page("A sheet", "by somebody", "page 1 of 1", steps, 3)
    is_as_stored("report", figure)


def test_the_bars_and_the_flicker(is_as_stored: Compare) -> None:
    lamp = SCENE.replace(pattern="1110", switching_frequency=800.0, exposure_time=2e-3)
    bars, flicker = bands_drawing(lamp), flicker_drawing(lamp)
    is_as_stored("bands", draw_in_style(bars), *bars.header, *islice(bars.rows(), 3))
    is_as_stored("flicker", draw_in_style(flicker), *flicker.header, *flicker.rows())
