"""Every text of a figure is inside its page, whatever its length and language."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text
from model.figures.cut_texts import find_cut_texts
from model.figures.test_text_from_files import make_lesson

import occ_model as occ
from occ_model.figures.decoding import decode_drawing
from occ_model.figures.drawing import figure_bytes, house_style
from occ_model.figures.lesson_report import draw_page
from occ_model.figures.page import break_lines
from occ_model.figures.window_panes import Difference, PhotoLayer, picture_drawing, profile_drawing
from occ_model.results.frame import Frame
from occ_model.scene.provenance import Provenance

SCENE = occ.load_preset("phone-68us").replace(rows=400, columns=1000, panel_height=2.0)

TEXTS = {
    "short": "my photo.jpg",
    "long": "A title that goes on, and on, and goes on. " * 7,
    "one word": "W" * 255,
    "German": "Donaudampfschifffahrtsgesellschaftskapitänsmütze " * 6,
    "Greek": "Οπτική επικοινωνία με κάμερα " * 8,
    "Arabic": "اتصال بصري بالكاميرا " * 10,
    "Chinese": "光学相机通信实验" * 20,
    "formula": r"$\frac{a}{b}$ & <b> " * 12,
}


@pytest.fixture(scope="module")
def frames() -> tuple[Frame, ...]:
    """Return a wide picture and a high one."""
    return tuple(occ.render(SCENE.replace(rows=rows), tolerance=np.inf) for rows in (60, 1600))


def pages(text: str, frames: tuple[Frame, ...]) -> list[Callable[[], Figure]]:
    """Return functions that put a user's text into each figure that can have one."""
    flat, high = frames
    difference = Difference(np.zeros((10, 20)), (0.0, 20.0, 10.0, 0.0), 4)
    layer = PhotoLayer(from_row=20.0)
    lesson, steps = make_lesson(text)
    return [
        picture_drawing(flat, None, high.image, "camera", difference, text).draw,
        profile_drawing(flat, None, text, about=text).draw,
        decode_drawing(SCENE, occ.DecodeResult("threshold", failure=text)).draw,
        picture_drawing(high, None, flat.image, about=text).draw,
        picture_drawing(flat, None, high.image, "receiver", layer, text).draw,
        lambda: draw_page(lesson.title, text, "the foot", steps, 1),
    ]


EACH = [(name, number) for name in TEXTS for number in range(6)]


@pytest.mark.parametrize(
    ("name", "number"),
    [
        # Without --whole, five of the texts in five of the figures.
        pytest.param(*each, marks=() if place % 11 == 0 else pytest.mark.whole)
        for place, each in enumerate(EACH)
    ],
)
def test_no_text_of_a_user_is_cut_off(name: str, number: int, frames: tuple[Frame, ...]) -> None:
    with house_style():
        assert not find_cut_texts(pages(TEXTS[name], frames)[number]())


def test_a_file_has_the_texts_that_were_fitted_to_its_page() -> None:
    figure = Figure(figsize=(3.0, 2.0), layout="constrained")
    figure.subplots().set_title(TEXTS["long"])
    figure_bytes(figure, "svg", Provenance("title", {}))
    title = figure.axes[0].title
    added = title.get_text().count("\n")
    assert added > 3
    line = 1.2 * float(title.get_fontsize()) / 72.0
    assert figure.get_figheight() == pytest.approx(2.0 + added * line)
    assert not find_cut_texts(figure)
    # The axes are where the layout puts them on the final page.
    placed = figure.axes[0].get_position().bounds
    figure.set_layout_engine("constrained")
    figure.draw_without_rendering()
    assert placed == pytest.approx(figure.axes[0].get_position().bounds, abs=0.01)


def test_a_room_narrower_than_a_letter_ends_the_search_for_lines() -> None:
    assert break_lines("two words", 1e-3, FontProperties(), 3) == ["t", "w", "…"]


def test_letters_come_from_any_font_that_has_them() -> None:
    figure = Figure()
    (there, nowhere) = (figure.text(0.1, 0.5, f"a{letter}") for letter in "Ⓐ\U0001f9ff")
    figure_bytes(figure, "pdf", Provenance("title", {}))
    assert isinstance(there, Text)
    assert there.get_text() == "aⒶ"
    assert nowhere.get_text() == "a□"


def test_a_text_without_space_on_a_report_s_page_ends_in_an_ellipsis() -> None:
    lesson, steps = make_lesson(TEXTS["long"])
    with house_style():
        page = draw_page(lesson.title, "about", "the foot", steps, 1)
    heading = page.texts[0].get_text()
    assert heading.startswith("A title that goes on")
    assert heading.endswith("…")
