"""View of a room: its plan, the camera's picture, and the place found from the picture."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QDoubleSpinBox,
    QHBoxLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
)

from occ_gui.room.jobs import PLACES_PER_SIDE, FloorMap, RoomPicture, RoomPlan
from occ_gui.room.room_plots import PicturePlot, PlanPlot
from occ_gui.scene.number_edits import QuantityEdit
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import fill, name_widget, paragraph, push_button
from occ_model.errors import inflect, one_line
from occ_model.room.locate import RoomReading
from occ_model.room.place_text import ANGLES, POSITION, format_place
from occ_model.room.room import HEIGHT, Room
from occ_model.scene.parameters import quantity
from occ_model.scene.units import METRE

_LEAST_HEIGHT = 260
_HEIGHT = "Camera's height"

_LEGEND = (
    "Drag the ring (the camera) or the triangle (where it looks). Dashed: what it sees at the "
    "lamps' height. Cross and ellipse: the place found, and two standard "
    "deviations"
)


class RoomView(QWidget):
    """A choice of rooms, a headline, the plan beside the picture, and the floor's map."""

    file_asked = Signal()  # the user wants to choose a room file
    photo_asked = Signal()  # the user wants to choose a photo of the room
    photo_closed = Signal()  # the user wants the simulated picture instead of the photo

    focal_length_entered = Signal(float)
    """The user enters the photo's equivalent focal length, in metres."""

    height_entered = Signal(float)
    """The user enters the camera's height above the floor, in metres."""

    map_asked = Signal()  # the user wants to measure the map of the floor

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__()
        self.rooms = QComboBox()
        self.rooms.setAccessibleName("Room")
        self.rooms.setToolTip("The room that is shown: one of those that come with the program.")
        self.rooms.addItems(names)
        self.open = push_button(
            "&Open a room file…",
            "Show a room of your own: a file of its lamps and its camera.",
            self.file_asked,
        )
        self.photo = push_button(
            "Open a &photo…",
            "Name the lamps in a photo of this room, and see where it was taken.",
            self.photo_asked,
        )
        self.close_photo = push_button(
            "&Close the photo", "Show what the camera of the plan sees.", self.photo_closed
        )
        self.focal_length = _make_focal_length_field()
        self.focal_length.valueChanged.connect(lambda mm: self.focal_length_entered.emit(1e-3 * mm))
        self.height_field = name_widget(
            QuantityEdit(replace(HEIGHT, name="height")), _HEIGHT, "The height above the floor, z."
        )
        self._height_label = QLabel(_HEIGHT)
        self.height_field.edited.connect(self.height_entered)
        for widget in (self.close_photo, self.focal_length):
            widget.hide()
        self.measure = push_button(
            "&Measure the floor",
            f"Simulate a picture at each of {PLACES_PER_SIDE**2} places below the lamps, and "
            "locate it.",
            self.map_asked,
        )
        self.answer, self.legend, self.floor = Answer(), paragraph(f"{_LEGEND}."), paragraph()
        self.plan, self.picture = PlanPlot(), PicturePlot()
        for plot in (self.plan, self.picture):
            plot.setMinimumHeight(_LEAST_HEIGHT)
        buttons = fill(
            QHBoxLayout(), self.rooms, self.open, self.photo, self.close_photo, self.focal_length,
            self.measure, None, self._height_label, self.height_field,
        )  # fmt: skip
        row = fill(QHBoxLayout(), (self.plan, 1), (self.picture, 1))
        fill(
            QVBoxLayout(self), buttons, self.answer, (row, 1), self.legend, self.floor,
        )  # fmt: skip

    def show_name(self, name: str) -> None:
        self.rooms.setPlaceholderText(one_line(name))
        self.rooms.setCurrentIndex(self.rooms.findText(name))

    def show_plan(self, room: Room, plan: RoomPlan, *, is_new: bool) -> None:
        """Show lamps and camera, and clear the results of the last picture."""
        self.plan.show_plan(plan, room.camera, is_new=is_new)
        self.plan.show_place(None, room.camera)
        self.height_field.set_value(room.camera.z)
        self.answer.show_answer("Reading the picture…")

    def show_picture(self, picture: RoomPicture, *, is_present: bool) -> None:
        self.picture.show_room(picture)
        self._show_photo(picture)
        if picture.reading is None or not is_present:
            return
        scale = self.plan.show_place(picture.reading.located, picture.room.camera)
        enlarged = f", both enlarged {scale:g} times" if scale > 1.0 else ""
        self.legend.setText(f"{_LEGEND}{enlarged}.")
        details = _describe_reading(picture, picture.reading)
        reasons = " ".join(picture.reading.reasons)
        self.answer.show_answer(_make_headline(picture.reading), details, reasons)

    def _show_photo(self, picture: RoomPicture) -> None:
        is_photo = picture.source.photo is not None
        self.close_photo.setVisible(is_photo)
        self.focal_length.setVisible(is_photo)
        for part in (self.measure, self._height_label, self.height_field):
            part.setVisible(not is_photo)
        with QSignalBlocker(self.focal_length):
            self.focal_length.setValue(1e3 * picture.room.scene.camera.equivalent_focal_length)

    def show_failure(self, sentence: str) -> None:
        self.answer.show_answer(sentence)

    def show_progress(self, fraction: float) -> None:
        self.floor.setText(f"Measuring the floor: {100.0 * fraction:.0f} %")

    def show_map(self, floor_map: FloorMap | None) -> None:
        self.plan.show_map(floor_map)
        self.floor.setText(_describe_map(floor_map) if floor_map else "")


def _make_focal_length_field() -> QDoubleSpinBox:
    field, limits = QDoubleSpinBox(), quantity("equivalent_focal_length")
    field.setRange(1e3 * limits.low, 1e3 * limits.high)
    field.setDecimals(2)
    field.setPrefix("Focal length: ")
    field.setSuffix(" mm equivalent")
    field.setKeyboardTracking(False)
    field.setAccessibleName("Equivalent focal length of the photo")
    field.setToolTip("That of the photo's lens; a value entered counts as exact.")
    return field


def _make_headline(reading: RoomReading) -> str:
    if reading.located is None:
        return "The place is not determined"
    text = format_place(reading.located.place, reading.located, POSITION)
    return f"I am here: {text}" if reading.is_sure else f"Perhaps here: {text}"


def _describe_reading(picture: RoomPicture, reading: RoomReading) -> list[str]:
    names = [
        lamp.name + (f" ({lamp.light_words})" if lamp.code is None else "")
        for lamp in reading.lamps if lamp.name
    ]  # fmt: skip
    lines = [f"{len(names)} of {len(reading.lamps)} lamps named: {', '.join(names) or 'none'}."]
    if reading.located is not None:
        place, true = reading.located.place, picture.room.camera
        distance = math.dist((place.x, place.y, place.z), (true.x, true.y, true.z))
        parts = [] if picture.source.photo else [f"{METRE.format(distance, 2)} from the true place"]
        angles = format_place(place, reading.located, ANGLES)
        lines.append("; ".join([*parts, f"the camera is turned by {angles}"]).capitalize() + ".")
    if picture.assumptions:
        lines.append("Assumed: " + " ".join(picture.assumptions))
    return lines


def _describe_map(floor_map: FloorMap) -> str:
    points = floor_map.points
    sure = [point for point in points if point.sure_places]
    named, whole, wrong = (
        sum(getattr(point, count) for point in points)
        for count in ("named", "whole", "named_wrongly")
    )
    text = (
        f"Map of the floor: {len(sure)} of {len(points)} places determined (blue, else orange), "
        f"{named} of {whole} whole lamps named, {inflect(wrong, 'lamp')} named wrongly."
    )
    if sure:
        text += f" Median error: {METRE.format(float(np.median([p.error for p in sure])), 2)}."
    return text
