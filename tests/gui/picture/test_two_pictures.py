"""The camera's picture and the receiver's are two, and each place says which it has."""

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from gui.user import User
from PIL import Image
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.image_view import ImageView
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Snapshot
from occ_model.photo.reading.load import Photo
from occ_model.results.frame import PICTURES

SnapshotOf = Callable[..., Snapshot]


@pytest.fixture
def view(qtbot: QtBot) -> ImageView:
    view = ImageView()
    qtbot.addWidget(view)
    view.resize(800, 400)
    view.show()
    return view


def shown_in(view: ImageView) -> AveragedImage:
    """Find the simulated picture on the screen."""
    items = view.simulation.box.childGroup.childItems()
    return next(item for item in items if isinstance(item, AveragedImage))


def test_the_camera_s_picture_is_shown_first_and_named(
    view: ImageView, snapshot_of: SnapshotOf
) -> None:
    frame = snapshot_of().frame
    view.show_picture(Picture.of(frame, "camera"))
    assert shown_in(view)._image is frame.camera_image
    assert view.simulation.caption.text() == "Camera's picture"
    assert view.switch.key() == "camera"
    assert not np.array_equal(frame.camera_image, frame.image)


def test_the_switch_shows_the_receiver_s_picture_and_says_so(
    view: ImageView, snapshot_of: SnapshotOf, qtbot: QtBot
) -> None:
    frame = snapshot_of().frame
    view.show_picture(Picture.of(frame, "camera"))
    chosen: list[str] = []
    view.picture_chosen.connect(chosen.append)
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


def test_the_pointer_reads_the_levels_of_both_pictures(
    application: Application, qtbot: QtBot
) -> None:
    application.story.show_whole_picture(True)
    pane, frame = application.view("picture").simulation, application.view("picture")._frame
    assert frame is not None
    view = pane.graphics
    centre = QPointF(frame.image.shape[1] / 2, frame.image.shape[0] / 2)
    place = QPoint(view.mapFromScene(pane.box.mapViewToScene(centre)))
    at = pane.box.mapSceneToView(QPointF(view.mapToScene(place)))
    column, row = round(at.x()), round(at.y())
    camera, receiver = frame.camera_image[row, column], frame.image[row, column]
    expected = (
        f"Simulation: column {column}, row {row}, camera level {camera}, receiver level {receiver}"
    )
    for whose in PICTURES:
        application.view("picture").choose_picture(whose)
        qtbot.mouseMove(view.viewport(), place + QPoint(1, 0))
        qtbot.mouseMove(view.viewport(), place)
        qtbot.waitUntil(lambda: application.window.pointed.toolTip() == expected)
    assert application.view("picture").levels_at(-1, 0) is None
    assert application.view("picture").levels_at(column, frame.image.shape[0]) is None


def test_the_position_where_a_fast_mouse_stops_is_read(application: Application) -> None:
    pane = application.view("picture").simulation
    viewport = pane.graphics.viewport()
    middle = viewport.rect().center()
    kind, none, no_key = QEvent.Type.MouseMove, Qt.MouseButton.NoButton, Qt.KeyboardModifier(0)
    for right in (0, 20, 40):  # faster than a hand
        place = QPointF(middle + QPoint(right, 0))
        everywhere = QPointF(viewport.mapToGlobal(place.toPoint()))
        event = QMouseEvent(kind, place, everywhere, none, none, no_key)
        QApplication.sendEvent(viewport, event)
        seen = pane.graphics.mapToScene(place.toPoint())
        column = round(pane.box.mapSceneToView(QPointF(seen)).x())
        assert application.window.pointed.toolTip().startswith(f"Simulation: column {column}, ")


def test_save_picture_writes_and_names_the_one_that_is_shown(
    application: Application, user: User, tmp_path: Path
) -> None:
    frame = application.view("picture")._frame
    assert frame is not None
    for whose in PICTURES:
        application.view("picture").choose_picture(whose)
        path = tmp_path / f"{whose}.png"
        application.files.save_picture(path)
        assert f"{whose}'s picture" in user.message
        with Image.open(path) as picture:
            assert np.array_equal(np.asarray(picture), frame.picture(whose))
            assert picture.info["Description"] == frame.picture_title(whose)


def test_an_export_draws_and_names_the_one_that_is_shown(
    application: Application, user: User, tmp_path: Path
) -> None:
    means = []
    for whose in PICTURES:
        application.view("picture").choose_picture(whose)
        path = tmp_path / f"{whose}.csv"
        application.shell.pane("export").export("picture", path)
        user.wait_until_idle()
        lines = path.read_text(encoding="utf-8").splitlines()
        assert f"{whose.title()}'s picture" in lines[0]
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
        means.append(np.mean([float(cell) for row in rows[1:] for cell in row[1:]]))
    frame = application.view("picture")._frame
    assert frame is not None
    assert means == pytest.approx([frame.camera_image.mean(), frame.image.mean()], abs=1.0)


def test_an_exported_profile_is_the_one_that_is_shown(
    application: Application, user: User, tmp_path: Path
) -> None:
    for enhanced in (False, True):
        application.view("profile").enhanced.setChecked(enhanced)
        path = tmp_path / f"{enhanced}.csv"
        application.shell.pane("export").export("profile", path)
        user.wait_until_idle()
        lines = path.read_text(encoding="utf-8").splitlines()
        assert ("after the receiver's enhancement" in lines[0]) == enhanced
        table = np.array(
            [line.split(",") for line in lines if line[:1].isdigit()], dtype=np.float64
        )
        for column, curve in (
            (1, application.view("profile").simulation),
            (2, application.view("profile").band),
        ):
            np.testing.assert_allclose(table[:, column], curve.getOriginalDataset()[1], atol=0.01)


def test_the_decoders_read_the_receiver_s_picture_whichever_is_shown(
    application: Application, user: User
) -> None:
    application.window.bring_to_front("decode")
    for whose in PICTURES:
        application.view("picture").choose_picture(whose)
        application.store.change(iso=200.0 if whose == "camera" else 300.0)
        user.wait_until_idle()
        frame = application.view("picture")._frame
        assert frame is not None
        signal = application.view("decode").signal.signal.getOriginalDataset()[1]
        read = occ.decode(frame.image, frame.scene).signal
        assert read is not None
        assert np.array_equal(signal, read)
