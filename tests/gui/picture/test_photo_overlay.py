"""A photo over the simulated picture: what each mode draws, and their difference."""

from collections.abc import Callable

import numpy as np
import pyqtgraph as pg
import pytest
from amount import amount
from gui.kinds import Grey, collect
from gui.mouse import drag_mouse
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF
from pytestqt.qtbot import QtBot

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.photo_overlay import PhotoOverlay, cell_means, difference_cells, rect_of
from occ_gui.values.choices import LARGEST_SCALE, LEAST_SCALE, Placement

SIDE = 200


class Screen:
    """A picture of one grey level with a photo over it, each pixel a pixel of the screen."""

    def __init__(self, qtbot: QtBot, picture: Callable[[pg.GraphicsView], Grey]) -> None:
        self._picture = picture
        self.view = pg.GraphicsView()
        self.box = pg.ViewBox(invertY=True, enableMenu=False)
        self.view.setCentralItem(self.box)
        self.simulated = AveragedImage()
        self.box.addItem(self.simulated)
        self.overlay = PhotoOverlay(self.box)
        self.overlay.set_opacity(1.0)
        self.simulate(np.full((SIDE, SIDE), 60, dtype=np.uint8))
        self.view.resize(SIDE, SIDE)
        qtbot.addWidget(self.view)
        self.view.show()
        self.box.setRange(QRectF(-0.5, -0.5, SIDE, SIDE), padding=0)

    def simulate(self, image: Grey) -> None:
        self.simulated.set_image(image)
        self.overlay.set_simulated(image)

    def shown(self) -> NDArray[np.int64]:
        return self._picture(self.view)[:SIDE, :SIDE].astype(np.int64)


@pytest.fixture
def screen(qtbot: QtBot, grey_picture: Callable[[pg.GraphicsView], Grey]) -> Screen:
    return Screen(qtbot, grey_picture)


def make_flat(level: int, rows: int = SIDE, columns: int = SIDE) -> Grey:
    return np.full((rows, columns), level, dtype=np.uint8)


def test_a_blended_photo_hides_as_much_as_it_is_opaque_and_one_beside_nothing(
    screen: Screen,
) -> None:
    screen.overlay.set_photo(make_flat(200))
    assert (screen.shown()[5:-5, 5:-5] == 60).all()
    screen.overlay.set_mode("blend")
    for opacity in (0.0, 0.25, 1.0):
        screen.overlay.set_opacity(opacity)
        assert np.abs(screen.shown()[5:-5, 5:-5] - (60 + 140 * opacity)).max() <= 2


def test_split_shows_the_photo_below_a_line_that_stays_until_another_photo_comes(
    screen: Screen,
) -> None:
    line = screen.overlay.line
    screen.overlay.set_photo(make_flat(200))
    screen.overlay.set_mode("split")
    assert line.value() == pytest.approx(SIDE / 2, abs=1)
    for place in (100, 40, 150):
        line.setValue(place)
        shown = screen.shown()
        assert (shown[5 : place - 5, 5:-5] == 60).all()
        assert (shown[place + 5 : -5, 5:-5] == 200).all()
    line.setValue(30)
    line.sigDragged.emit(line)
    screen.overlay.set_placement(Placement(4.0, 0.0))
    assert line.value() == 30
    screen.overlay.set_photo(make_flat(100))
    assert line.value() == pytest.approx(SIDE / 2, abs=1)


def test_the_difference_is_drawn_as_grey_levels_where_both_lie(screen: Screen) -> None:
    screen.overlay.set_photo(make_flat(75, 100, 100))
    screen.overlay.set_placement(Placement(50.0, 50.0))
    screen.overlay.set_mode("difference")
    for gain in (1, 4):
        screen.overlay.difference.set_gain(gain)
        assert (screen.shown()[55:145, 55:145] == 15 * gain).all()
    assert screen.overlay.difference.boundingRect() == QRectF(49.5, 49.5, 100, 100)
    screen.overlay.set_placement(Placement(5000.0, 5000.0))
    assert screen.overlay.difference.boundingRect().isEmpty()
    assert (screen.shown()[5:-5, 5:-5] == 60).all()


def test_the_difference_follows_the_simulation_and_ends_at_white(screen: Screen) -> None:
    screen.overlay.set_photo(make_flat(255))
    screen.overlay.set_mode("difference")
    assert (screen.shown()[5:-5, 5:-5] == 195).all()
    screen.simulate(make_flat(250))
    assert (screen.shown()[5:-5, 5:-5] == 5).all()
    screen.overlay.difference.set_gain(8)
    screen.simulate(make_flat(10))
    assert (screen.shown()[5:-5, 5:-5] == 255).all()


@pytest.mark.parametrize("placement", [Placement(), Placement(0.25, 0.0), Placement(3.0, 2.0)])
def test_equal_pictures_have_no_difference_however_fine(
    screen: Screen, placement: Placement
) -> None:
    stripes = np.where(np.arange(3 * SIDE) % 5 < 2, 20, 220).astype(np.uint8)
    image = np.tile(stripes, (3 * SIDE, 1))
    screen.simulate(image)
    screen.box.setRange(QRectF(-0.5, -0.5, 3 * SIDE, 3 * SIDE), padding=0)
    screen.overlay.set_photo(image)
    screen.overlay.set_placement(placement)
    screen.overlay.set_mode("difference")
    shown = screen.shown()[5:-5, 5:-5]
    if placement == Placement():
        assert shown.max() == 0
    else:  # never more than what one picture differs from itself by, so far moved
        assert 0 < shown.max() < 200


def test_the_frame_lies_round_the_photo_while_it_can_be_moved(screen: Screen) -> None:
    frame = screen.overlay.frame
    screen.overlay.set_photo(make_flat(200, 50, 80))
    screen.overlay.set_mode("blend")
    assert not frame.isVisible()
    screen.overlay.set_movable(True)
    screen.overlay.set_placement(Placement(10.0, 20.0, 0.5))
    assert frame.isVisible()
    assert QRectF(frame.pos(), frame.pos() + frame.size()) == QRectF(9.75, 19.75, 40, 25)
    screen.overlay.set_mode("beside")
    assert not frame.isVisible()


def test_dragging_the_frame_reports_the_photos_new_place(screen: Screen) -> None:
    received = collect(screen.overlay.placed)
    screen.overlay.set_photo(make_flat(200, 50, 80))
    screen.overlay.set_mode("blend")
    screen.overlay.set_movable(True)
    assert received == []
    screen.overlay.frame.setPos(QPointF(29.5, 39.5))
    assert received == [Placement(30.0, 40.0, 1.0)]
    screen.overlay.frame.setSize((160, 100))
    assert received[-1] == Placement(30.5, 40.5, 2.0)
    rect = rect_of(make_flat(200, 50, 80), received[-1])
    assert rect == QRectF(29.5, 39.5, 160, 100)


def drag(screen: Screen, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Drag with the left button from one pixel of the picture to another."""
    drag_mouse(screen.view.viewport(), QPointF(*start), QPointF(*end))


@pytest.fixture
def unhurried(screen: Screen, monkeypatch: pytest.MonkeyPatch) -> Screen:
    """Handle every movement of the mouse; usually some are left out to keep up with the hand."""
    monkeypatch.setitem(pg.CONFIG_OPTIONS, "mouseRateLimit", 0)
    return screen


def test_the_mouse_moves_the_photo_by_its_frame_not_the_view_and_scales_it_by_a_corner(
    unhurried: Screen,
) -> None:
    overlay, received = unhurried.overlay, list[Placement]()
    overlay.placed.connect(overlay.set_placement)
    overlay.set_photo(make_flat(200, 50, 80))
    overlay.set_placement(Placement(20.0, 20.0))
    overlay.set_mode("blend")
    overlay.set_movable(True)
    overlay.placed.connect(received.append)
    before = unhurried.box.viewRect()
    drag(unhurried, (60, 45), (90, 65))
    assert received[-1].column == pytest.approx(50.0, abs=1.5)
    assert received[-1].row == pytest.approx(40.0, abs=1.5)
    assert received[-1].scale == pytest.approx(1.0)
    assert unhurried.box.viewRect() == before
    overlay.set_placement(Placement(20.0, 20.0))
    drag(unhurried, (100, 70), (140, 95))
    assert received[-1].scale == pytest.approx(1.5, abs=0.05)
    rect = rect_of(make_flat(200, 50, 80), received[-1])
    assert (rect.left(), rect.top()) == pytest.approx((19.5, 19.5), abs=1.0)


def test_the_mouse_drags_the_line(unhurried: Screen) -> None:
    unhurried.overlay.set_photo(make_flat(200))
    unhurried.overlay.set_mode("split")
    line = unhurried.overlay.line
    drag(unhurried, (50, round(line.value())), (50, 160))
    assert line.value() == pytest.approx(160, abs=3)
    shown = unhurried.shown()
    assert (shown[5:150, 5:-5] == 60).all()
    assert (shown[170:-5, 5:-5] == 200).all()


@pytest.mark.parametrize(("scale", "kept"), [(0.0, LEAST_SCALE), (1e9, LARGEST_SCALE)])
def test_the_scale_stays_within_its_limits(scale: float, kept: float) -> None:
    assert Placement(1.0, 2.0, scale).within_limits() == Placement(1.0, 2.0, kept)


def make_noise(rows: int, columns: int) -> Grey:
    return np.random.default_rng(rows * columns).integers(0, 256, (rows, columns), dtype=np.uint8)


def average_by_hand(image: Grey, grid: QRectF, shape: tuple[int, int]) -> NDArray[np.float64]:
    """Cut every pixel into 16 x 16 parts and average those in each cell."""
    fine = image.astype(np.float64).repeat(16, axis=0).repeat(16, axis=1)
    top, left = round(16 * grid.top()), round(16 * grid.left())
    part = fine[top : top + round(16 * grid.height()), left : left + round(16 * grid.width())]
    high, wide = part.shape[0] // shape[0], part.shape[1] // shape[1]
    cells = part[: high * shape[0], : wide * shape[1]].reshape(shape[0], high, shape[1], wide)
    return np.asarray(cells.mean(axis=(1, 3)))


@settings(max_examples=amount(30, 60))
@given(
    st.integers(0, 40), st.integers(0, 40), st.integers(1, 8), st.integers(1, 8),
    st.integers(1, 40), st.integers(1, 40),
)  # fmt: skip
def test_a_cell_holds_the_exact_mean_of_what_lies_under_it(
    left: int, top: int, columns: int, rows: int, wide: int, high: int
) -> None:
    image = make_noise(30, 25)
    # Cells of up to 2.5 pixels, in sixteenths.
    grid = QRectF(left / 16, top / 16, columns * wide / 16, rows * high / 16)
    means = cell_means(image, QRectF(0, 0, 25, 30), grid, (rows, columns))
    assert means == pytest.approx(average_by_hand(image, grid, (rows, columns)), abs=1e-6)


def test_a_large_image_is_averaged_to_within_two_levels() -> None:
    image = make_noise(1203, 1601)
    means = cell_means(image, QRectF(0, 0, 1601, 1203), QRectF(1, 1, 1600, 1200), (6, 8))
    exact = image[1:1201, 1:1601].reshape(6, 200, 8, 200).mean(axis=(1, 3))
    assert np.abs(means - exact).max() < 2.0


@pytest.mark.parametrize("width", [1e-13, 1e-9, 0.5])
@pytest.mark.parametrize("place", [0.0, 9.999999999999998, 10.0])
def test_a_grid_at_the_very_edge_also_has_means(place: float, width: float) -> None:
    image = make_noise(10, 10)
    grid = QRectF(place, place, width, width)
    means = cell_means(image, QRectF(0, 0, 10, 10), grid, (2, 3))
    assert means.shape == (2, 3)
    assert np.isfinite(means).all()


def test_cells_of_a_difference_cover_only_the_overlap() -> None:
    first = (np.full((40, 60), 90, dtype=np.uint8), QRectF(-0.5, -0.5, 60.0, 40.0))
    second = (np.full((40, 60), 65, dtype=np.uint8), QRectF(29.5, 9.5, 60.0, 40.0))
    found = difference_cells(first, second, 900)
    levels, grid = found
    assert grid == QRectF(29.5, 9.5, 30.0, 30.0)
    assert levels.shape == (30, 30)
    assert np.allclose(levels, 25.0)
    few = difference_cells(first, second, 10)
    assert few[0].shape == (10, 10)
    assert difference_cells(first, (second[0], QRectF(100.0, 0.0, 60.0, 40.0)), 900) is None
