"""Where the handle of a slider can stand."""

from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QSlider, QStyle, QStyleOptionSlider


def slider_travel(slider: QSlider) -> tuple[float, float]:
    """Return the x of the handle's centre at both ends, in the slider's own pixels."""
    first, last = (_centre(slider, place) for place in (slider.minimum(), slider.maximum()))
    return first, last


def slider_handle(slider: QSlider) -> tuple[float, float]:
    """Return the x of the handle's left and right side, in the slider's own pixels."""
    handle = _handle(slider, slider.sliderPosition())
    return handle.left(), handle.right()


def _centre(slider: QSlider, position: int) -> float:
    return _handle(slider, position).center().x()


def _handle(slider: QSlider, position: int) -> QRectF:
    option = QStyleOptionSlider()
    slider.initStyleOption(option)
    option.sliderPosition = position
    handle = slider.style().subControlRect(
        QStyle.ComplexControl.CC_Slider, option, QStyle.SubControl.SC_SliderHandle, slider
    )
    return QRectF(handle)
