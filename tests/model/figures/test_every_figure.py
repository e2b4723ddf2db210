"""Every figure draws the numbers of its table, tells its parts apart and fits its page."""

from collections.abc import Callable, Iterable
from functools import partial

import numpy as np
import pytest
from accuracy_points import EACH_WAY
from amount import amount
from matches import match_with
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from model.figures.cut_texts import find_cut_texts

import occ_model as occ
from occ_model.arrays import FloatArray
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
from occ_model.figures.window_panes import profile_drawing
from occ_model.results.bit_errors import BenchPoint, BenchRequest, BitErrors
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import RateSettings, ShownQuantity, SweepRequest
from occ_model.results.teaching import AnsweredStep, CheckedAnswer
from occ_model.study.confidence import wilson_interval
from occ_model.study.paper_grid import (
    DISTANCES as PAPERS_DISTANCES,
    FREQUENCIES as PAPERS_FREQUENCIES,
)
from occ_model.teaching.lessons import lessons

SCENE = occ.load_preset("phone-68us").replace(rows=60, panel_height=2.0)


def bench_figure() -> Drawing:
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
    return bench_drawing(request, points, 30.0)


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


def sweep_figure(count: int, shown: ShownQuantity) -> Drawing:
    axes = {"switching_frequency": FREQUENCIES, "distance": DISTANCES}
    return sweep_drawing(table_of(dict(list(axes.items())[:count])), shown)


def profile_figure() -> Drawing:
    frame = occ.render(SCENE, tolerance=np.inf)
    photo = occ.compare(frame.profile[800:2000] * 0.7 + 3.0, frame.profile, 800.0)
    return profile_drawing(frame, occ.band_profile(SCENE), comparison=photo)


def decoding_figure(decoder: str) -> Drawing:
    frame = occ.render(SCENE, tolerance=np.inf)
    return decode_drawing(SCENE, occ.decode(frame.image, SCENE, decoder))


LAMP = SCENE.replace(pattern="1110", switching_frequency=800.0, exposure_time=2e-3)
GREYS = "(grey level)"

DRAWN: dict[str, tuple[Callable[[], Drawing], dict[str, float]]] = {
    # what the table lists, as it is called there, and the factor by which the figure's unit differs
    "accuracy": (
        partial(accuracy_drawing, EACH_WAY), {"time (ms)": 1.0, "error (levels)": 1.0},
    ),
    "bench": (
        bench_figure,
        dict.fromkeys(("exposure (symbols)", "signal to noise (dB)", "bit error rate", "low",
                       "high", "bits a second", "bits from", "bits to"), 1.0),
    ),
    "rates": (
        partial(sweep_figure, 1, "rate"),
        {"switching_frequency (Hz)": 1e-3, "success rate (%)": 1.0, "95 % from (%)": 1.0},
    ),
    "bits": (
        partial(sweep_figure, 1, "bits"), {"switching_frequency (Hz)": 1e-3, "bits a second": 1.0},
    ),
    "map of rates": (partial(sweep_figure, 2, "rate"), {"success rate (%)": 1.0}),
    "map of bits": (partial(sweep_figure, 2, "bits"), {"bits a second": 1.0}),
    "threshold": (
        partial(decoding_figure, "threshold"),
        {"column of the region": 1.0, f"signal {GREYS}": 1.0},
    ),
    "matched": (
        partial(decoding_figure, "matched"),
        {"column of the region": 1.0, f"signal {GREYS}": 1.0},
    ),
    "profile": (
        profile_figure,
        {f"{name} {GREYS}": 1.0 for name in ("simulation", "band model", "photo, fitted levels")},
    ),
    "bars": (
        partial(bands_drawing, LAMP),
        {"exposure from (s)": 1.0, "exposure to (s)": 1.0, "least depth (%)": 1.0},
    ),
    "flicker": (partial(flicker_drawing, LAMP), {"modulation (%)": 1.0}),
}  # fmt: skip


def numbers_of(figure: Figure) -> FloatArray:
    """Return all numbers that the lines, points and images of a figure have, in order."""
    found: list[FloatArray] = []

    def add(values: object) -> None:
        found.append(np.ma.filled(np.ma.asarray(values, dtype=float), np.nan).ravel())

    for ax in figure.axes:
        for line in ax.lines:
            add(line.get_xdata())
            add(line.get_ydata())
        for image in ax.images:
            add(image.get_array())
        for collection in ax.collections:
            add(collection.get_offsets())
            for path in collection.get_paths():
                add(path.vertices)
            if collection.get_array() is not None:
                add(collection.get_array())
    numbers = np.concatenate(found)
    return np.unique(numbers[np.isfinite(numbers)])


def find_numbers(cells: Iterable[object]) -> FloatArray:
    """Return the finite numbers among the cells of a column."""
    numbers = np.array([cell for cell in cells if isinstance(cell, int | float)], dtype=float)
    numbers = numbers[np.isfinite(numbers)]
    return numbers[np.abs(numbers) >= 1e-12 * np.abs(numbers).max()]  # no rounding error of nothing


@pytest.mark.parametrize("name", DRAWN)
def test_a_figure_draws_the_numbers_of_its_table(name: str) -> None:
    make, columns = DRAWN[name]
    drawing = make()
    with house_style():
        drawn = numbers_of(drawing.draw())
    rows = list(drawing.rows())
    for column, factor in columns.items():
        values = factor * find_numbers(row[list(drawing.header).index(column)] for row in rows)
        assert len(values) > 3, column
        above = np.clip(np.searchsorted(drawn, values), 1, len(drawn) - 1)
        off = np.minimum(np.abs(drawn[above] - values), np.abs(drawn[above - 1] - values))
        assert (off <= 1e-6 * np.abs(values) + 1e-12).all(), column


def test_the_limits_of_flicker_that_the_table_lists_lie_on_their_lines() -> None:
    drawing = flicker_drawing(LAMP)
    with house_style():
        (ax,) = drawing.draw().axes
    rows, header = list(drawing.rows()), list(drawing.header)
    frequency = header.index("frequency (Hz)")
    for column, name in (("no effect to (%)", "no observable effect"), ("low risk to (%)", "risk")):
        (line,) = (line for line in ax.lines if str(line.get_label()).endswith(name))
        for row in rows:
            at, limit = row[frequency], row[header.index(column)]
            if isinstance(at, float) and isinstance(limit, float):
                x, y = (np.log(np.asarray(part)) for part in line.get_data())
                assert np.interp(np.log(at), x, y) == pytest.approx(np.log(limit), abs=0.01)


@pytest.mark.parametrize("name", DRAWN)
def test_what_a_legend_names_has_a_name_and_a_look_of_its_own(name: str) -> None:
    with house_style():
        figure = DRAWN[name][0]().draw()
    for legend in figure.findobj(Legend):
        assert isinstance(legend, Legend)
        names = [text.get_text() for text in legend.get_texts()]
        lines = [handle for handle in legend.legend_handles if isinstance(handle, Line2D)]
        looks = [(str(line.get_color()), line.get_linestyle(), line.get_marker()) for line in lines]
        assert len(set(names)) == len(names)
        assert len(set(looks)) == len(looks)


def report_page() -> Figure:
    (sheet, *_) = [lesson for lesson in lessons().lessons if lesson.is_sheet]
    match = match_with(scene=SCENE, reasons=("Only 1.2 periods of 4 chips are in view.",))
    answer = CheckedAnswer("about 12", "right", "That is what the picture shows.")
    step, scene = sheet.steps[-1], SCENE.replace(columns=600)
    steps = [AnsweredStep(step, answer, scene), AnsweredStep(step, None, scene, match, "mine.jpg")]
    return draw_page("A sheet", "by somebody", "page 1 of 1", steps, 3)


def papers_maps() -> Figure:
    axes = {"switching_frequency": PAPERS_FREQUENCIES, "distance": PAPERS_DISTANCES}
    return paper.rate_maps({"one": table_of(axes), "two": table_of(axes)})


def circuit(board: TransmitterBoard) -> Figure:
    return wiring_figure(prepare_transmission(occ.load_preset("phone-68us"), board))


FAILED = occ.DecodeResult("threshold", failure="The panel is not in the picture.")
FIGURES: dict[str, Callable[[], Figure]] = {  # beside those with tables
    "failed decoding": lambda: decode_drawing(SCENE, FAILED).draw(),
    "report": report_page,
    "the paper's maps": papers_maps,
    "circuit of an Arduino": partial(circuit, UNO),
    "circuit of a Pico": partial(circuit, PICO),
}


@pytest.mark.parametrize("name", [*FIGURES, *DRAWN])
def test_no_text_is_cut_off_or_covers_a_title(name: str) -> None:
    with house_style():
        figure = FIGURES[name]() if name in FIGURES else DRAWN[name][0]().draw()
        assert figure.axes or figure.texts
        # To place all texts takes long.
        assert amount(True, False) or not find_cut_texts(figure)
