"""Names of marks under a slider are drawn where there is space for them, and apart."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from gui.kinds import add_widget
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QSlider, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.scene.slider_scale import SliderScale
from occ_model.results.teaching import MarkedValue
from occ_model.scene.parameters import quantity

GAMMA = quantity("gamma")


def scale_of(qtbot: QtBot, width: int) -> tuple[QWidget, SliderScale]:
    """Make a scale as wide as its slider, and the widget that keeps both alive."""
    whole = add_widget(qtbot, QWidget())
    slider = QSlider(Qt.Orientation.Horizontal, whole)
    scale = SliderScale(slider, GAMMA, whole)
    for part in (slider, scale):
        part.setGeometry(0, 0, width, 30)
    whole.resize(width, 60)
    return whole, scale


@pytest.mark.parametrize(
    ("widths", "is_named"), [(1.4, True), (1.1, True), (0.6, True), (0.05, False)]
)
def test_two_names_give_way_to_each_other_or_the_second_is_left_out(
    qtbot: QtBot, grey_picture: Callable[[QWidget], Any], widths: float, is_named: bool
) -> None:
    _whole, scale = scale_of(qtbot, 600)
    width = QFontMetricsF(scale._font()).horizontalAdvance("mark")
    low, high = GAMMA.slider
    first = low + 0.4 * (high - low)
    a_pixel = (high - low) / (scale._x(high) - scale._x(low))
    second = first + a_pixel * width * widths

    def drawn(name: str) -> Any:
        scale.show_marks([MarkedValue(first, "mark", ""), MarkedValue(second, name, "")])
        return grey_picture(scale)

    assert bool(np.any(drawn("mark") != drawn(""))) == is_named
    drawn("mark")
    boxes = [box for _, box in scale._names(QFontMetricsF(scale._font()), [])]
    for box, value in zip(boxes, (first, second), strict=False):
        assert box.left() <= scale._x(value) <= box.right()
    for one, other in pairwise(boxes):
        assert other.left() - one.right() >= 4.0


def test_no_name_stands_over_the_value_of_an_end(qtbot: QtBot) -> None:
    _whole, scale = scale_of(qtbot, 300)
    metrics = QFontMetricsF(scale._font())
    low, high = GAMMA.slider
    ends = [QRectF(0, 5, 40, 14), QRectF(260, 5, 40, 14)]
    for fraction in (0.0, 0.02, 0.2, 0.5, 0.8, 0.98, 1.0):
        scale.show_marks([MarkedValue(low + fraction * (high - low), "a long name", "")])
        for _, box in scale._names(metrics, ends):
            assert not any(box.intersects(end) for end in ends)
        assert bool(scale._names(metrics, ends)) == (fraction in {0.2, 0.5, 0.8})


def test_a_mark_is_named_wherever_it_stands_and_an_end_gives_way(qtbot: QtBot) -> None:
    _whole, scale = scale_of(qtbot, 170)
    metrics = QFontMetricsF(scale._font())
    low, high = GAMMA.slider
    kept = []
    for fraction in np.linspace(0.0, 1.0, 41):
        scale.show_marks([MarkedValue(float(low + fraction * (high - low)), "t = 1 chip", "")])
        ends, names = scale._texts(metrics)
        assert [name for name, _ in names] == ["t = 1 chip"]
        assert not any(box.intersects(names[0][1]) for _, box in ends)
        kept.append(len(ends))
    assert set(kept) == {1, 2}
    assert kept[20] == 2, "in the middle both ends keep their values"
    scale.show_marks([])
    assert len(scale._texts(metrics)[0]) == 2
