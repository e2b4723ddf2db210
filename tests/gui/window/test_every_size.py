"""In every mode, pane and tab, at every usual size and scale, no text is cut off or squeezed."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyqtgraph as pg
import pytest
from gui.detection_map.test_advice import advice_on
from gui.layout_faults import find_faults, is_cut_off
from gui.shared_window import end
from gui.user import User
from gui.window.size_walk import LARGE, LEAST, SIZES, USUAL, walk
from matches import match_with
from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace
from occ_gui.detection_map.rate_map import RateMap, make_lattice
from occ_gui.values.choices import OVERLAYS, MatchChoice
from occ_gui.values.photo_results import MatchOutcome, MatchRequest
from occ_gui.window.theme import SIZES as TEXT_SIZES
from occ_model.receiver.decode import DECODERS
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.scene import Scene

TESTS = Path(__file__).parents[2]


def faults_of(
    qtbot: QtBot, application: Application, user: User, sizes: tuple[QSize, ...] = SIZES
) -> dict[str, str]:
    def settle() -> None:
        user.wait_until_idle()
        for _ in range(4):  # what is laid out asks for more in turn
            QApplication.processEvents()

    qtbot.wait(1)
    return walk(application, settle, sizes)


def assert_none(faults: dict[str, str]) -> None:
    assert not faults, "\n".join(f"{place}: {fault}" for fault, place in faults.items())


def test_nothing_is_cut_at_any_size_after_all_modes_and_with_filled_limits(
    qtbot: QtBot, application: Application, user: User
) -> None:
    application.window.resize(LEAST)
    application.window.bring_to_front("map")
    advice = advice_on(application.scene_store.scene)
    view, x, y = application.view("map"), "switching_frequency", "distance"
    for decoder in DECODERS:
        limits = replace(advice.limits, decoder=decoder)
        view.advice.show_advice(replace(advice, limits=limits))
    rates = RateMap(x, y, make_lattice(x, 13), make_lattice(y, 7), ("threshold", "matched"))
    rates.enter([SweepPoint(index, 10, (10, 10), "", (1, 1)) for index in range(91)], 2)
    view.show_map(rates)
    view.show_omissions(("Vignetting", "JPEG"))
    qtbot.waitUntil(lambda: not any(map(is_cut_off, (*view.plots.plots, view.plots.bar))))
    plot = view.plots.plots[0]
    assert plot.rect().toRectF().contains(plot.area())
    assert plot.area().contains(plot.place_of((1.0, 1.0)))
    assert_none(faults_of(qtbot, application, user))


@pytest.mark.parametrize(
    "changes",
    [
        {"exposure_time": 136e-6, "switching_frequency": 20e3, "iso": 6400.0, "edge_time": 5e-6},
        {"light": "lamp", "lamp_frequency": 120.0, "duty": 0.3},
        pytest.param({"bits": 16, "code": 2**16 - 1}, marks=pytest.mark.whole),
        pytest.param({"light": "mains"}, marks=pytest.mark.whole),
    ],
    ids=str,
)
def test_nothing_is_cut_for_any_light_and_verdict(
    qtbot: QtBot, application: Application, user: User, changes: dict[str, Any]
) -> None:
    user.change(**changes)
    assert_none(faults_of(qtbot, application, user, (USUAL, LEAST)))


def test_nothing_is_cut_off_squeezed_or_overlapped_beside_a_photo(
    application: Application, user: User, photo_file: Path, qtbot: QtBot
) -> None:
    def check() -> None:
        assert find_faults(application.window) == [], mode

    application.window.resize(LEAST)
    application.files.open_photo(photo_file)
    application.view("profile").enhanced.setChecked(True)
    user.wait_until_idle()
    photos, choice = application.photos, MatchChoice("lamp")
    document, reason = photos.document, "No scene explains the stripes of this photo at all. " * 4
    refused = replace(document, outcome=MatchOutcome(None, match_with(), ("", 0.0), (reason,)))
    request = MatchRequest(document.photo, application.scene_store.scene, choice, None)
    for mode in (*OVERLAYS, "refused", "running"):
        if mode in OVERLAYS:
            application.options.choose_overlay(mode)
        else:  # with the result of the match before
            photos.edit(lambda each: replace(each, form=choice))
            is_running = mode == "running"
            photos.put(replace(refused, match_request=request) if is_running else refused)
        qtbot.waitUntil(check)
    assert application.window.size() == LEAST
    application.view("profile").enhanced.setChecked(False)


def test_the_window_opens_at_the_size_asked_for(qtbot: QtBot, small_scene: Scene) -> None:
    before = QApplication.topLevelWidgets()
    fresh = Application(Workspace(small_scene.replace(exposure_time=200e-6)))  # no band model
    first = fresh.window.size()
    fresh.window.resize(LEAST)
    fresh.window.show()
    qtbot.waitUntil(lambda: fresh.is_idle)
    QApplication.processEvents()
    opened = fresh.window.size()
    end(fresh, before)
    assert (first, opened) == (USUAL, LEAST)


@pytest.mark.own_window
def test_larger_text_is_not_cut_and_all_is_as_before_once_it_is_normal_again(
    qtbot: QtBot, application: Application, user: User
) -> None:
    window = application.window
    faults_of(qtbot, application, user, (USUAL,))  # makes all panes
    first = fonts_and_axes(window)
    application.options.text_size.choose(TEXT_SIZES[-1])
    faults = faults_of(qtbot, application, user, (LARGE,))
    application.options.text_size.reset()
    QApplication.processEvents()
    assert_none(faults)
    again = fonts_and_axes(window)
    changed = {each: (size, again.get(each, size)) for each, size in first.items()}
    assert {each: two for each, two in changed.items() if two[0] != two[1]} == {}


def fonts_and_axes(window: QWidget) -> dict[object, object]:
    """Return the size of text of each widget that was shown, and the height of each axis' name."""
    sizes: dict[object, object] = {
        widget: widget.font().pointSizeF()
        for widget in window.findChildren(QWidget)
        if widget.testAttribute(Qt.WidgetAttribute.WA_WState_Polished)
    }
    for plot in window.findChildren(pg.PlotWidget):
        for side in ("left", "bottom"):
            sizes[plot, side] = plot.getAxis(side).label.boundingRect().height()
    return sizes


@pytest.mark.whole
@pytest.mark.parametrize("scale", ["2", "1.5"])
def test_nothing_is_cut_on_a_screen_of_another_scale(scale: str) -> None:
    command = [sys.executable, "-m", "gui.window.size_walk", "phone-136us"]
    environment = {**os.environ, "QT_SCALE_FACTOR": scale, "PYTHONPATH": str(TESTS)}
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=600, check=True
    )
    assert done.stdout == ""
