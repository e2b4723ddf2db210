"""The animation of a rolling shutter: a column's stripe appears as its exposure ends."""

from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from gui.kinds import add_widget
from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.lessons.shutter_animation import ShutterDrawing
from occ_model.results.teaching import RollingShutter
from occ_model.teaching.light_over_columns import rolling_shutter


@pytest.fixture
def shutter() -> RollingShutter:
    return rolling_shutter(occ.load_preset("phone-68us"))


@pytest.fixture
def widget(qtbot: QtBot) -> QWidget:
    widget = add_widget(qtbot, QWidget())
    widget.resize(500, 400)
    return widget


@pytest.fixture(params=[0.0, 0.6, 1.0])
def moment(request: pytest.FixtureRequest) -> float:
    return float(request.param)


@pytest.fixture
def drawing(widget: QWidget, shutter: RollingShutter, moment: float) -> ShutterDrawing:
    return ShutterDrawing(Mock(), widget, shutter, moment)


def list_rectangles(drawing: ShutterDrawing) -> list[QRectF]:
    painter: Any = drawing.painter
    return [call.args[0] for call in painter.fillRect.call_args_list]


def test_the_stripes_are_those_of_exposures_that_have_ended(
    drawing: ShutterDrawing, shutter: RollingShutter, moment: float
) -> None:
    drawing.draw_stripes()
    has_ended = shutter.starts + shutter.exposure_time <= moment * shutter.duration * (1.0 + 1e-9)
    assert len(list_rectangles(drawing)) == int(has_ended.sum())
    assert has_ended.all() == (moment == 1.0)


def test_the_bar_of_a_column_is_filled_as_far_as_its_exposure_has_gone(
    drawing: ShutterDrawing, widget: QWidget, shutter: RollingShutter, moment: float
) -> None:
    drawing.draw_bars()
    elapsed = np.clip(moment * shutter.duration - shutter.starts, 0.0, shutter.exposure_time)
    widths = [place.width() for place in list_rectangles(drawing)]
    assert widths == pytest.approx(elapsed / shutter.duration * widget.width())
