"""An image shows the mean of the pixels under a screen pixel, without false stripes."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import Grey
from numpy.typing import NDArray
from PySide6.QtCore import QRectF
from pytestqt.qtbot import QtBot

from occ_gui.picture.averaged_image import AveragedImage

PERIOD = 4
COLUMNS = 4000
HEIGHT = 40


class Screen:
    """A view that shows a rectangle of the scene on a given number of screen pixels."""

    def __init__(self, qtbot: QtBot, picture: Callable[[pg.GraphicsView], Grey]) -> None:
        self._picture = picture
        self.view = pg.GraphicsView()
        self.view.setBackground(
            "#0000ff"
        )  # in grey, this is neither black nor white nor their mean
        self.box = pg.ViewBox(invertY=True, enableMenu=False)
        self.box.setDefaultPadding(0.0)
        self.view.setCentralItem(self.box)
        self.item = AveragedImage()
        self.box.addItem(self.item)
        qtbot.addWidget(self.view)

    def shown(self, width: int, height: int, part: QRectF) -> Grey:
        self.view.resize(width, height)
        self.view.show()
        self.box.setRange(part, padding=0)
        return self._picture(self.view)


@pytest.fixture
def screen(qtbot: QtBot, grey_picture: Callable[[pg.GraphicsView], Grey]) -> Screen:
    return Screen(qtbot, grey_picture)


@pytest.fixture
def fine_stripes() -> Grey:
    stripes = np.where(np.arange(COLUMNS) % PERIOD < PERIOD // 2, 0, 255).astype(np.uint8)
    return np.tile(stripes, (HEIGHT, 1))


def cut_rim(picture: Grey) -> NDArray[np.int64]:
    """Leave out the outermost pixels, which the image may cover only partly."""
    return picture[2:-2, 2:-2].astype(np.int64)


@pytest.mark.parametrize(("width", "shift"), [(1000, 0.0), (999, 0.3), (370, 1.7), (101, 0.0)])
def test_fine_stripes_shown_small_are_grey_and_no_coarse_stripes(
    screen: Screen, fine_stripes: Grey, width: int, shift: float
) -> None:
    screen.item.set_image(fine_stripes)
    picture = cut_rim(screen.shown(width, HEIGHT, QRectF(shift - 0.5, -0.5, COLUMNS, HEIGHT)))
    picture = picture[:, :-4] if shift else picture
    # A pixel's mean can be off by the part of a stripe that does not fit in it, and no more; a
    # whole number of periods leaves nothing over.
    columns_a_pixel = COLUMNS / width
    over = columns_a_pixel % PERIOD
    worst = 255 * 0.5 * min(over, PERIOD - over) / columns_a_pixel + 3
    nearest = fine_stripes[0, (np.arange(width) * columns_a_pixel).astype(int)].astype(int)
    assert np.abs(picture - 127.5).max() <= worst
    assert worst < 0.75 * np.abs(nearest - 127.5).max()


def test_the_mean_is_taken_along_rows_too_and_along_one_axis_while_the_other_is_enlarged(
    screen: Screen, fine_stripes: Grey
) -> None:
    screen.item.set_image(np.ascontiguousarray(fine_stripes.T))
    picture = cut_rim(screen.shown(HEIGHT, 250, QRectF(-0.5, -0.5, HEIGHT, COLUMNS)))
    assert np.abs(picture - 127.5).max() <= 3
    wide_stripes = fine_stripes[:, np.arange(COLUMNS) // 32]  # each four screen pixels wide
    screen.item.set_image(np.ascontiguousarray(wide_stripes.T))
    picture = cut_rim(screen.shown(HEIGHT, 250, QRectF(-0.5, -0.5, HEIGHT, COLUMNS)))
    assert set(np.unique(picture).tolist()) == {0, 255}
    screen.item.set_image(fine_stripes[:2])
    picture = cut_rim(screen.shown(500, 80, QRectF(-0.5, -0.5, COLUMNS, 2)))
    assert np.abs(picture - 127.5).max() <= 3


@pytest.mark.parametrize("zoom", [1, 3, 8])
def test_an_enlarged_pixel_fills_its_place_with_its_own_value(screen: Screen, zoom: int) -> None:
    image = np.random.default_rng(1).integers(0, 256, (50, 200), dtype=np.uint8)
    screen.item.set_image(image)
    first_column, first_row, columns, rows = 23, 7, 320 // zoom // 2, 96 // zoom // 3
    part = QRectF(first_column - 0.5, first_row - 0.5, columns, rows)
    picture = screen.shown(columns * zoom, rows * zoom, part)
    seen = image[first_row : first_row + rows, first_column : first_column + columns]
    expected = seen.repeat(zoom, axis=0).repeat(zoom, axis=1)
    assert np.array_equal(picture[1:-1, 1:-1], expected[1:-1, 1:-1])


@pytest.mark.parametrize("zoom", [1.0, 1.3, 2.5, 40.0])
def test_enlarged_stripes_have_no_value_between_black_and_white(
    screen: Screen, fine_stripes: Grey, zoom: float
) -> None:
    screen.item.set_image(fine_stripes)
    picture = cut_rim(screen.shown(400, HEIGHT, QRectF(1000.2, -0.5, 400 / zoom, HEIGHT)))
    assert set(np.unique(picture).tolist()) == {0, 255}


def test_an_image_of_one_pixel_is_shown_and_by_default_its_centre_is_the_origin(
    screen: Screen, fine_stripes: Grey
) -> None:
    screen.item.set_image(np.full((1, 1), 77, dtype=np.uint8))
    single = cut_rim(screen.shown(60, 30, QRectF(-0.5, -0.5, 1, 1)))
    assert set(np.unique(single).tolist()) == {77}
    screen.item.set_image(np.zeros((3, 5), dtype=np.uint8))
    assert screen.item.boundingRect() == QRectF(-0.5, -0.5, 5, 3)
    screen.item.set_image(np.full((10, 20), 255, dtype=np.uint8), QRectF(30, 10, 40, 20))
    assert screen.item.boundingRect() == QRectF(30, 10, 40, 20)
    picture = screen.shown(100, 50, QRectF(0, 0, 100, 50))
    rows, columns = np.nonzero(picture == 255)
    box = (rows.min(), rows.max(), columns.min(), columns.max())
    assert box == pytest.approx((10, 29, 30, 69), abs=1)
    screen.item.set_image(fine_stripes)
    picture = screen.shown(200, 100, QRectF(1002.0, 20.0, 1e-6, 1e-6))
    assert set(np.unique(cut_rim(picture)).tolist()) == {255}


def test_an_empty_image_shows_nothing_and_a_new_one_takes_the_place_of_the_last(
    screen: Screen, fine_stripes: Grey
) -> None:
    place = QRectF(0, 0, 5, 5)
    background = screen.shown(50, 30, place)
    for shape in ((0, 0), (0, 5), (5, 0)):
        screen.item.set_image(np.zeros(shape, dtype=np.uint8))
        assert np.array_equal(screen.shown(50, 30, place), background)
    for image in (fine_stripes, np.full_like(fine_stripes, 9)):
        screen.item.set_image(image)
        shown = screen.shown(200, HEIGHT, QRectF(-0.5, -0.5, COLUMNS, HEIGHT))
    assert set(np.unique(cut_rim(shown)).tolist()) == {9}


def test_only_the_visible_part_is_averaged_when_the_view_changes(
    screen: Screen, fine_stripes: Grey, monkeypatch: pytest.MonkeyPatch
) -> None:
    sizes: list[tuple[int, ...]] = []
    resize: Any = cv2.resize

    def note_and_resize(pixels: Grey, *args: object, **kwargs: object) -> Grey:
        sizes.append(pixels.shape)
        return resize(pixels, *args, **kwargs)

    monkeypatch.setattr(cv2, "resize", note_and_resize)
    screen.item.set_image(fine_stripes)
    quarter = QRectF(999.5, -0.5, 1000, HEIGHT)
    screen.shown(100, HEIGHT, quarter)
    sizes.clear()
    screen.item.set_image(fine_stripes)
    screen.shown(100, HEIGHT, quarter)
    screen.shown(100, HEIGHT, quarter)
    assert len(sizes) == 1
    rows, columns = sizes[0]
    assert rows <= HEIGHT
    assert 1000 <= columns <= 1002


def test_pixels_that_are_large_enough_have_their_grey_level_written(screen: Screen) -> None:
    screen.box.removeItem(screen.item)
    screen.item = AveragedImage(with_values=True)
    screen.box.addItem(screen.item)
    image = np.full((200, 200), 255, dtype=np.uint8)
    screen.item.set_image(image)
    assert cut_rim(screen.shown(400, 400, QRectF(0, 0, 100, 100))).min() == 255
    near = cut_rim(screen.shown(400, 400, QRectF(10, 10, 6, 6)))
    assert near.max() == 255
    pixels = near[:390, :390].reshape(6, 65, 6, 65)
    assert (pixels.min(axis=(1, 3)) < 60).all()  # black figures on white, in each
    screen.item.set_image(np.zeros((200, 200), dtype=np.uint8))
    assert cut_rim(screen.shown(400, 400, QRectF(10, 10, 6, 6))).max() > 200
