"""At usual sizes of the window no control is cut off, squeezed or covered."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from gui.layout_faults import find_cut_axis_labels, find_faults, is_cut_off
from gui.user import User
from PySide6.QtCore import QSize
from PySide6.QtWidgets import (
    QApplication,
    QTabWidget,
    QWidget,
)
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace
from occ_gui.detection_map.rate_map import RateMap, make_lattice
from occ_gui.values.choices import OVERLAYS
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.scene import Scene

LEAST, LARGE = QSize(1000, 700), QSize(1920, 1080)
SIZES = [
    LEAST,
    *(pytest.param(size, marks=pytest.mark.whole) for size in (QSize(1280, 800), LARGE)),
]
NO_BAND_MODEL = {"exposure_time": 200e-6}
NO_CODE = {"switching_frequency": 500.0, "distance": 5.0}
MISREAD: dict[str, Any] = {"exposure_time": 136e-6, "switching_frequency": 20e3}
MANY_BITS = {"bits": 16, "code": 2**16 - 1}
STATES: tuple[dict[str, Any], ...] = (NO_BAND_MODEL, NO_CODE, MISREAD, MANY_BITS)


def assert_faultless(qtbot: QtBot, window: QWidget, what: object) -> None:
    """Wait until the layout has no fault, and check the window's size."""

    def check() -> None:
        assert find_faults(window) == [], what

    qtbot.waitUntil(check)
    least = window.minimumSizeHint()
    assert least.boundedTo(window.size()) == least, what


def pages(application: Application) -> Iterator[str]:
    (tabs,) = application.controls.findChildren(QTabWidget)
    for place in range(tabs.count()):
        tabs.setCurrentIndex(place)
        yield tabs.tabText(place)


def show_all_of_photo(application: Application) -> None:
    """Show a running match, a failure, and the result of the match before."""
    photo = application.view("photo")
    photo.form.sent.show_key("lamp")
    photo.form.sent.chosen.emit("lamp")
    photo.result.show()
    photo.verdict.end_match(["No scene explains the stripes of this photo at all. " * 4])
    photo.form.show_running(True)


@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size.width()}x{size.height()}")
def test_no_control_is_cut_off_squeezed_or_overlapped(
    qtbot: QtBot, application: Application, user: User, photo_file: Path, size: QSize
) -> None:
    application.window.resize(size)
    for page in pages(application):
        assert_faultless(qtbot, application.window, page)
    for changes in STATES:
        application.store.change(**changes)
        user.wait_until_idle()
        assert_faultless(qtbot, application.window, changes)
    application.files.open_photo(photo_file)
    application.view("profile").enhanced.setChecked(True)
    user.wait_until_idle()
    assert_faultless(qtbot, application.window, "photo beside")
    for mode in OVERLAYS:
        application.options.choose_overlay(mode)
        assert_faultless(qtbot, application.window, mode)
    show_all_of_photo(application)
    assert_faultless(qtbot, application.window, "photo matched")
    assert application.window.size() == size
    application.view("profile").enhanced.setChecked(False)


@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size.width()}x{size.height()}")
def test_the_accuracy_pane_is_whole_and_readable_at_every_size(
    qtbot: QtBot, application: Application, user: User, size: QSize
) -> None:
    application.window.resize(size)
    application.window.bring_to_front("accuracy")
    application.store.change(**MISREAD, edge_time=5e-6)
    user.wait_until_idle()
    assert_faultless(qtbot, application.window, "accuracy")
    assert find_cut_axis_labels(application.window) == []


@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size.width()}x{size.height()}")
def test_the_map_is_whole_and_readable_at_every_size(
    qtbot: QtBot, application: Application, size: QSize
) -> None:
    application.window.resize(size)
    application.window.bring_to_front("map")
    view = application.view("map")
    x, y = "switching_frequency", "distance"
    rates = RateMap(x, y, make_lattice(x, 13), make_lattice(y, 7), ("threshold", "matched"))
    rates.enter([SweepPoint(index, 10, (10, 10), "", (1, 1)) for index in range(91)], 2)
    view.show_map(rates)
    view.show_omissions(("Vignetting", "JPEG"))
    assert_faultless(qtbot, application.window, "map")
    for part in (*view.plots.plots, view.plots.bar):
        assert not part.isVisible() or not is_cut_off(part), part
    plot = view.plots.plots[0]
    assert plot.rect().toRectF().contains(plot.area())
    assert plot.area().contains(plot.place_of((1.0, 1.0)))
    assert application.window.size() == size


@pytest.mark.parametrize(
    "changes",
    [STATES[0], *(pytest.param(each, marks=pytest.mark.whole) for each in STATES[1:])],
    ids=str,
)
def test_the_window_opens_at_the_requested_size_for_any_scene(
    qtbot: QtBot, small_scene: Scene, changes: dict[str, float]
) -> None:
    fresh = Application(Workspace(small_scene.replace(**changes)))
    assert fresh.window.size() == QSize(1280, 800)
    fresh.window.resize(LEAST)
    fresh.window.show()
    qtbot.waitUntil(lambda: fresh.is_idle)
    QApplication.processEvents()
    size = fresh.window.size()
    fresh.window.close()
    fresh.window.deleteLater()
    assert size == LEAST
