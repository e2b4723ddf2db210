"""Form of the photo's placement on the simulated picture: shift and scale."""

from dataclasses import astuple

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.scene.number_edits import DecimalEdit
from occ_gui.scene.parameter_rows import explain
from occ_gui.values.choices import LARGEST_SCALE, LEAST_SCALE, Placement
from occ_gui.widgets.building import fill, name_widget, push_button
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.units import NONE, PIXEL

_LARGEST_SHIFT = 1e6  # largest shift of a photo in pixels


def _make_shift(name: str, label: str, meaning: str) -> Quantity:
    return Quantity(
        name, label, "", meaning, unit=PIXEL, low=-_LARGEST_SHIFT, high=_LARGEST_SHIFT,
        slider=(0.0, 5000.0), scale="linear", default=0.0,
    )  # fmt: skip


COLUMN = _make_shift(
    "photo_column",
    "Column of the photo",
    "Column of the simulation under the photo's first column, in pixels.",
)

ROW = _make_shift(
    "photo_row", "Row of the photo", "Row of the simulation under the photo's first row, in pixels."
)

SCALE = Quantity(
    "photo_scale",
    "Scale of the photo",
    "",
    "Pixels of the simulation per pixel of the photo.",
    unit=NONE, low=LEAST_SCALE, high=LARGEST_SCALE, slider=(0.1, 10.0), scale="log", default=1.0,
)  # fmt: skip

_FIELD_DIGITS = 12  # width of a field with arrows and frame, in digits


class _CompactField(DecimalEdit):
    """A field as wide as usual values; Qt would make it as wide as the largest allowed value."""

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(self.minimumSizeHint().width(), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        width = _FIELD_DIGITS * self.fontMetrics().horizontalAdvance("0")
        return QSize(width, super().minimumSizeHint().height())


class PlacementForm(QWidget):
    """Shift and scale of the photo, by numbers or by the mouse, and a reset button."""

    placed = Signal(object)  # the user moved or scaled the photo: a Placement
    reset_asked = Signal()
    refused = Signal(str)  # why an entered value is refused
    accepted = Signal()  # an allowed value was entered, whether or not it differs from the last one
    moving_chosen = Signal(bool)  # whether the user moves and scales the photo by the mouse

    def __init__(self) -> None:
        super().__init__()
        self._placement = Placement()
        self._fields: list[DecimalEdit] = []
        self.column, self.row = self._make_field(COLUMN, 2), self._make_field(ROW, 2)
        self.scale = self._make_field(SCALE, 5)
        self.scale.setSingleStep(0.01)
        self.by_mouse = push_button(
            "Mo&ve by mouse",
            "Show a frame round the photo while it lies on the simulation: drag it to move "
            "the photo, its corners to scale it.",
        )
        self.by_mouse.setCheckable(True)
        self.by_mouse.toggled.connect(self.moving_chosen)
        self.reset = push_button(
            "&Reset",
            "Place the photo automatically: pixel on pixel if both pictures have the same "
            "size, otherwise with its lamp on the panel.",
            self.reset_asked,
        )
        self._lay_out()
        self.show_placement(Placement(), by_hand=False)

    def _make_field(self, declared: Quantity, decimals: int) -> DecimalEdit:
        field = name_widget(_CompactField(declared, decimals), declared.label, explain(declared))
        field.setAlignment(Qt.AlignmentFlag.AlignRight)
        field.valueChanged.connect(self._emit_placement)
        keep_wheel_for_scrolling(field)
        self._fields.append(field)
        field.refused.connect(self.refused)
        field.accepted.connect(self.accepted)
        return field

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(2)
        texts = ("Photo at column", "row", "scaled by")
        for column, (text, field) in enumerate(zip(texts, self._fields, strict=True)):
            grid.addWidget(QLabel(text), 0, column)
            grid.addWidget(field, 1, column)
            grid.setColumnStretch(column, 1)
        buttons = fill(QHBoxLayout(), self.by_mouse, self.reset, None)
        fill(QVBoxLayout(self), grid, buttons, margins=0, spacing=4)

    def show_placement(self, placement: Placement, by_hand: bool) -> None:
        self._placement = placement
        for field, value in zip(self._fields, astuple(placement), strict=True):
            field.notice.end()
            with QSignalBlocker(field):
                field.setValue(value)
        self.reset.setEnabled(by_hand)

    def _emit_placement(self) -> None:
        # A field that was not edited keeps the digits that it does not show.
        values = [
            field.value() if abs(field.value() - value) > 10.0 ** -field.decimals() / 2 else value
            for field, value in zip(self._fields, astuple(self._placement), strict=True)
        ]
        self.placed.emit(Placement(*values))
