"""Names of marks under a slider are drawn where there is space for them, and apart."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QSlider, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.scene.slider_scale import SliderScale
from occ_model.results.teaching import MarkedValue
from occ_model.scene.parameters import quantity


@pytest.mark.parametrize(("apart", "is_named"), [(12.0, True), (5.0, True), (3.0, False)])
def test_a_name_stands_four_pixels_from_the_one_before_or_is_left_out(
    qtbot: QtBot, grey_picture: Callable[[QWidget], Any], apart: float, is_named: bool
) -> None:
    whole = QWidget()
    qtbot.addWidget(whole)
    declared = quantity("gamma")
    slider = QSlider(Qt.Orientation.Horizontal, whole)
    scale = SliderScale(slider, declared, whole)
    for part in (slider, scale):
        part.setGeometry(0, 0, 600, 30)
    whole.resize(600, 60)
    width = QFontMetricsF(scale._font()).horizontalAdvance("mark")
    low, high = declared.slider
    first = low + 0.4 * (high - low)
    a_pixel = (high - low) / (scale._x(high) - scale._x(low))
    second = first + a_pixel * (width + apart)

    def drawn(name: str) -> Any:
        scale.show_marks([MarkedValue(first, "mark", ""), MarkedValue(second, name, "")])
        return grey_picture(scale)

    assert bool(np.any(drawn("mark") != drawn(""))) == is_named
