"""View of the bars: how deep they are, the map of the least depth, and the shutter speeds."""

from PySide6.QtCore import QEvent, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QBoxLayout,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from occ_gui.bands.bands_plots import DepthPlot, RiskPlot
from occ_gui.bands.jobs import SceneBars
from occ_gui.bands.lamp_question import LampBars
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import embolden, fill, make_read_only, paragraph
from occ_gui.widgets.outdated_mark import OutdatedMark
from occ_model.results.bands import SpeedDepth, depth_text, format_depth
from occ_model.scene.light_words import describe_light
from occ_model.scene.units import SECOND

_DIGITS = 4

_PADDING = 6  # pixels above and below the text of a row, together

_LEAST_HEIGHT = 260

_USUAL_SHUTTER_TIME = 1 / 60  # shutter time in seconds that the table shows in its middle at first


class BandsView(QWidget):
    exposure_chosen = Signal(float)  # the exposure time that the user chooses, in seconds

    def __init__(self) -> None:
        super().__init__()
        self.lamp, self.scene_answer = LampBars(), Answer()
        self.map = DepthPlot()
        self.map.chosen.connect(self.exposure_chosen)
        self._make_table()
        self.table.setMinimumHeight(_LEAST_HEIGHT)
        self.map.setMinimumHeight(_LEAST_HEIGHT)
        self.risk = RiskPlot()
        self.risk.setMinimumHeight(_LEAST_HEIGHT)
        right_column = fill(QVBoxLayout(), (self.table, 3), (self.risk, 2))
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._row.addWidget(self.map, 3)
        self._row.addLayout(right_column, 2)
        self.scene_title = embolden(paragraph())
        fill(
            QVBoxLayout(self), embolden(QLabel("My lamp makes bars")), self.lamp,
            self.scene_title, self.scene_answer, (self._row, 1), margins=8,
        )  # fmt: skip
        self.outdated = OutdatedMark(self)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Place map and table one below the other where they are too narrow side by side."""
        super().resizeEvent(event)
        is_narrow = self.width() < self.table.minimumWidth() + _LEAST_HEIGHT
        direction = QBoxLayout.Direction
        self._row.setDirection(direction.TopToBottom if is_narrow else direction.LeftToRight)

    def _make_table(self) -> None:
        self.table = make_read_only(
            QTableWidget(0, 4),
            "Depth of the bars at usual shutter speeds",
            "Many cameras expose for the nearest power of two, not the nominal time: 1/64 s for "
            "1/60 s. "
            "A double click, or Enter, sets a speed; ISO speed and aperture follow.",
        )
        self.table.setHorizontalHeaderLabels(["Shutter", "nominal", "actual (2ⁿ)", "Bars"])
        self.table.verticalHeader().setDefaultSectionSize(self.fontMetrics().height() + _PADDING)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setResizeContentsPrecision(-1)  # considers all rows, not only those in view
        header.setSectionResizeMode(header.count() - 1, QHeaderView.ResizeMode.Stretch)
        self.table.itemActivated.connect(self._choose_speed)
        self._speeds: tuple[SpeedDepth, ...] = ()

    def _choose_speed(self, item: QTableWidgetItem) -> None:
        self.exposure_chosen.emit(self._speeds[item.row()].nominal)

    def show_failure(self, sentence: str) -> None:
        self.scene_answer.show_answer(sentence)

    def show_bands(self, bars: SceneBars) -> None:
        self.scene_title.setText(f"The scene: {describe_light(bars.scene.transmitter)}")
        self.scene_answer.show_answer(self._write_headline(bars), self._write_sentences(bars))
        self.map.show_depths(bars)
        self.risk.show_flicker(bars)
        is_first = not self._speeds
        self._speeds = bars.advice.speeds
        self.table.setRowCount(len(self._speeds))
        for row, speed in enumerate(self._speeds):
            cells = (
                speed.name, format_depth(speed.at_nominal), format_depth(speed.at_real),
                *_judge_speed(speed),
            )  # fmt: skip
            *texts, meaning = cells
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                item.setToolTip(meaning)
                self.table.setItem(row, column, item)
        self._fit_table()
        if is_first:  # once the table has its height
            QTimer.singleShot(0, self.table, self._show_usual_speed)

    def _show_usual_speed(self) -> None:
        usual = [speed.nominal <= _USUAL_SHUTTER_TIME for speed in self._speeds].index(True)
        middle = QAbstractItemView.ScrollHint.PositionAtCenter
        self.table.scrollTo(self.table.model().index(usual, 0), middle)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "table"):
            QTimer.singleShot(0, self, self._fit_table)  # once the table has the font, too

    def _fit_table(self) -> None:
        header, bar = self.table.horizontalHeader(), self.table.verticalScrollBar()
        columns = sum(
            max(header.sectionSizeHint(column), self.table.sizeHintForColumn(column))
            for column in range(header.count())
        )
        self.table.setMinimumWidth(columns + bar.sizeHint().width() + 2 * self.table.frameWidth())

    def _write_headline(self, bars: SceneBars) -> str:
        depth = bars.depth.peak_to_peak
        exposure = SECOND.format(bars.scene.camera.exposure_time, _DIGITS)
        if depth < bars.advice.limit:
            return f"No bars at {exposure}: {format_depth(depth)}"
        headline = f"Bars of {depth_text(depth)} at {exposure}"
        hidden = bars.depth.hidden
        return f"{headline}, not visible: {hidden}" if hidden else headline

    def _write_sentences(self, bars: SceneBars) -> list[str]:
        depth, advice = bars.depth, bars.advice
        lines = [
            f"RMS {format_depth(depth.rms)}; in the picture's columns "
            f"{format_depth(depth.columns.peak_to_peak)}, in pixel values "
            f"{format_depth(depth.pixel.peak_to_peak)} peak to peak. {depth.sentence}",
            advice.sentence,
        ]
        if advice.all_exposures:
            limit = f"{100.0 * advice.limit:.3g} %"
            lines[-1] += (
                f" No exposure of {SECOND.format(advice.all_exposures, 3)} or more shows {limit}."
            )
        if bars.scene.transmitter.edge_time:
            lines.append("The map assumes sharp edges; the LED's own edges make weaker bars.")
        return [*lines, " ".join(bars.eye.sentences)]


def _judge_speed(speed: SpeedDepth) -> tuple[str, str]:
    if speed.is_free:
        return "none", f"{speed.name} shows no bars."
    if not speed.is_doubtful:
        return "yes", f"{speed.name} shows bars."
    duration = "the nominal time" if speed.at_nominal < speed.at_real else "a power of two"
    return "depends", f"{speed.name} shows no bars if the camera exposes for {duration}."
