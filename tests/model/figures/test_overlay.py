"""A photo over a picture is printed in its place, as far as it is visible."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.figures.drawing import Drawing
from occ_model.figures.window_panes import Difference, PhotoLayer, picture_drawing, profile_drawing
from occ_model.results.comparison import Comparison

SCENE = occ.load_preset("phone-68us").replace(rows=300, columns=400, panel_height=0.01)
FRAME = occ.render(SCENE, tolerance=np.inf)
PHOTO: ByteArray = np.full((50, 100), 200, dtype=np.uint8)
ROUNDING = 3.0
"""In levels: matplotlib truncates opacity, products and sums to eight bits."""

DARK = float(FRAME.camera_image[5, 5])


def print_levels(drawing: Drawing) -> Callable[[float, float], float]:
    """Return a function that gives the grey level printed at a pixel of the simulated picture."""
    figure = drawing.draw()
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    levels = np.asarray(canvas.buffer_rgba())

    def level(column: float, row: float) -> float:
        x, y = figure.axes[0].transData.transform((column, row))
        return float(levels[levels.shape[0] - 1 - round(y), round(x), 0])

    return level


@pytest.mark.parametrize("opacity", [0.25, pytest.param(1.0, marks=pytest.mark.whole)])
def test_a_blended_photo_is_mixed_by_its_opacity_and_only_where_it_lies(opacity: float) -> None:
    layer = PhotoLayer(column=20.0, row=10.0, scale=1.5, opacity=opacity)
    level = print_levels(picture_drawing(FRAME, None, PHOTO, "camera", layer))
    mixed = opacity * 200.0 + (1 - opacity) * DARK
    # The photo ends 100 columns of 1.5 pixels further right.
    for column, wanted in ((90.0, mixed), (160.0, mixed), (180.0, DARK)):
        assert level(column, 40.0) == pytest.approx(wanted, abs=ROUNDING)


def test_a_split_shows_the_picture_above_the_line_and_the_photo_below() -> None:
    layer = PhotoLayer(column=20.0, row=10.0, from_row=40.0)
    drawing = picture_drawing(FRAME, None, PHOTO, "camera", layer)
    level = print_levels(drawing)
    assert level(60.0, 30.0) == pytest.approx(DARK, abs=ROUNDING)
    assert level(60.0, 50.0) == pytest.approx(200.0, abs=ROUNDING)
    assert "row 40" in drawing.draw().axes[0].get_title()


@pytest.mark.parametrize("line", [-500.0, 500.0])
def test_a_line_beside_the_photo_shows_all_of_it_or_nothing(line: float) -> None:
    layer = PhotoLayer(column=20.0, row=10.0, from_row=line)
    level = print_levels(picture_drawing(FRAME, None, PHOTO, "camera", layer))
    assert level(60.0, 30.0) == pytest.approx(200.0 if line < 0 else DARK, abs=ROUNDING)


def test_a_photo_that_is_not_over_the_picture_is_beside_it() -> None:
    figure = picture_drawing(FRAME, None, PHOTO).draw()
    assert [ax.get_title() for ax in figure.axes][1] == "Photo"


def test_a_difference_is_printed_times_its_gain_where_both_overlap_and_listed_without_it() -> None:
    levels = np.array([[0.0, 20.0], [40.0, 100.0]])
    layer = Difference(levels, (19.5, 39.5, 29.5, 9.5), 4)
    drawing = picture_drawing(FRAME, None, PHOTO, "camera", layer)
    level = print_levels(drawing)
    for (row, column), difference in np.ndenumerate(levels):
        at = level(24.5 + 10.0 * column, 14.5 + 10.0 * row)
        assert at == pytest.approx(min(4.0 * difference, 255.0), abs=ROUNDING)
    (axes,) = drawing.draw().axes
    assert "difference from the photo × 4" in axes.get_title()  # noqa: RUF001
    assert drawing.header == ("row", "column 24.5", "column 34.5")
    assert list(drawing.rows()) == [(14.5, 0.0, 20.0), (24.5, 40.0, 100.0)]


def test_the_sentence_about_the_photo_is_below_it_and_in_the_table() -> None:
    about = "photo of $10.png. If f = 2 kHz: your camera reads a line in 7.00 ± 0.02 µs; sure."
    profile = Comparison(0, FRAME.profile, FRAME.profile, 1.0)
    drawings = (
        picture_drawing(FRAME, None, PHOTO, about=about),
        profile_drawing(FRAME, None, comparison=profile, about=about),
    )
    for drawing in drawings:
        written = drawing.draw().get_supxlabel()
        assert about in " ".join(written.split())
        assert about in drawing.title
