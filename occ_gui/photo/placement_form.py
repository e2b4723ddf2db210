"""Form of the photo's placement on the simulated picture: shift and scale."""

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QDoubleSpinBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from occ_gui.picture.placement import LARGEST_SCALE, LEAST_SCALE, Placement
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling

_FARTHEST = 1e6
"""Largest shift of a photo in pixels."""


class PlacementForm(QWidget):
    """Shift and scale of the photo, by numbers or by the mouse, and a reset button."""

    placed = Signal(object)
    """The user moved or scaled the photo: a Placement."""

    reset_asked = Signal()
    moving_chosen = Signal(bool)
    """Whether the user moves and scales the photo by the mouse."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._placement = Placement()
        self.column = self._field(
            self.tr("Column of the photo"),
            self.tr("Column of the simulation under the photo's first column, in pixels."),
        )
        self.row = self._field(
            self.tr("Row of the photo"),
            self.tr("Row of the simulation under the photo's first row, in pixels."),
        )
        for field in (self.column, self.row):
            field.setRange(-_FARTHEST, _FARTHEST)
            field.setDecimals(2)
            field.setSuffix(self.tr(" px"))
        self.scale = self._field(
            self.tr("Scale of the photo"),
            self.tr("Pixels of the simulation to one of the photo."),
        )
        self.scale.setRange(LEAST_SCALE, LARGEST_SCALE)
        self.scale.setDecimals(5)
        self.scale.setSingleStep(0.01)
        self.by_mouse = QPushButton(self.tr("Mo&ve by mouse"))
        self.by_mouse.setCheckable(True)
        self.by_mouse.setToolTip(
            self.tr(
                "Show a frame round the photo while it lies on the simulation: drag it to move "
                "the photo, its corners to scale it."
            )
        )
        self.by_mouse.toggled.connect(self.moving_chosen)
        self.reset = QPushButton(self.tr("&Reset"))
        self.reset.setToolTip(
            self.tr(
                "Place the photo automatically: pixel on pixel if both pictures have the same "
                "size, else at the panel's corner."
            )
        )
        self.reset.clicked.connect(self.reset_asked)
        self._lay_out()
        self.show_placement(Placement(), by_hand=False)

    def _field(self, name: str, meaning: str) -> QDoubleSpinBox:
        field = QDoubleSpinBox()
        field.setAccessibleName(name)
        field.setToolTip(meaning)
        field.setKeyboardTracking(False)
        field.setAlignment(Qt.AlignmentFlag.AlignRight)
        field.valueChanged.connect(self._emit_placement)
        keep_wheel_for_scrolling(field)
        return field

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(2)
        fields = (
            (self.tr("Photo at column"), self.column),
            (self.tr("row"), self.row),
            (self.tr("scaled by"), self.scale),
        )
        for place, (text, field) in enumerate(fields):
            grid.addWidget(QLabel(text), 0, place)
            grid.addWidget(field, 1, place)
            grid.setColumnStretch(place, 1)
        buttons = QHBoxLayout()
        buttons.addWidget(self.by_mouse)
        buttons.addWidget(self.reset)
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(grid)
        layout.addLayout(buttons)

    def show_placement(self, placement: Placement, by_hand: bool) -> None:
        """Show the placement without emitting a signal."""
        self._placement = placement
        shown = ((self.column, placement.column), (self.row, placement.row))
        for field, value in (*shown, (self.scale, placement.scale)):
            with QSignalBlocker(field):
                field.setValue(value)
        self.reset.setEnabled(by_hand)

    def _emit_placement(self) -> None:
        # A field that was not edited keeps the digits that it does not show.
        shown, fields = self._placement, (self.column, self.row, self.scale)
        values = (shown.column, shown.row, shown.scale)
        new = [
            field.value() if abs(field.value() - value) > 10.0 ** -field.decimals() / 2 else value
            for field, value in zip(fields, values, strict=True)
        ]
        self.placed.emit(Placement(*new))
