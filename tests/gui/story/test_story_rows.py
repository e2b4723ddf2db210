"""All rows share one axis and one crosshair, and their values there are the model's."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import floor
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from gui.kinds import GreyPicture, SnapshotOf, with_result
from gui.mouse import turn_wheel_at
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.simulation.snapshot import Picture, Snapshot
from occ_gui.story import code_row, light_row
from occ_gui.story.column_axis import GUTTER, Crosshair
from occ_gui.story.column_values import describe_values
from occ_gui.story.story_row import StoryRow
from occ_gui.story.story_rows import StoryRows
from occ_gui.widgets.state_look import State
from occ_model.results.frame import Frame
from occ_model.scene.scene import SimulationSettings
from occ_model.simulation.render import render_with


def all_rows(rows: StoryRows) -> list[StoryRow]:
    return [rows.light, rows.stripes, rows.profile, rows.code]


def place_of(row: StoryRow, column: float) -> QPoint:
    return QPointF(row.x_of(column), row.height() / 2).toPoint()


@pytest.mark.parametrize(("width", "zoom"), [(520, 4.0), (900, 1.0), (1573, 0.13)])
def test_a_column_lies_at_the_same_pixel_in_every_row(
    rows: StoryRows, width: int, zoom: float
) -> None:
    rows.resize(width, 620)
    rows.axis.zoom(zoom, 1400.0)
    for column in np.linspace(rows.axis.first, rows.axis.last, 7).tolist():
        places = {
            round(rows.mapFromGlobal(row.mapToGlobal(QPointF(row.x_of(column), 0.0))).x(), 6)
            for row in all_rows(rows)
        }
        assert len(places) == 1
        scale = rows.columns
        at = scale.mapTo(rows, QPointF(rows.axis.find_pixel(column, scale.width()), 0.0)).x()
        assert places == {round(at, 6)}
        assert rows.light.column_at(rows.light.x_of(column)) == pytest.approx(column)


def test_rows_kept_from_an_earlier_scene_equal_those_drawn_anew(
    rows: StoryRows, snapshot_of: SnapshotOf
) -> None:
    for name, value in (
        ("exposure_time", 97e-6), ("switching_frequency", 7e3), ("readout_time", 9e-6),
        ("start_time", 1.3e-4), ("code", 5), ("edge_time", 4e-5), ("iso", 60.0),
    ):  # fmt: skip
        snapshot = snapshot_of(**{name: value})
        rows.show_picture(Picture(snapshot.frame, snapshot.request))
        rows.show_reading(snapshot)
        before = rows.grab().toImage()
        for row in all_rows(rows):
            row.redraw()
        assert before == rows.grab().toImage(), name


def test_the_stripes_show_each_column_at_its_place(
    rows: StoryRows, snapshot: Snapshot, grey_picture: GreyPicture
) -> None:
    rows.axis.zoom(0.2, 1400.0)
    drawn = grey_picture(rows.stripes)[rows.stripes.height() // 2]
    first, last = rows.stripes.panel_rows()
    means = snapshot.frame.camera_image[first:last].mean(axis=0)
    inside = range(int(rows.axis.first) + 2, int(rows.axis.last) - 2)
    chosen = rows.crosshair.column
    levels = [drawn[round(rows.stripes.x_of(column))] for column in inside if column != chosen]
    expected = [means[column] for column in inside if column != chosen]
    np.testing.assert_allclose(levels, expected, atol=1.0)


def test_a_draft_shows_the_stripes_at_the_same_place(
    rows: StoryRows, snapshot: Snapshot, grey_picture: GreyPicture
) -> None:
    exact, view = grey_picture(rows.stripes), rows.stripes.thumbnail.view
    draft = occ.render(snapshot.frame.scene, tolerance=np.inf, rows_step=7)
    rows.show_picture(Picture(draft, snapshot.request))
    drafted = grey_picture(rows.stripes)
    np.testing.assert_array_equal(drafted[:, GUTTER:], exact[:, GUTTER:])
    assert rows.stripes.thumbnail.view.top() == pytest.approx(view.top(), abs=7)
    assert rows.stripes.thumbnail.view.height() == pytest.approx(view.height(), abs=14)


def test_the_panels_rows_alone_give_the_same_stripes_as_the_whole_picture(
    rows: StoryRows, snapshot_of: SnapshotOf, grey_picture: GreyPicture
) -> None:
    frame = snapshot_of(rows=1000, distance=6.0).frame
    rows.show_picture(Picture(frame))
    exact, view = grey_picture(rows.stripes), rows.stripes.thumbnail.view
    parts: list[Frame] = []
    render_with(frame.scene, SimulationSettings(), show_panel=parts.append)
    (part,) = parts
    rows.show_picture(Picture(part))
    np.testing.assert_array_equal(grey_picture(rows.stripes), exact)
    assert rows.stripes.thumbnail.view == view


@pytest.mark.parametrize(
    ("changes", "step"), [({}, 1), ({"distance": 0.4}, 7), ({"pitch": 0.2}, 22)]
)
def test_the_stripes_are_the_rows_of_a_draft_that_show_the_panel(
    rows: StoryRows, bare_snapshot_of: SnapshotOf, step: int, changes: dict[str, Any]
) -> None:
    snapshot = bare_snapshot_of(**changes)
    rows.show_picture(Picture(snapshot.frame))
    rows_per_pixel = rows.stripes.rows_per_pixel()
    draft = occ.render(snapshot.frame.scene, tolerance=np.inf, rows_step=step)
    rows.show_picture(Picture(draft))
    first, last = rows.stripes.panel_rows()
    ends = draft.corners[:, 1].min(), draft.corners[:, 1].max()
    expected = [row for row in draft.rows if ends[0] <= row <= ends[1]]
    assert list(draft.rows[first:last]) == expected
    assert rows.stripes.rows_per_pixel() == rows_per_pixel


@pytest.mark.parametrize(
    "changes", [{}, {"exposure_time": 136e-6}, {"start_time": 3.3e-3, "readout_time": 11e-6}]
)
def test_the_values_at_the_crosshair_are_the_models(
    rows: StoryRows, bare_snapshot_of: SnapshotOf, changes: dict[str, Any]
) -> None:
    snapshot = bare_snapshot_of(**changes)
    scene, frame = snapshot.frame.scene, snapshot.frame
    rows.show_reading(snapshot)
    lit = occ.on_time(scene) / scene.camera.exposure_time
    chips, frequency = occ.packet(scene), scene.transmitter.switching_frequency
    for column in (1, 1213, 1344, 1501):
        rows.crosshair.point_at(column + 0.2)
        values = rows.values()
        time = scene.model.start_time + column * scene.camera.readout_time
        assert (values.column, values.time) == (column, time)
        exact = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
        assert values.light == chips[floor(exact * Fraction(frequency)) % len(chips)]
        assert values.mean_light == pytest.approx(lit[column], abs=1e-9)
        assert values.level == frame.profile[column]
        words = describe_values(values, scene)
        assert f"column {column}" in words
        assert ("light on" in words) == bool(values.light)
        rows.choose_picture("receiver")
        assert rows.values().level == frame.signal[column]
        rows.choose_picture("camera")


def test_the_bits_at_the_crosshair_are_those_read_and_it_has_no_column_outside_the_picture(
    rows: StoryRows, snapshot: Snapshot
) -> None:
    code, result = rows.code, snapshot.results["threshold"]
    bits: dict[int | None, int | None] = {}
    for field in code.fields:
        rows.crosshair.point_at((code.edges[field.first] + code.edges[field.last]) / 2)
        values = rows.values()
        bits[values.bit] = values.value
        assert values.state is (State.NEUTRAL if field.bit is None else State.GOOD)
    assert bits.pop(None) is None
    assert bits == dict(enumerate(result.bits.tolist()))
    assert code.accessibleDescription() == "sent 1011001110, received 1011001110, 0 wrong"
    chosen = rows.crosshair.column
    for column in (-3.0, len(snapshot.profile) + 2.0):
        rows.crosshair.point_at(column)
        assert rows.crosshair.mouse_column is None
        assert rows.values().column == chosen


def test_dragging_the_exposure_window_chooses_the_column_at_its_start(
    rows: StoryRows, qtbot: QtBot
) -> None:
    light = rows.light
    window = light.exposure_window()
    middle = (window[0] + window[1]) / 2
    button = Qt.MouseButton.LeftButton
    qtbot.mousePress(light, button, pos=place_of(light, middle))
    for distance in (20, 60, 100):
        qtbot.mouseMove(light, place_of(light, middle + distance))
    qtbot.mouseRelease(light, button, pos=place_of(light, middle + 100))
    moved_window = light.exposure_window()
    assert rows.crosshair.column == moved_window[0]
    # A pixel of the mouse is less than one column here.
    assert moved_window[0] - window[0] == pytest.approx(100.0, abs=1.0)
    assert moved_window[1] - moved_window[0] == pytest.approx(68.0 / 8.0)
    assert rows.axis.is_following


def test_a_click_on_any_row_or_a_key_chooses_a_column_and_keys_zoom_and_fit(
    rows: StoryRows, qtbot: QtBot
) -> None:
    for row, column in zip(all_rows(rows), (1250, 1300, 1500, 1700), strict=True):
        qtbot.mouseClick(row, Qt.MouseButton.LeftButton, pos=place_of(row, column))
        assert rows.crosshair.column == pytest.approx(column, abs=1)
    chosen, home = rows.crosshair.column, rows.axis.span
    for key, moved in ((Qt.Key.Key_Right, 1), (Qt.Key.Key_PageUp, 11), (Qt.Key.Key_Left, 10)):
        qtbot.keyClick(rows.light, key)
        assert rows.crosshair.column == chosen + moved
    qtbot.keyClick(rows.light, Qt.Key.Key_Plus)
    assert rows.axis.span < home
    qtbot.keyClick(rows.light, Qt.Key.Key_Home)
    assert rows.axis.span == home


def test_the_wheel_zooms_all_rows_about_the_mouse_and_the_picture_is_never_out_of_view(
    rows: StoryRows,
) -> None:
    for row in all_rows(rows):
        before, span = row.x_of(1400.0), rows.axis.span
        turn_wheel_at(row, place_of(row, 1400.0))
        assert rows.axis.span < span
        assert all(each.x_of(1400.0) == pytest.approx(before, abs=1.5) for each in all_rows(rows))
    assert not rows.axis.is_following
    for columns in (-1e5, 1e5):
        rows.axis.pan(columns)
        assert rows.axis.first < 3455.5
        assert rows.axis.last > -0.5
    for _ in range(60):
        rows.axis.zoom(1.5, 1000.0)
    assert rows.axis.span < 2.0 * 3456
    for _ in range(60):
        rows.axis.zoom(0.5, 1000.0)
    assert rows.axis.span == 4.0


def test_a_drag_moves_all_rows_and_a_double_click_fits(rows: StoryRows, qtbot: QtBot) -> None:
    row, button = rows.profile, Qt.MouseButton.LeftButton
    home, chosen = (rows.axis.first, rows.axis.last), rows.crosshair.column
    start = place_of(row, 1400.0)
    qtbot.mousePress(row, button, pos=start)
    for step in (20, 60, 120):
        qtbot.mouseMove(row, start + QPoint(step, 0))
    qtbot.mouseRelease(row, button, pos=start + QPoint(120, 0))
    assert rows.light.x_of(1400.0) == pytest.approx(start.x() + 120, abs=1.5)
    assert rows.crosshair.column == chosen
    qtbot.mouseDClick(row, button, pos=start)
    assert (rows.axis.first, rows.axis.last) == home


def test_the_closed_hand_of_a_drag_opens_at_its_end(rows: StoryRows, qtbot: QtBot) -> None:
    row, place = rows.profile, place_of(rows.profile, 1400.0)
    qtbot.mousePress(row, Qt.MouseButton.LeftButton, pos=place)
    row.setCursor(Qt.CursorShape.ClosedHandCursor)
    qtbot.mouseRelease(row, Qt.MouseButton.LeftButton, pos=place + QPoint(40, 0))
    assert row.cursor().shape() != Qt.CursorShape.ClosedHandCursor


def test_new_results_keep_a_range_that_the_user_chose(
    rows: StoryRows, bare_snapshot_of: SnapshotOf
) -> None:
    rows.axis.zoom(0.3, 1400.0)
    chosen = (rows.axis.first, rows.axis.last)
    rows.show_reading(bare_snapshot_of(switching_frequency=7e3))
    assert (rows.axis.first, rows.axis.last) == chosen
    rows.axis.fit()
    assert rows.axis.span == pytest.approx(2.0 * 24 / 7e3 / 8e-6, rel=0.03)


def test_wrong_bits_are_marked_refused_ones_are_not_and_those_without_columns_are_listed(
    rows: StoryRows, snapshot: Snapshot
) -> None:
    bits = snapshot.results["threshold"].bits.copy()
    bits[3] ^= 1
    wrong = with_result(snapshot, replace(snapshot.results["threshold"], bits=bits, code=700))
    before = rows.code.grab().toImage()
    rows.show_reading(wrong)
    assert rows.code.state_of(3) is State.BAD
    assert [rows.code.state_of(bit) for bit in (0, 1, 2, 4)] == [State.GOOD] * 4
    assert rows.code.accessibleDescription().endswith("1 wrong")
    assert rows.code.grab().toImage() != before
    decoded = replace(snapshot.results["threshold"], headers=())
    assert decoded.failure is None
    assert decoded.bits.size
    rows.code.show_reading(snapshot, decoded)
    assert rows.code.make_list_label() == "from all packets together:"
    assert rows.code.state_of(0) is State.GOOD
    rows.code.show_reading(snapshot, replace(decoded, failure="Too noisy.", code=None))
    assert rows.code.make_list_label() == "not accepted:"
    assert {rows.code.state_of(bit) for bit in range(decoded.bits.size)} == {State.NEUTRAL}
    for received in (4, 400):  # fewer than were sent, and more
        bits = np.ones(received, dtype=np.uint8)
        rows.code.show_reading(snapshot, replace(decoded, bits=bits))
        assert rows.code.state_of(min(received, 10)) is State.NEUTRAL
        assert not rows.code.grab().isNull()


def test_bits_stand_side_by_side_and_each_letter_over_its_bits(
    rows: StoryRows, bare_snapshot_of: SnapshotOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = list[tuple[str, QRectF, dict[str, Any]]]()

    def note(_painter: object, cell: QRectF, texts: Sequence[str], _: object, **look: Any) -> None:
        drawn.append((texts[0], cell, look))

    monkeypatch.setattr(code_row, "draw_field", note)
    monkeypatch.setattr(light_row, "draw_field", note)
    snapshot = bare_snapshot_of(payload="text:Hi", distance=0.4)
    rows.show_reading(snapshot)
    result = snapshot.results["threshold"]
    listed = replace(result, headers=())
    for row, decoded in ((rows.light, result), (rows.code, result), (rows.code, listed)):
        rows.code.show_reading(snapshot, decoded)
        drawn.clear()
        row.redraw()
        row.grab()
        area, letters = row.plot_area(), set[str]()
        bits = [cell for text, cell, _ in drawn if text in "01"]
        for text, letter, look in drawn:
            if text in "Hi" and area.left() <= letter.left() and letter.right() <= area.right():
                own = [bit for bit in bits if letter.left() - 1 < bit.left() < letter.right() - 1]
                assert (len(own), look.get("has_text")) == (8, None)
                edges = [letter.left(), *(bit.right() for bit in own)]
                assert edges == pytest.approx([*(bit.left() for bit in own), letter.right()])
                letters.add(text)
        assert letters == {"H", "i"}
        assert all(look["has_text"] for text, _, look in drawn if text in "01")


def test_a_decoder_without_chips_lists_its_bits(rows: StoryRows) -> None:
    rows.choose_decoder("matched")
    assert rows.code.edges is None
    assert rows.code.value_of(0) == 1
    assert rows.profile.threshold is None
    rows.choose_decoder("threshold")
    assert rows.code.edges is not None


def test_the_legend_names_what_is_drawn_and_why_the_band_model_drifts_or_ends(
    rows: StoryRows, bare_snapshot_of: SnapshotOf
) -> None:
    assert rows.legend.keys == ("simulation", "threshold", "band")
    rows.show_reading(bare_snapshot_of(exposure_time=136e-6))
    assert rows.legend.keys == ("simulation", "threshold")
    assert rows.legend.note == "no band model here"
    rows.show_reading(bare_snapshot_of(band_reading="literal"))
    assert "whole columns" in rows.legend.toolTip()
    assert "drift" in rows.legend.toolTip()
    assert rows.legend.note.startswith("drifts ")
    rows.show_reading(bare_snapshot_of())
    assert rows.legend.note == ""
    assert "width and levels" in rows.legend.toolTip()
    # Whole columns for each band, and no equal chips beside each other: nothing is lost.
    whole = {"pattern": "10", "switching_frequency": 12.5e3, "exposure_time": 40e-6}
    rows.show_reading(bare_snapshot_of(**whole, readout_time=8e-6, band_reading="literal"))
    assert rows.legend.note == ""
    ended = bare_snapshot_of(exposure_time=136e-6)
    rows.show_reading(ended)
    assert rows.legend.toolTip() == ended.band_undefined
    assert "136 µs" in rows.legend.toolTip()


@pytest.mark.parametrize(
    "changes",
    [
        {"switching_frequency": 1e8},
        {"switching_frequency": 1.0},
        {"exposure_time": 3.0},
        {"distance": 40.0},
        {"start_time": 1e4},
        {"pattern": "1"},
        {"columns": 2},
    ],
)
def test_extreme_scenes_are_drawn(
    rows: StoryRows, bare_snapshot_of: SnapshotOf, changes: dict[str, Any]
) -> None:
    snapshot = bare_snapshot_of(**changes)
    rows.show_picture(Picture(snapshot.frame, snapshot.request))
    rows.show_reading(snapshot)
    for name in ("packets", "panel"):
        rows.choose_range(name)
        for row in all_rows(rows):
            assert not row.grab().isNull()
    assert describe_values(rows.values(), snapshot.frame.scene)


def test_before_any_reading_the_profile_is_empty_and_no_column_is_under_the_mouse(
    qtbot: QtBot,
) -> None:
    rows, painter = StoryRows(), Mock()
    qtbot.addWidget(rows)
    rows.profile.draw(painter, QRectF(100.0, 0.0, 700.0, 100.0))
    assert painter.mock_calls == []
    crosshair = Crosshair()
    crosshair.set_columns(100, 10)
    crosshair.point_at(90.0)
    assert crosshair.mouse_column == 90
    crosshair.set_columns(50, 10)
    assert crosshair.mouse_column is None


def test_a_column_chosen_on_the_panel_stays_on_it_and_one_beside_it_stays_as_it_is(
    rows: StoryRows, snapshot_of: SnapshotOf
) -> None:
    def panel() -> tuple[float, float]:
        columns = shown.corners[:, 0]
        return float(columns.min()), float(columns.max())

    for follows in (True, False):
        shown = snapshot_of(distance=0.6)
        rows.show_reading(shown)
        rows.choose_range("panel") if follows else rows.axis.zoom(1.5, 1400.0)
        column = panel()[0] + 20.0
        rows.crosshair.choose(column)
        shown = snapshot_of(distance=2.0)
        assert column < panel()[0]
        rows.show_reading(shown)
        assert rows.crosshair.column is not None
        assert panel()[0] <= rows.crosshair.column <= panel()[1]
        assert rows.axis.is_following == follows
        outside = panel()[0] - 20.0
        rows.crosshair.choose(outside)
        rows.show_reading(snapshot_of(distance=2.1))
        assert rows.crosshair.column == round(outside)
