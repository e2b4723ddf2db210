"""Rows of the story: light, picture, profile and code over one axis of columns."""

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from occ_gui.simulation.band_drift import describe_drift, explain_comparison, explain_drift
from occ_gui.simulation.snapshot import ColumnView, Picture, PictureView
from occ_gui.simulation.verdict import result_of
from occ_gui.story.code_row import CodeRow
from occ_gui.story.column_axis import MARGIN, ColumnAxis, Crosshair, Scale, find_gutter_width
from occ_gui.story.column_values import (
    ColumnValues,
    describe_difference,
    describe_values,
    measure,
    read_values,
)
from occ_gui.story.curve_legend import CurveLegend, LegendLine
from occ_gui.story.light_row import LightRow
from occ_gui.story.profile_row import ProfileRow
from occ_gui.story.stripes_row import StripesRow
from occ_gui.values.photo_results import PhotoProfile
from occ_gui.widgets.building import fill, push_button
from occ_gui.widgets.colours import BAND, PHOTO, SIMULATION, THRESHOLD, thin_pen
from occ_gui.widgets.columns import PACKETS_IN_VIEW, first_periods
from occ_gui.widgets.event_filters import call_at
from occ_model.results.decoding import PAPER_DECODER, DecodeResult
from occ_model.results.frame import PICTURES
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import Transmitter

RANGES = ("packets", "panel")
"""What is in view until the user moves the columns: the first packets, or the whole panel."""

_MICRO = 1e6
_TIME = "time (µs)"
_MARGIN_FRACTION = 0.01  # space beside the range, as a fraction of it


class StoryRows(QWidget):
    """The four rows, the scales above and below them, and the values at the crosshair."""

    values_changed = Signal(str)  # the values of the column at the crosshair, in words

    measured_changed = Signal(str)
    """What is measured between the cursors, in words; empty for nothing."""

    def __init__(self) -> None:
        super().__init__()
        self.axis, self.crosshair = ColumnAxis(self), Crosshair(self)
        self._reading: ColumnView | None = None
        self._picture: Picture | PictureView | None = None
        self._decoder = PAPER_DECODER
        self._picture_kind = PICTURES[0]
        self.range = RANGES[0]
        self._span: float | None = None
        self.ranges: dict[str, QPushButton] = {}  # buttons that choose the range, of RANGES
        for name in RANGES:
            self.ranges[name] = button = push_button(
                "Panel",
                "Show all columns of the panel, and follow it.",
                lambda _=False, name=name: self.choose_range(name),
            )
            button.setParent(self)  # its owner until it is laid out
            button.setCheckable(True)
        self._mark_range()
        self._label_range(Transmitter())
        self.time = Scale(_TIME, self.axis, is_above=True)
        self.columns = Scale("column", self.axis, is_above=False, least_step=1.0)
        self.light = LightRow(self.axis, self.crosshair)
        self.stripes = StripesRow(self.axis, self.crosshair)
        self.profile = ProfileRow(self.axis, self.crosshair)
        self.code = CodeRow(self.axis, self.crosshair)
        layout = fill(QVBoxLayout(self), margins=0, spacing=2)
        for part, stretch in (
            (self.time, 0), (self.light, 3), (self.stripes, 4), (self._make_legend_line(), 0),
            (self.profile, 6), (self.code, 0), (self.columns, 0),
        ):  # fmt: skip
            layout.addWidget(part, stretch)
        for signal in (self.crosshair.pointed_at, self.crosshair.chosen):
            signal.connect(self._report_values)
        self.axis.changed.connect(self._mark_range)
        self.crosshair.cursors.changed.connect(self._measure)
        call_at(self, self._reserve_gutter, QEvent.Type.FontChange)

    def _make_legend_line(self) -> QWidget:
        line = Qt.PenStyle
        self.legend = CurveLegend(
            {
                "simulation": (thin_pen(SIMULATION), "simulation"),
                "band": (thin_pen(BAND, line.DashLine), "band model"),
                "photo": (thin_pen(PHOTO), "photo"),
                "fitted": (thin_pen(PHOTO), "photo, fitted levels"),
                "threshold": (thin_pen(THRESHOLD, line.DashDotLine), "threshold"),
            },
            usual=("simulation", "threshold", "band"),
        )
        part = LegendLine(self.legend)
        part.setContentsMargins(self.axis.gutter, 0, MARGIN, 0)
        self._legend_row = part
        self.controls = part.controls
        return part

    def _reserve_gutter(self) -> None:
        """Fit the gutter to the size of the text."""
        names = [row.name for row in (self.light, self.stripes, self.profile, self.code)]
        self.axis.set_gutter(find_gutter_width(self.font(), names))
        self._legend_row.setContentsMargins(self.axis.gutter, 0, MARGIN, 0)
        for part in (self.time, self.columns, self.code):
            part.updateGeometry()

    def _show_legend(self) -> None:
        profile = self.profile
        curves = {  # the band model last, because the remark is about it
            "simulation": profile.levels,
            "fitted" if profile.is_photo_fitted else "photo": profile.photo,
            "threshold": profile.threshold, "band": profile.band,
        }  # fmt: skip
        reading = self._reading
        undefined = "" if reading is None else reading.band_undefined
        drift = "" if reading is None else describe_drift(reading)
        note = "no band model here" if undefined else drift
        keys = tuple(key for key, curve in curves.items() if curve is not None)
        if undefined or profile.band is None:
            explanation = undefined
        else:
            explanation = explain_drift(reading) if reading and drift else explain_comparison()
        self.legend.show_lines(keys, note, explanation)

    def show_picture(self, picture: Picture | PictureView) -> None:
        self._picture = picture
        self.stripes.show_picture(picture.view_as(self._picture_kind))

    def show_reading(self, reading: ColumnView) -> None:
        was_visible = self._is_chosen_column_visible()
        self._reading = reading
        scene = reading.scene
        self._set_time_unit(reading)
        self.light.show_reading(reading)
        self._show_result()
        self._set_range()
        self._label_range(scene.transmitter)
        self.code.setVisible(has_chips(scene.transmitter))
        first = int(reading.panel_origin[0] + reading.period_columns / 2)
        self.crosshair.set_columns(len(reading.profile), first)
        if was_visible and not self._is_chosen_column_visible():
            # The panel has moved away from the chosen column.
            self.crosshair.choose(first)
        self._measure()
        self._report_values()

    def _set_time_unit(self, reading: ColumnView) -> None:
        """Show time in microseconds if chips are sent, otherwise in periods of the light."""
        unit, name = 1.0 / _MICRO, _TIME
        if not has_chips(reading.scene.transmitter):
            unit, name = reading.light_period, "time / period"
        scene = reading.scene
        self.time.count_from(scene.model.start_time / unit, scene.camera.readout_time / unit, name)

    def show_photo_profile(self, photo: PhotoProfile | None) -> None:
        self.profile.show_photo(photo)
        self._show_legend()

    def choose_decoder(self, name: str) -> None:
        self._decoder = name
        self._show_result()
        self._report_values()

    def choose_picture(self, picture_kind: str) -> None:
        self._picture_kind = picture_kind
        self.profile.choose_picture(picture_kind)
        if self._picture is not None:
            self.stripes.show_picture(self._picture.view_as(picture_kind))
        self._show_legend()
        self._report_values()

    def choose_range(self, name: str) -> None:
        """Show the first packets or the whole panel, one of RANGES, and follow it."""
        self.range = name
        self._set_range()
        self.fit()

    def fit(self) -> None:
        self.axis.fit()
        self._mark_range()

    def hold_columns(self, columns: float | None) -> None:
        """Show this many columns in place of the first packets; None: the packets again.

        A range that the user has moved to stays in view.
        """
        self._span = columns
        self._set_range()
        reading = self._reading
        self._label_range(Transmitter() if reading is None else reading.scene.transmitter)

    def _label_range(self, sent: Transmitter) -> None:
        text, tip = first_periods(sent)
        if self._span is not None:
            text = f"{self._span:.0f} columns"
            tip = "Show this many columns from the panel's first, whatever the light."
        self.ranges[RANGES[0]].setText(text)
        self.ranges[RANGES[0]].setToolTip(tip)

    @property
    def result(self) -> DecodeResult | None:
        if self._reading is None:
            return None
        if not has_chips(self._reading.scene.transmitter):
            return DecodeResult(self._decoder)  # nothing is read
        return result_of(self._reading, self._decoder)

    def values(self) -> ColumnValues | None:
        """Return the values at the crosshair, else at the chosen column."""
        column = self.crosshair.shown_column
        if self._reading is None or column is None:
            return None
        return read_values(column, self._reading.scene, self.light, self.profile, self.code)

    def _show_result(self) -> None:
        if self._reading is not None and self.result is not None:
            self.profile.show_reading(self._reading, self.result)
            self.code.show_reading(self._reading, self.result)
            self._show_legend()

    def _is_chosen_column_visible(self) -> bool:
        """Return whether the chosen column is in the followed range, else on the panel."""
        column, reading = self.crosshair.column, self._reading
        if column is None or reading is None:
            return False
        follows = self.axis.is_following
        first, last = (self.axis.first, self.axis.last) if follows else reading.panel_columns
        return first <= column <= last

    def _set_range(self) -> None:
        reading = self._reading
        if reading is None:
            return
        last_column = len(reading.profile) - 1
        first, last = reading.panel_columns
        if self.range == "packets":
            packets_end = min(last, first + PACKETS_IN_VIEW * reading.period_columns)
            last = packets_end if self._span is None else min(first + self._span, last_column)
        last = max(last, first + 4.0)
        margin = _MARGIN_FRACTION * (last - first)
        self.axis.set_home(first - margin, last + margin, last_column + 1)

    def _mark_range(self) -> None:
        """Mark the range that is followed; none after the user has moved the columns."""
        for name, button in self.ranges.items():
            button.setChecked(self.axis.is_following and name == self.range)

    def _report_values(self) -> None:
        values = self.values()
        if values is not None and self._reading is not None:
            self.values_changed.emit(describe_values(values, self._reading.scene))

    def switch_measuring(self, on: bool) -> None:
        self.crosshair.cursors.switch(on, self.axis.first, self.axis.last)

    def _measure(self) -> None:
        reading = self._reading
        if reading is not None:
            difference = measure(self.crosshair.cursors, reading, self.profile.levels)
            self.measured_changed.emit(
                "" if difference is None else describe_difference(difference)
            )
