"""Parts of figures: ticks, ends of axes, legends, and names."""

from dataclasses import replace

import numpy as np
import pytest
from accuracy_points import EACH_WAY
from matplotlib.axis import Axis
from matplotlib.text import Annotation
from model.figures.test_every_figure import table_of

import occ_model as occ
from occ_model.figures.accuracy import accuracy_drawing
from occ_model.figures.decoding import decode_drawing
from occ_model.figures.drawing import house_style
from occ_model.figures.page import fit_texts
from occ_model.figures.paper import choose_columns, pad_profile
from occ_model.figures.room import room_drawing
from occ_model.figures.sweep import sweep_drawing
from occ_model.results.decoding import Region
from occ_model.room.locate import RoomReading
from occ_model.room.reading import ReadLamp
from occ_model.scene.scene import Scene


@pytest.mark.parametrize(("left", "first"), [(3.4, 4), (5.0, 5), (-7.2, 0)])
def test_a_profile_begins_with_the_first_column_whose_middle_shows_the_panel(
    left: float, first: int
) -> None:
    frame = occ.render(Scene().replace(rows=20, columns=4000), tolerance=np.inf)
    frame = replace(frame, corners=np.array([[left, 2.0], [300.0, 2.0]]))
    shown, end = choose_columns(frame.scene, frame)
    assert shown == first
    assert first < end <= 4000


@pytest.mark.parametrize("length", [2, 4, 9])
def test_a_photos_profile_has_the_columns_of_the_simulated_one(length: int) -> None:
    found = pad_profile(np.array([1.0, 2.0, 3.0, 4.0]), length)
    assert len(found) == length
    assert found[:4].tolist() == [1.0, 2.0, 3.0, 4.0][:length]
    assert np.isnan(found[4:]).all()


FREQUENCIES = np.geomspace(0.97e3, 31e3, 13).tolist()
EXPOSURES = np.linspace(33e-6, 97e-6, 11).tolist()


def values_at(axis: Axis, cells: list[float]) -> dict[float, float]:
    """Return, for each label, the value at its place among the cells."""
    numbers = np.arange(len(cells), dtype=np.float64)
    return {
        float(tick.get_text()): float(np.interp(place, numbers, cells))
        for tick, place in zip(axis.get_ticklabels(), axis.get_ticklocs(), strict=True)
    }


def test_labels_are_round_and_at_their_values() -> None:
    axes = {"switching_frequency": tuple(FREQUENCIES), "exposure_time": tuple(EXPOSURES)}
    ax = sweep_drawing(table_of(axes)).draw().axes[0]
    kilohertz = values_at(ax.xaxis, np.log(np.array(FREQUENCIES) / 1e3).tolist())
    assert list(kilohertz) == [1.0, 2.0, 5.0, 10.0, 20.0]
    assert np.exp(list(kilohertz.values())) == pytest.approx(list(kilohertz), rel=1e-9)
    microseconds = values_at(ax.yaxis, (np.array(EXPOSURES) * 1e6).tolist())
    assert list(microseconds) == [40.0, 50.0, 60.0, 70.0, 80.0, 90.0]
    assert list(microseconds.values()) == pytest.approx(list(microseconds), rel=1e-9)


def test_an_axis_of_bits_a_second_reaches_as_far_as_its_best_point_can() -> None:
    table = table_of({"readout_time": (40e-6, 8e-6, 20e-6)})
    _, top = sweep_drawing(table, "bits").draw().axes[0].get_ylim()
    assert top == pytest.approx(1.03 * 30.0 * 10)


def test_the_split_of_each_kind_of_run_has_a_line_and_a_name_of_its_own() -> None:
    scene = occ.load_preset("phone-68us")
    result = occ.decode(occ.column_profile(scene), scene)
    with house_style():
        runs = decode_drawing(scene, result).draw().axes[1]
    styles = {
        str(line.get_label()): (line.get_color(), line.get_linestyle()) for line in runs.lines
    }
    assert set(styles) == {"split of the dark runs", "split of the lit runs"}
    assert all(len(set(each)) == 2 for each in zip(*styles.values(), strict=True))


@pytest.mark.parametrize(
    "name", ["office", "hall", pytest.param("corridor", marks=pytest.mark.whole)]
)
def test_the_names_of_a_rooms_lamps_lie_within_its_picture_and_on_no_other_lamp(name: str) -> None:
    room = occ.load_room(name)
    rows, columns = room.scene.camera.rows, room.scene.camera.columns
    corners = ((0, 0), (columns - 9, 0), (0, rows - 9), (columns - 9, rows - 9))
    lamps = tuple(
        ReadLamp(
            "H12", 0, Region(row, row + 8, column, column + 8),
            np.array([[column, row], [column + 8.0, row], [column, row + 8.0]]), True, "",
        )
        for column, row in corners
    )  # fmt: skip
    reading = RoomReading(lamps, None, (), ("Too few edges.",))
    stripes = np.tile(np.array([0, 255], np.uint8), (rows, columns // 2))
    with house_style():
        figure = room_drawing(room, stripes, reading).draw()
        fit_texts(figure)
        figure.draw_without_rendering()
    plan, picture = figure.axes
    assert np.ptp(picture.images[0].get_array()) <= 1.0  # too fine for stripes in print
    for text in picture.texts:
        box = text.get_bbox_patch()
        assert box is not None
        place, inside = box.get_window_extent(), picture.get_window_extent().padded(0.5)
        assert inside.x0 <= place.x0 < place.x1 <= inside.x1
        assert inside.y0 <= place.y0 < place.y1 <= inside.y1
    names = [text for text in plan.texts if isinstance(text, Annotation)]
    assert len(names) == len(room.lamps)
    outlines = [patch.get_window_extent() for patch in plan.patches[: len(names)]]
    for place in [text.get_window_extent() for text in names]:
        assert place.count_overlaps(outlines) == 0


def test_no_name_in_the_accuracy_figure_covers_another_or_leaves_the_axes() -> None:
    close = [replace(point, seconds=1e-4, error=0.4) for point in EACH_WAY if point.part != "draft"]
    with house_style():
        figure = accuracy_drawing(close).draw()
        figure.draw_without_rendering()
    (axes,) = figure.axes
    boxes = [name.get_window_extent() for name in axes.texts]
    assert all(box.count_overlaps(boxes) == 1 for box in boxes)  # itself
    assert all(box.x1 < axes.bbox.x1 for box in boxes)
