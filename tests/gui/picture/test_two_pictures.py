"""The camera's picture and the receiver's are two, and each place says which it has."""

import csv
from pathlib import Path

import numpy as np
import pytest
from gui.kinds import SnapshotOf, collect, show_widget
from gui.pane_bench import PaneBench
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot
from shiboken6 import delete

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.feature import picture
from occ_gui.picture.image_view import ImageView
from occ_gui.profile.feature import profile
from occ_gui.profile.profile_view import ProfileView
from occ_gui.simulation.preview import Picture
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.window.cursor_readout import follow_pictures
from occ_model.photo.reading.load import Photo
from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene


@pytest.fixture
def view(qtbot: QtBot) -> ImageView:
    return show_widget(qtbot, ImageView(), 800, 400)


def shown_in(view: ImageView) -> AveragedImage:
    """Find the simulated picture on the screen."""
    items = view.simulation.box.childGroup.childItems()
    return next(item for item in items if isinstance(item, AveragedImage))


def test_the_camera_s_picture_is_shown_first_and_the_switch_shows_the_receiver_s_both_named(
    view: ImageView, snapshot_of: SnapshotOf, qtbot: QtBot
) -> None:
    frame = snapshot_of().frame
    view.show_picture(Picture.of(frame, "camera"))
    assert shown_in(view)._image is frame.camera_image
    assert view.simulation.caption.text() == "Camera's picture"
    assert view.switch.key() == "camera"
    assert not np.array_equal(frame.camera_image, frame.image)
    chosen = collect(view.picture_chosen)
    qtbot.keyClick(view.switch, Qt.Key.Key_Down)
    assert chosen == ["receiver"]
    assert shown_in(view)._image is frame.image
    assert view.simulation.caption.text() == "Receiver's picture, enhanced by equalization"
    assert view.simulation.graphics.accessibleName() == view.simulation.caption.text()
    assert view.overlay._simulated is frame.image
    other = snapshot_of(enhancement="none").frame
    view.show_picture(Picture.of(other, "receiver"))
    assert shown_in(view)._image is other.image
    assert view.simulation.caption.text() == "Receiver's picture, not enhanced"


def test_the_smaller_copies_are_those_of_the_picture_shown(
    view: ImageView, snapshot_of: SnapshotOf
) -> None:
    frame = snapshot_of(rows=1200).frame
    view.choose_picture("receiver")
    view.show_picture(Picture.of(frame, "camera"))  # prepared before the choice
    assert shown_in(view)._halves == ()
    view.show_picture(Picture.of(frame, "receiver"))
    assert len(shown_in(view)._halves) == 2
    assert abs(shown_in(view)._halves[0].mean() - frame.image.mean()) < 1.0


def test_before_is_of_the_same_picture_as_now(view: ImageView, snapshot_of: SnapshotOf) -> None:
    before = snapshot_of(iso=400.0)
    view.show_snapshot(snapshot_of())
    view.before.show_before(before)
    view.before.chosen.setChecked(True)
    assert view.before.picture._image is before.frame.camera_image
    view.choose_picture("receiver")
    assert view.before.picture._image is before.frame.image


def test_every_way_of_showing_a_photo_names_the_picture(
    view: ImageView, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    view.resize(1600, 400)
    view.show_snapshot(snapshot_of())
    view.show_photo(photo)
    for whose in PICTURES:
        view.choose_picture(whose)
        assert view.switch.key() == whose, "side by side the choice beside the caption names it"
        for mode in ("blend", "split", "difference"):
            view.set_mode(mode)
            assert f"{whose}'s picture" in view.simulation.caption.toolTip().lower()


class Bench(PaneBench):
    """Picture, profile and decoding."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.picture: ImageView = self.add(picture(self.store, str)).view
        self.profile: ProfileView = self.add(profile(self.store, self.board, str)).view
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
    for whose in PICTURES:
        bench.picture.choose_picture(whose)
        for right in (0, 20, 40):  # faster than a hand: where it stops is read, too
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


def move_mouse(viewport: QWidget, point: QPoint) -> None:
    """Move the mouse to a point, no button down."""
    kind, none, no_key = QEvent.Type.MouseMove, Qt.MouseButton.NoButton, Qt.KeyboardModifier(0)
    everywhere = QPointF(viewport.mapToGlobal(point))
    QApplication.sendEvent(
        viewport, QMouseEvent(kind, QPointF(point), everywhere, none, none, no_key)
    )


def test_an_export_draws_and_names_the_one_that_is_shown(bench: Bench, tmp_path: Path) -> None:
    means = []
    for whose in PICTURES:
        bench.picture.picture_chosen.emit(whose)
        path = tmp_path / f"{whose}.csv"
        bench.export("picture", path)
        lines = path.read_text(encoding="utf-8").splitlines()
        assert f"{whose.title()}'s picture" in lines[0]
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
