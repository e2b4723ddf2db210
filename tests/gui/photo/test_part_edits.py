"""What of a photo is matched: a lamp chosen by a click or a row, or a rectangle drawn by hand."""

import json
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import not_none
from gui.photo.photo_bench import PhotoBench
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.files.session_record import Kept, kept_in, record_of
from occ_gui.photo.lamp_views import LampForm, LampOutlines
from occ_gui.photo.part_edits import PartEdits
from occ_gui.values.photo_choice import PhotoChoice, PhotoFrame
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.scene.scene import Scene


def lamp_at(region: Region, modulated: bool = True, periods: float = 6.0) -> Lamp:
    spans = np.array([[region.first_row, region.last_row, region.first_column, region.last_column]])
    product = 0.1 if modulated else None
    return Lamp(region, spans, 200.0, modulated, 20.0, 0.02, product, 1e-4, periods)


LAMPS = (
    lamp_at(Region(5, 25, 10, 40)),
    lamp_at(Region(30, 50, 50, 90), modulated=False),
    lamp_at(Region(30, 50, 10, 45), periods=2.1),
)


class Bench(PhotoBench):
    """The edits with the form and the outlines."""

    def __init__(self, qtbot: QtBot, photo: Photo) -> None:
        super().__init__()
        self.form = LampForm()
        qtbot.addWidget(self.form)
        self.view = pg.GraphicsView()
        qtbot.addWidget(self.view)
        self.box = pg.ViewBox()
        self.view.setCentralItem(self.box)
        self.outlines = LampOutlines(self.box)
        self.parts = PartEdits(self.store, self.board)
        self.store.select(lambda workspace: workspace.photo).changed.connect(self._show)
        self.form.chosen.connect(self.parts.choose)
        self.outlines.clicked.connect(self.parts.choose)
        self.outlines.drawn.connect(self.parts.draw)
        self.show_photo(photo)

    def _show(self) -> None:
        lamps, part = self.board.results.lamps, self.parts.part
        chosen = next((place for place, lamp in enumerate(lamps) if lamp is part), None)
        for drawn in (self.form, self.outlines):
            drawn.show_lamps(lamps, chosen)

    def find(self) -> None:
        self.board.put(replace(self.board.results, lamps=LAMPS))
        self._show()


@pytest.fixture
def bench(qtbot: QtBot, photo: Photo) -> Bench:
    return Bench(qtbot, photo)


def test_every_lamp_has_an_outline_and_a_row(bench: Bench) -> None:
    bench.find()
    assert len(bench.outlines.items) == bench.form.table.rowCount() == len(LAMPS)
    texts = [
        [
            (item.text() if (item := bench.form.table.item(row, column)) else "")
            for column in range(4)
        ]
        for row in range(3)
    ]
    assert texts[0] == ["1", "10\u201339", "10.000 ± 0.010", "6.0"]
    assert texts[1][2] == "no stripes"
    assert texts[2][3] == "2.1, doubtful"
    doubtful = not_none(bench.form.table.item(2, 3))
    assert (
        doubtful.toolTip() == "Doubtful: only 2.1 periods are in view, which can be a coincidence."
    )


def test_a_click_within_a_lamp_chooses_it(bench: Bench) -> None:
    bench.find()
    bench.outlines.click(QPointF(70.0, 40.0))
    assert bench.parts.part is LAMPS[1]
    assert next(item.row() for item in bench.form.table.selectedItems()) == 1
    bench.outlines.click(QPointF(95.0, 5.0))
    assert bench.parts.part is LAMPS[1]
    bench.form.table.selectRow(2)
    assert bench.parts.part is LAMPS[2]
    bench.parts.match_whole()
    assert bench.parts.part is None


@pytest.mark.parametrize("chosen", [None, 0, 2])
def test_the_chosen_lamp_alone_has_a_thick_outline(bench: Bench, chosen: int | None) -> None:
    bench.outlines.show_lamps(LAMPS, chosen)
    widths = [curve.opts["pen"].widthF() for curve, _ in bench.outlines.items]
    thick = [index for index, width in enumerate(widths) if width > min(widths)]
    assert thick == ([] if chosen is None else [chosen])


def test_the_table_of_many_lamps_is_no_higher_than_of_some(bench: Bench) -> None:
    heights = []
    for number in (1, 2, 6, 7, 40):
        bench.form.show_lamps(LAMPS[:1] * number, None)
        heights.append(bench.form.table.height())
    one, two, six, seven, forty = heights
    assert two - one == (six - two) / 4 > 0
    assert six == seven == forty


def test_a_rectangle_is_clipped_to_the_photo(bench: Bench, photo: Photo) -> None:
    _rows, columns = photo.image.shape
    bench.parts.draw(Region(-20, 30, 40, columns + 500))
    assert bench.parts.part == Region(0, 30, 40, columns)
    bench.parts.set_by_hand(False)
    assert bench.parts.part is None


def test_a_chosen_lamp_is_kept_as_its_rectangle(bench: Bench, photo: Photo) -> None:
    assert bench.choice.rectangle is None
    bench.find()
    bench.parts.choose(2)
    assert bench.parts.part is LAMPS[2]
    assert bench.choice.rectangle == LAMPS[2].region
    bench.board.put(replace(bench.board.results, lamps=()))
    assert bench.parts.part == LAMPS[2].region
    bench.parts.match_whole()
    assert bench.choice.rectangle is None


def test_the_rectangle_dragged_is_the_one_matched(bench: Bench) -> None:
    bench.parts.set_by_hand(True)
    bench.outlines.show_rectangle(bench.choice.rectangle)
    bench.outlines.rectangle.setPos((9.5, 4.5), finish=False)
    bench.outlines.rectangle.setSize((30, 20))
    assert bench.parts.part == Region(5, 25, 10, 40)


def test_a_drag_with_the_tool_on_draws_the_rectangle(
    bench: Bench, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(pg.CONFIG_OPTIONS, "mouseRateLimit", 0)
    kinds, left, none = QEvent.Type, Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton

    def drag(first: QPointF, last: QPointF) -> None:
        port = bench.view.viewport()
        steps = [(kinds.MouseMove, 0.0, none, none), (kinds.MouseButtonPress, 0.0, left, left)]
        steps += [(kinds.MouseMove, share / 5, none, left) for share in range(1, 6)]
        steps += [(kinds.MouseButtonRelease, 1.0, left, none)]
        for kind, share, button, held in steps:
            place = bench.box.mapViewToScene(first + (last - first) * share)
            globally = QPointF(port.mapToGlobal(place))
            no_key = Qt.KeyboardModifier.NoModifier
            QApplication.sendEvent(port, QMouseEvent(kind, place, globally, button, held, no_key))

    bench.view.resize(600, 400)
    with qtbot.waitExposed(bench.view):
        bench.view.show()
    bench.box.setRange(xRange=(0, 100), yRange=(0, 60), padding=0.0)
    drag(QPointF(10, 5), QPointF(40, 25))
    assert bench.parts.part is None  # the tool is off: the picture moves
    bench.box.setRange(xRange=(0, 100), yRange=(0, 60), padding=0.0)
    bench.parts.draw(Region(30, 50, 60, 90))
    bench.outlines.show_rectangle(bench.choice.rectangle)
    drag(QPointF(10, 5), QPointF(40, 25))
    found = not_none(bench.choice.rectangle)
    corners = (found.first_row, found.last_row, found.first_column, found.last_column)
    assert corners == pytest.approx((5, 25, 10, 40), abs=1)


def test_a_region_stays_when_the_channel_is_changed(bench: Bench, photo: Photo) -> None:
    bench.parts.draw(Region(5, 25, 10, 40))
    bench.show_photo(replace(photo, channel="red"))
    assert bench.parts.part == Region(5, 25, 10, 40)
    bench.show_photo(replace(photo, path=Path("other.png")))
    assert bench.parts.part is None


def test_a_region_comes_back_with_its_photo(bench: Bench, photo: Photo) -> None:
    """Going through the rows of the table of photos opens one after the other."""
    drawn, other = Region(5, 25, 10, 40), replace(photo, path=Path("other.png"))
    bench.parts.draw(drawn)
    for shown, region in ((other, None), (photo, drawn), (other, None)):
        bench.show_photo(shown)
        assert bench.parts.part == region
    bench.parts.draw(Region(30, 50, 60, 90))
    bench.show_photo(photo)
    assert bench.parts.part == drawn
    bench.parts.match_whole()
    bench.show_photo(other)
    assert bench.parts.part == Region(30, 50, 60, 90)
    bench.show_photo(photo)
    assert bench.parts.part is None, "the whole photo was chosen since"
    bench.show_photo(replace(other, turned=True))
    assert bench.parts.part is None, "along the other axis it is another rectangle"
    bench.show_photo(None)
    bench.show_photo(other)
    assert bench.parts.part is None


@pytest.mark.parametrize("region", [None, Region(5, 25, 10, 40)])
def test_the_session_keeps_the_region(region: Region | None, bench: Bench, photo: Photo) -> None:
    bench.choose(parts={} if region is None else {PhotoFrame(photo.path): region})
    kept = photo_in(json.loads(json.dumps(record_of(Kept(bench.store.workspace)))))
    assert kept.rectangle == region
    bench.choose(parts=kept.parts)
    assert bench.parts.part == region


def photo_in(record: Mapping[str, object]) -> PhotoChoice:
    """Read what a session that has a scene says of photos."""
    kept = not_none(kept_in({"scene": Scene().to_toml()} | dict(record)))
    return kept.workspace.photo


@pytest.mark.parametrize("damaged", ["x", {"first_row": 1}, [1, 2, 3, 4], 7])
@pytest.mark.parametrize("form", ["former", "present"])
def test_a_damaged_region_is_left_out(damaged: object, form: str, photo: Photo) -> None:
    def read(region: object) -> PhotoChoice:
        path = str(photo.path)
        former = {"photo": path, "region": region}
        return photo_in(former if form == "former" else {"photo": {"path": path, "region": region}})

    found = read(damaged)
    assert (found.path, found.rectangle) == (photo.path, None)
    assert read(asdict(Region(1, 2, 3, 4))).rectangle == Region(1, 2, 3, 4)


def test_a_rectangle_by_hand_begins_with_the_chosen_lamp_or_in_the_middle(
    bench: Bench, photo: Photo
) -> None:
    """The middle half of the photo, so that all its corners can be taken hold of."""
    rows, columns = photo.image.shape
    bench.parts.set_by_hand(True)
    middle = not_none(bench.choice.rectangle)
    assert (2 * middle.rows, 2 * middle.columns) == (rows, columns)
    assert middle.first_row == rows - middle.last_row
    assert middle.first_column == columns - middle.last_column
    bench.parts.match_whole()
    bench.find()
    bench.parts.choose(2)
    bench.parts.set_by_hand(True)
    assert bench.parts.part == LAMPS[2].region


def test_a_rectangle_lies_around_its_pixels_and_each_corner_moves_by_itself(bench: Bench) -> None:
    region, drawn = Region(5, 25, 10, 40), list[Region]()
    bench.outlines.drawn.connect(drawn.append)
    bench.outlines.show_rectangle(region)
    assert bench.outlines.rectangle.isVisible()
    corner, size = bench.outlines.rectangle.pos(), bench.outlines.rectangle.size()
    # A pixel's centre has a whole number.
    assert (corner.x(), corner.y()) == (9.5, 4.5)
    assert (corner.x() + size.x(), corner.y() + size.y()) == (39.5, 24.5)
    for handle in bench.outlines.rectangle.handles:
        assert handle["pos"] + handle["center"] == pg.Point(1.0, 1.0)
    bench.outlines.show_rectangle(None)
    assert not bench.outlines.rectangle.isVisible()
    assert drawn == []


def test_a_lamps_number_stands_above_it_and_hides_nothing_of_it(bench: Bench) -> None:
    bench.find()
    for (_, number), lamp in zip(bench.outlines.items, LAMPS, strict=True):
        assert (number.pos().x(), number.pos().y()) == (
            lamp.region.first_column, lamp.region.first_row,
        )  # fmt: skip
        # Its lower left corner is there.
        assert (number.anchor.x(), number.anchor.y()) == (0.0, 1.0)
