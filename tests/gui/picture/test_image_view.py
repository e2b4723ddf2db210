"""The simulated picture, the camera's or the receiver's, and the photo beside or over it."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from gui.kinds import SnapshotOf, collect, show_widget, with_result
from gui.mouse import move_mouse
from gui.pane_bench import PaneBench
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtWidgets import QApplication, QGraphicsRectItem, QWidget
from pytestqt.qtbot import QtBot
from shiboken6 import delete

import occ_model as occ
from occ_gui.app.panes import picture, profile
from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.image_view import ImageView
from occ_gui.picture.picture_pane import PicturePane
from occ_gui.profile.profile_view import ProfileView
from occ_gui.simulation.snapshot import Picture
from occ_gui.values.choices import OVERLAYS, Placement
from occ_gui.widgets.building import ElidedLabel
from occ_gui.window.cursor_readout import follow_pictures
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import DecodeResult, Region
from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene


@pytest.fixture
def view(qtbot: QtBot) -> ImageView:
    return show_widget(qtbot, ImageView(), 800, 400)


def pictures(pane: PicturePane) -> list[AveragedImage]:
    """Return the pictures that are visible in a pane, the lowest one first."""
    items = [item for item in pane.box.childGroup.childItems() if isinstance(item, AveragedImage)]
    return [i for i in items if i.isVisible() and not i.boundingRect().isEmpty()]


def region_of(pane: PicturePane) -> QGraphicsRectItem:
    (found,) = [
        item for item in pane.box.childGroup.childItems() if isinstance(item, QGraphicsRectItem)
    ]
    return found


def test_each_pixel_is_shown_at_its_row_and_column_and_the_region_round_those_that_were_read(
    view: ImageView, snapshot_of: SnapshotOf
) -> None:
    decoded = DecodeResult("threshold", region=Region(10, 60, 1200, 2300))
    view.show_snapshot(with_result(snapshot_of(), decoded))
    item = region_of(view.simulation)
    assert item.isVisible()
    assert item.rect() == QRectF(1199.5, 9.5, 1100, 50)
    view.show_snapshot(with_result(snapshot_of(), DecodeResult("threshold", failure="No.")))
    assert not item.isVisible()
    snapshot = snapshot_of()
    view.show_snapshot(snapshot)
    (picture,) = pictures(view.simulation)
    rows, columns = snapshot.frame.image.shape
    assert picture.boundingRect() == QRectF(-0.5, -0.5, columns, rows)


def test_a_draft_lies_where_its_picture_will_says_so_and_gives_the_levels_of_its_rows(
    view: ImageView, small_scene: Scene
) -> None:
    whole, draft = (occ.render(small_scene, rows_step=step) for step in (1, 7))
    view.show_picture(Picture(whole))
    seen, caption = view.simulation.box.viewRect(), view.simulation.caption.text()
    view.show_picture(Picture(draft))
    (picture,) = pictures(view.simulation)
    rows, columns = whole.image.shape
    assert picture.boundingRect() == QRectF(-0.5, -0.5, columns, 7 * len(draft.rows))
    assert 0 <= 7 * len(draft.rows) - rows < 7
    assert view.simulation.box.viewRect() == seen
    assert view.simulation.graphics.accessibleName() == "Draft, one row in 7: Camera's picture"
    view.show_picture(Picture(whole))
    assert view.simulation.box.viewRect() == seen
    assert view.simulation.caption.text() == caption
    view.show_picture(Picture(draft))
    for row in (0, 6, 7, small_scene.camera.rows - 1):
        levels = view.levels_at(1500, row)
        assert levels["receiver"] == draft.image[row // 7, 1500]
        assert view.simulation.level_at(1500, row) == levels["camera"]
    assert view.levels_at(1500, small_scene.camera.rows) is None


def test_a_draft_is_shown_until_all_rows_of_its_picture_are_there(
    view: ImageView, small_scene: Scene
) -> None:
    draft, whole = (occ.render(small_scene, rows_step=step) for step in (7, 1))
    view.show_picture(Picture(draft))
    view.show_picture(Picture(replace(whole, rows=whole.rows[60:140])))
    assert view.frame is draft
    view.show_picture(Picture(whole))
    assert view.frame is whole


def test_a_photo_is_compared_with_all_rows_of_a_draft(
    view: ImageView, small_scene: Scene, photo: Photo
) -> None:
    view.show_photo(photo)
    view.set_mode("difference")
    draft = occ.render(small_scene, rows_step=7)
    view.show_picture(Picture(draft))
    simulated = view.overlay.simulated
    assert simulated.shape == (small_scene.camera.rows, small_scene.camera.columns)
    assert np.array_equal(simulated[::7], draft.camera_image)


def test_the_rows_in_a_pixel_of_the_screen_are_those_in_view(
    view: ImageView, snapshot_of: SnapshotOf
) -> None:
    view.show_snapshot(snapshot_of())
    box, pane = view.simulation.box, view.simulation
    height = pane.graphics.height() * pane.devicePixelRatioF()
    assert view.rows_per_pixel() == pytest.approx(box.viewRect().height() / height)
    before = view.rows_per_pixel()
    box.setRange(box.viewRect().adjusted(100, 10, -100, -10), padding=0)
    assert view.rows_per_pixel() < before


def test_an_open_photo_stands_beside_the_simulation_and_says_when_lines_are_columns(
    view: ImageView, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    view.show_snapshot(snapshot_of())
    view.set_mode("blend")
    assert (view.photo.isVisible(), view.mode.isVisible()) == (False, False)
    assert len(pictures(view.simulation)) == 1
    view.set_mode("beside")
    for shown in (photo, replace(photo, turned=True)):
        view.show_photo(shown)
        assert view.photo.isVisible()
        caption = view.photo.caption.toolTip()
        assert "stripes.png" in caption
        assert ("its lines shown as columns" in caption) == shown.turned
        assert view.simulation.caption.toolTip() == "Simulated"
        assert len(pictures(view.simulation)) == 1
        view.show_photo(None)
        assert not view.photo.isVisible()
        assert view.simulation.caption.toolTip() == "Camera's picture"


def test_a_photo_over_the_simulation_lies_where_it_is_placed(
    view: ImageView, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    view.set_mode("blend")
    view.show_photo(photo)
    view.show_snapshot(snapshot_of())
    assert not view.photo.isVisible()
    assert view.opacity.isVisible()
    view.opacity.setValue(30)
    assert view.overlay.opacity == 0.3
    rows, columns = photo.image.shape
    for placement in (Placement(), Placement(12.25, 40.0), Placement(3.0, 4.0, 2.5)):
        view.show_placement(placement)
        _, over = pictures(view.simulation)
        left, top = placement.column - placement.scale / 2, placement.row - placement.scale / 2
        size = (columns * placement.scale, rows * placement.scale)
        assert over.boundingRect() == QRectF(left, top, *size)
    assert len(pictures(view.simulation)) == 2
    view.show_photo(None)
    assert len(pictures(view.simulation)) == 1
    assert not view.opacity.isVisible()


def test_a_result_of_the_same_size_keeps_the_users_view(
    view: ImageView, snapshot_of: SnapshotOf
) -> None:
    view.show_snapshot(snapshot_of())
    view.simulation.box.setRange(QRectF(1210, 20, 40, 40), padding=0)
    before = view.simulation.box.viewRect()
    view.show_snapshot(snapshot_of(iso=200.0))
    assert view.simulation.box.viewRect() == before
    view.show_snapshot(snapshot_of(columns=1000))
    assert view.simulation.box.viewRect().contains(QRectF(0, 0, 999, 199))


def test_fit_shows_both_pictures_whole_and_nothing_before_there_are_any(
    view: ImageView, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    view.fit()
    assert pictures(view.simulation) == []
    names = {child.accessibleName() for child in view.findChildren(QWidget)}
    assert {"Simulated picture", "Photo"} <= names
    snapshot = snapshot_of()
    view.show_snapshot(snapshot)
    view.show_photo(photo)
    for pane in (view.simulation, view.photo):
        pane.box.setRange(QRectF(0, 0, 5, 5), padding=0)
    view.fit()
    for pane, image in ((view.simulation, snapshot.frame.image), (view.photo, photo.image)):
        rows, columns = image.shape
        assert pane.box.viewRect().contains(QRectF(-0.5, -0.5, columns, rows))


def test_controls_that_a_mode_does_not_need_are_hidden_and_its_choice_is_announced(
    view: ImageView, snapshot_of: SnapshotOf, photo: Photo, qtbot: QtBot
) -> None:
    view.show_snapshot(snapshot_of())
    view.show_photo(photo)
    chosen = collect(view.mode_chosen)
    qtbot.keyClick(view.mode, Qt.Key.Key_Down)
    assert chosen == ["blend"]
    assert view.photo.isVisible(), "nothing is shown by itself"
    controls = {"blend": view.opacity, "difference": view.gain}
    for mode in OVERLAYS:
        view.set_mode(mode)
        assert view.mode.key() == mode
        assert view.mode.isVisible()
        assert view.photo.isVisible() == (mode == "beside")
        assert [m for m, control in controls.items() if control.isVisible()] == [
            m for m in controls if m == mode
        ]
        assert view.overlay.line.isVisible() == (mode == "split")
        assert view.overlay.difference.isVisible() == (mode == "difference")


def test_the_factor_of_the_difference_is_in_the_caption(
    view: ImageView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    view.set_mode("difference")
    for times in ("4", "8"):
        assert view.gain.key() == times
        assert f"× {times}:" in view.simulation.caption.toolTip()  # noqa: RUF001
        qtbot.keyClick(view.gain, Qt.Key.Key_Down)


def test_the_camera_s_picture_is_shown_first_and_the_switch_shows_the_receiver_s_both_named(
    view: ImageView, snapshot_of: SnapshotOf, qtbot: QtBot
) -> None:
    frame = snapshot_of().frame
    view.show_picture(Picture(frame))
    assert pictures(view.simulation)[0].image is frame.camera_image
    assert view.simulation.caption.text() == "Camera's picture"
    assert view.switch.key() == "camera"
    assert not np.array_equal(frame.camera_image, frame.image)
    chosen = collect(view.picture_chosen)
    qtbot.keyClick(view.switch, Qt.Key.Key_Down)
    assert chosen == ["receiver"]
    assert pictures(view.simulation)[0].image is frame.image
    assert view.simulation.caption.text() == "Receiver's picture, enhanced by equalization"
    assert view.simulation.graphics.accessibleName() == view.simulation.caption.text()
    assert view.overlay.simulated is frame.image
    other = snapshot_of(enhancement="none").frame
    view.show_picture(Picture(other))
    assert pictures(view.simulation)[0].image is other.image
    assert view.simulation.caption.text() == "Receiver's picture, not enhanced"


def test_before_is_of_the_same_picture_as_now(view: ImageView, snapshot_of: SnapshotOf) -> None:
    before = snapshot_of(iso=400.0)
    view.show_snapshot(snapshot_of())
    view.before.show_before(before)
    view.before.checkbox.setChecked(True)
    assert view.before.picture.image is before.frame.camera_image
    view.choose_picture("receiver")
    assert view.before.picture.image is before.frame.image


def test_every_way_of_showing_a_photo_names_the_picture(
    view: ImageView, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    view.resize(1600, 400)
    view.show_snapshot(snapshot_of())
    view.show_photo(photo)
    for picture_kind in PICTURES:
        view.choose_picture(picture_kind)
        assert view.switch.key() == picture_kind, (
            "side by side the choice beside the caption names it"
        )
        for mode in ("blend", "split", "difference"):
            view.set_mode(mode)
            assert f"{picture_kind}'s picture" in view.simulation.caption.toolTip().lower()


class Bench(PaneBench):
    """Picture, profile and decoding."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.picture: ImageView = self.add(picture(self.store, str)).view
        self.profile: ProfileView = self.add(profile(self.store, self.results_store, str)).view
        self.frame = self.simulate().frame


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Bench:
    return Bench(qtbot, small_scene)


def test_the_pointer_reads_the_levels_of_both_pictures(bench: Bench) -> None:
    pane, frame, pointed = bench.picture.simulation, bench.frame, list[str]()
    follow_pictures(bench.picture, pointed.append)
    view = pane.graphics
    middle = QPointF(frame.image.shape[1] / 2, frame.image.shape[0] / 2)
    place = QPoint(view.mapFromScene(pane.box.mapViewToScene(middle)))
    for picture_kind in PICTURES:
        bench.picture.choose_picture(picture_kind)
        for right in (0, 20, 40):  # faster than by hand; the last position is read as well
            point = place + QPoint(right, 0)
            move_mouse(view.viewport(), point)
            at = pane.box.mapSceneToView(QPointF(view.mapToScene(point)))
            column, row = round(at.x()), round(at.y())
            assert pointed[-1] == (
                f"Simulation: column {column}, row {row}, camera level "
                f"{frame.camera_image[row, column]}, receiver level {frame.image[row, column]}"
            )
    assert bench.picture.levels_at(-1, 0) is None
    assert bench.picture.levels_at(0, frame.image.shape[0]) is None


def test_the_mouse_leaves_a_view_whose_label_went_first(bench: Bench) -> None:
    pane, label = bench.picture.simulation, ElidedLabel()
    follow_pictures(bench.picture, label.set_full_text)
    middle = QPointF(bench.frame.image.shape[1] / 2, bench.frame.image.shape[0] / 2)
    view = pane.graphics
    move_mouse(view.viewport(), QPoint(view.mapFromScene(pane.box.mapViewToScene(middle))))
    assert label.toolTip().startswith("Simulation: column")
    delete(label)
    assert QApplication.sendEvent(view.viewport(), QEvent(QEvent.Type.Leave))


def test_an_export_draws_and_names_the_one_that_is_shown(bench: Bench, tmp_path: Path) -> None:
    means = []
    for picture_kind in PICTURES:
        bench.picture.picture_chosen.emit(picture_kind)
        path = tmp_path / f"{picture_kind}.csv"
        bench.export("picture", path)
        lines = path.read_text(encoding="utf-8").splitlines()
        assert f"{picture_kind.title()}'s picture" in lines[0]
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
        means.append(np.mean([float(cell) for row in rows[1:] for cell in row[1:]]))
    frame = bench.frame
    assert means == pytest.approx([frame.camera_image.mean(), frame.image.mean()], abs=1.0)


def test_an_exported_profile_is_the_one_that_is_shown(bench: Bench, tmp_path: Path) -> None:
    for enhanced in (False, True):
        bench.profile.enhanced.setChecked(enhanced)
        path = tmp_path / f"{enhanced}.csv"
        bench.export("profile", path)
        lines = path.read_text(encoding="utf-8").splitlines()
        assert ("after the receiver's enhancement" in lines[0]) == enhanced
        table = np.array(
            [line.split(",") for line in lines if line[:1].isdigit()], dtype=np.float64
        )
        for column, curve in ((1, bench.profile.simulation), (2, bench.profile.band)):
            np.testing.assert_allclose(table[:, column], curve.getOriginalDataset()[1], atol=0.01)
