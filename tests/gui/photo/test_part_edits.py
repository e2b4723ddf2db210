"""The part of a photo that is matched: a lamp chosen by a click or a row, or a rectangle."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import show_widget
from gui.mouse import drag_mouse
from gui.photo.photo_bench import PhotoBench, no_actions
from matches import match_with
from PySide6.QtCore import QPointF, Qt
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.files.session_record import read_session
from occ_gui.photo.many.rows_model import VERDICT
from occ_gui.photo.pane import PhotoPane
from occ_gui.picture.image_view import ImageView
from occ_gui.values.choices import LoadOptions, PhotoChoice
from occ_gui.values.photo_results import ListedRows, MatchOutcome
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.photo_table import PhotoRow
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


GIVEN = ("switching_frequency", 1e4)


class Bench(PhotoBench):
    """The pane of a photo, and the picture that its lamps are drawn on."""

    def __init__(self, qtbot: QtBot, photo: Photo) -> None:
        super().__init__()
        self.picture = show_widget(qtbot, ImageView(), 1200, 400)
        self.box = self.picture.photo.box
        self.pane = PhotoPane(
            self.scenes, self.photos, self.picture, self.results_store, no_actions()
        )
        qtbot.addWidget(self.pane.widget)
        self.form, self.outlines = self.pane.view.lamps, self.pane.outlines
        self.parts = self.pane.parts
        self.follow(self.pane.show_part)
        self.show_photo(photo)

    def find(self) -> None:
        self.change(lamps=LAMPS)


@pytest.fixture
def bench(qtbot: QtBot, photo: Photo) -> Iterator[Bench]:
    bench = Bench(qtbot, photo)
    yield bench
    bench.pane.stop()


def test_every_lamp_has_an_outline_with_its_number_above_it_and_a_row(bench: Bench) -> None:
    bench.find()
    table = bench.form.table
    assert len(bench.outlines.items) == table.rowCount() == len(LAMPS)
    texts = [[table.item(row, column).text() for column in range(4)] for row in range(3)]
    assert texts[0] == ["1", "10\u201339", "20.000 ± 0.020", "6.0"]
    assert texts[1][2] == "no stripes"
    assert texts[2][3] == "2.1, doubtful"
    tip = table.item(2, 3).toolTip()
    assert tip == "Doubtful: only 2.1 periods are visible, which may be a coincidence."
    for (_, number), lamp in zip(bench.outlines.items, LAMPS, strict=True):
        place = (number.pos().x(), number.pos().y())
        assert place == (lamp.region.first_column, lamp.region.first_row)
        assert (number.anchor.x(), number.anchor.y()) == (
            0.0,
            1.0,
        )  # its lower left corner


def test_a_click_within_a_lamp_chooses_it_and_its_outline_alone_is_thick(bench: Bench) -> None:
    def thick() -> list[int]:
        widths = [curve.opts["pen"].widthF() for curve, _ in bench.outlines.items]
        return [index for index, width in enumerate(widths) if width > min(widths)]

    bench.find()
    assert thick() == []
    bench.outlines.click(QPointF(70.0, 40.0))
    assert bench.parts.part is LAMPS[1]
    assert next(item.row() for item in bench.form.table.selectedItems()) == 1
    bench.outlines.click(QPointF(95.0, 5.0))
    assert bench.parts.part is LAMPS[1]
    assert thick() == [1]
    bench.form.table.selectRow(2)
    assert bench.parts.part is LAMPS[2]
    assert thick() == [2]
    bench.form.whole_photo.click()
    assert bench.parts.part is None


def test_a_rectangle_is_clipped_to_the_photo(bench: Bench, photo: Photo) -> None:
    _rows, columns = photo.image.shape
    bench.outlines.drawn.emit(Region(-20, 30, 40, columns + 500))
    assert bench.parts.part == Region(0, 30, 40, columns)
    assert bench.form.by_hand.isChecked()
    bench.form.by_hand.click()
    assert bench.parts.part is None


def test_a_chosen_lamp_is_kept_as_its_rectangle(bench: Bench, photo: Photo) -> None:
    assert bench.choice.rectangle is None
    bench.find()
    bench.parts.choose(2)
    assert bench.parts.part is LAMPS[2]
    assert bench.choice.rectangle == LAMPS[2].region
    bench.change(lamps=())
    assert bench.parts.part == LAMPS[2].region
    bench.parts.match_whole()
    assert bench.choice.rectangle is None


def test_the_rectangle_dragged_is_the_one_matched(bench: Bench) -> None:
    bench.form.by_hand.click()
    rectangle = bench.outlines.rectangle
    assert rectangle.isVisible()
    rectangle.setPos((9.5, 4.5), finish=False)
    rectangle.setSize((30, 20))
    assert bench.parts.part == Region(5, 25, 10, 40)
    bench.parts.draw(Region(6, 26, 11, 41))
    corner, size = rectangle.pos(), rectangle.size()
    # A pixel's centre has a whole number.
    assert (corner.x(), corner.y(), size.x(), size.y()) == (10.5, 5.5, 30.0, 20.0)
    bench.form.whole_photo.click()
    assert bench.parts.part is None
    assert not bench.form.by_hand.isChecked()
    assert not rectangle.isVisible()


def test_a_drag_with_the_tool_on_draws_the_rectangle(
    bench: Bench, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(pg.CONFIG_OPTIONS, "mouseRateLimit", 0)
    view = bench.picture.photo.graphics

    def drag(first: QPointF, last: QPointF) -> None:
        places = (QPointF(bench.box.mapViewToScene(place)) for place in (first, last))
        drag_mouse(view.viewport(), *places)

    bench.box.setRange(xRange=(0, 100), yRange=(0, 60), padding=0.0)
    drag(QPointF(10, 5), QPointF(40, 25))
    assert bench.parts.part is None  # the tool is off: the picture moves
    bench.box.setRange(xRange=(0, 100), yRange=(0, 60), padding=0.0)
    bench.parts.draw(Region(30, 50, 60, 90))
    drag(QPointF(10, 5), QPointF(40, 25))
    found = bench.choice.rectangle
    corners = (found.first_row, found.last_row, found.first_column, found.last_column)
    assert corners == pytest.approx((5, 25, 10, 40), abs=1)


def test_a_region_stays_with_another_channel_and_comes_back_with_its_photo(
    bench: Bench, photo: Photo
) -> None:
    """Choosing the rows of the table of photos opens one photo after the other."""
    drawn, other = Region(5, 25, 10, 40), replace(photo, path=Path("other.png"))
    bench.parts.draw(drawn)
    red = replace(photo, channel="red")
    for shown, region in ((red, drawn), (other, None), (photo, drawn), (other, None)):
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


def test_what_was_found_in_the_whole_photo_is_stated_while_its_match_is_shown(
    bench: Bench, photo: Photo
) -> None:
    target, to_come = bench.form.target, "The whole photo will be searched for stripes."
    assert target.text() == to_come
    bench.change(outcome=MatchOutcome(None, match_with(), GIVEN))
    assert target.text() == "Found in the whole photo: columns 0 to 2, rows 0 to 8."
    bench.parts.draw(Region(5, 25, 10, 40))
    assert target.text().startswith("A drawn region will be matched")
    bench.parts.match_whole()
    bench.show_photo(replace(photo, path=Path("other.png")))
    assert target.text() == to_come


def photo_in(record: Mapping[str, object]) -> PhotoChoice:
    """Read the settings of photos from a session with a scene."""
    kept = read_session({"scene": Scene().to_toml()} | dict(record))
    return kept.workspace.photo


def test_a_damaged_region_is_left_out(photo: Photo) -> None:
    for kept, region in (
        ("x", None), ({"first_row": 1}, None), (asdict(Region(1, 2, 3, 4)), Region(1, 2, 3, 4)),
    ):  # fmt: skip
        found = photo_in({"photo": {"path": str(photo.path), "region": kept}})
        assert (found.path, found.rectangle) == (photo.path, region)


def test_a_rectangle_by_hand_begins_with_the_chosen_lamp_or_in_the_middle(
    bench: Bench, photo: Photo
) -> None:
    """The middle half of the photo, so that all its corners can be dragged."""
    rows, columns = photo.image.shape
    bench.parts.set_by_hand(True)
    middle = bench.choice.rectangle
    assert (2 * middle.rows, 2 * middle.columns) == (rows, columns)
    assert middle.first_row == rows - middle.last_row
    assert middle.first_column == columns - middle.last_column
    bench.parts.match_whole()
    bench.find()
    bench.parts.choose(2)
    bench.parts.set_by_hand(True)
    assert bench.parts.part == LAMPS[2].region


def test_lamps_are_searched_when_the_button_is_pressed(
    bench: Bench, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(occ, "find_lamps", lambda _photo, _report: LAMPS)
    bench.form.search.click()
    assert not bench.form.search.isEnabled()
    assert not bench.pane.is_idle
    qtbot.waitUntil(bench.form.search.isEnabled)
    assert bench.form.table.rowCount() == len(LAMPS)


def test_a_row_of_the_table_says_that_its_photo_was_matched_by_itself_since(
    bench: Bench, photo: Photo
) -> None:
    row, many = PhotoRow(photo.path, "sure", "", match_with()), bench.pane.view.many
    bench.photos.list_files((photo.path,))
    is_marked = many.rows.data(many.rows.index(0, 0), Qt.ItemDataRole.BackgroundRole) is not None
    assert is_marked, "it is the photo that is open"
    listed = replace(
        bench.results_store.results,
        listed=ListedRows((photo.path,), {0: row}, LoadOptions(), GIVEN, MatchSettings(Scene())),
    )
    document = listed.document
    own = replace(
        listed,
        document=replace(document, outcome=MatchOutcome(None, match_with(), GIVEN)),
    )
    for results, is_earlier in ((listed, False), (own, True), (listed, False)):
        bench.results_store.put(results)
        assert bench.shown.row is row
        assert ("earlier match" in many.rows.text(0, VERDICT)) == is_earlier
