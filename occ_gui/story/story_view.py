"""Pane of the story: the verdict, and below it the four rows or the whole picture."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QStackedWidget, QVBoxLayout, QWidget

from occ_gui.simulation.snapshot import Picture, Reading
from occ_gui.story.column_values import VALUE_SEPARATOR
from occ_gui.story.story_rows import StoryRows
from occ_gui.story.verdict_bar import VerdictBar
from occ_gui.widgets.building import ElidedLabel, KeyedComboBox, fill, name_widget, push_button
from occ_model.scene.light_words import has_chips

_LEAST_VALUES = "column 9999  ·  99999.9 µs  ·  light off  ·"

_WHOLE, _WHOLE_TIP = "Whole picture", "Show the whole picture in place of the four rows."


class _LayoutBarrier(QWidget):
    """Holds a widget without passing on its size requests, which would lay the window out anew."""

    def __init__(self, content: QWidget) -> None:
        super().__init__()
        self._content = content
        content.setParent(self)
        self.setSizePolicy(content.sizePolicy())

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return self._content.sizeHint()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return self._content.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._content.setGeometry(self.rect())


class StoryView(QWidget):
    """The verdict on the code, above the story in four rows, or the whole picture instead."""

    def __init__(self, picture: QWidget, decoders: Sequence[str] = ()) -> None:
        super().__init__()
        self._picture = picture
        self.verdict, self.rows = VerdictBar(), StoryRows()
        self._photo_verdict: QWidget | None = None
        self._is_about_photo = False
        self.rows.stripes.thumbnail.clicked.connect(lambda: self.show_whole_picture(True))
        values = ElidedLabel(separator=VALUE_SEPARATOR)
        self.readout = name_widget(values, "Values at the crosshair")
        self.readout.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.rows.values_changed.connect(self.readout.set_full_text)
        self.measured = name_widget(
            ElidedLabel(separator=VALUE_SEPARATOR), "Measured between the cursors"
        )
        self.measured.setContentsMargins(4, 0, 0, 0)
        self.measured.hide()
        self.rows.measured_changed.connect(self._show_measured)
        self._make_controls(decoders)
        self._pages = QStackedWidget()
        for page in (self.rows, picture):
            self._pages.addWidget(page)
        self._size_by_page()
        self._readout_place = _LayoutBarrier(self.readout)
        self._row = fill(
            QHBoxLayout(), 4, (self._readout_place, 1), (None, 0), self.decoder,
            (self.whole_picture, 0, Qt.AlignmentFlag.AlignRight), margins=0,
        )  # fmt: skip
        for control in (self.picture_kind, *self.rows.ranges.values()):
            self.rows.controls.addWidget(control)
        self._layout = fill(
            QVBoxLayout(self), self.verdict, self._row, self.measured, (self._pages, 1),
            margins=4, spacing=4,
        )  # fmt: skip

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Give the values a line of their own where they have no room beside the controls."""
        super().resizeEvent(event)
        controls = self.decoder.sizeHint().width() + self.whole_picture.sizeHint().width()
        least = self.readout.fontMetrics().horizontalAdvance(_LEAST_VALUES)
        has_room = self.width() - controls >= least
        if has_room and self._row.indexOf(self._readout_place) < 0:
            self._row.insertWidget(1, self._readout_place, 1)
        elif not has_room and self._row.indexOf(self._readout_place) >= 0:
            self._layout.insertWidget(self._layout.indexOf(self.measured), self._readout_place)

    def offer_decoders(self, decoders: Sequence[str]) -> None:
        for name in decoders:
            if self.decoder.findData(name) < 0:
                self.decoder.addItem(f"Decoder: {name}", name)

    def _make_controls(self, decoders: Sequence[str]) -> None:
        self.decoder = KeyedComboBox(
            "Decoder", "Whose verdict, threshold, chips and bits are shown.", {}, is_fixed=True
        )
        self.offer_decoders(decoders)
        self.picture_kind = KeyedComboBox(
            "Whose picture and profile are shown",
            "Camera: picture and profile as the camera gives them.\n"
            "Receiver: with the contrast enhanced, as a receiver reads them.",
            {"camera": "Camera", "receiver": "Receiver"},
            is_fixed=True,
        )
        self.whole_picture = push_button(_WHOLE, _WHOLE_TIP, self.show_whole_picture)
        self.whole_picture.setCheckable(True)
        # A style without a pressed look, because the text shows the state.
        self.whole_picture.setObjectName("way")
        self.whole_picture.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    def _size_by_page(self) -> None:
        """Let only the visible page determine the size."""
        policies = QSizePolicy.Policy
        for page in (self.rows, self._picture):
            policy = policies.Expanding if page is self._pages.currentWidget() else policies.Ignored
            page.setSizePolicy(policy, policy)
        # At once, or the pane beside it would be laid out with the old page's width.
        self._pages.updateGeometry()
        self.updateGeometry()

    @property
    def shows_whole_picture(self) -> bool:
        return self._pages.currentWidget() is self._picture

    def show_whole_picture(self, is_whole: bool) -> None:
        self.whole_picture.setChecked(is_whole)
        self._pages.setCurrentWidget(self._picture if is_whole else self.rows)
        self._size_by_page()
        self.whole_picture.setText("Four rows" if is_whole else _WHOLE)
        self.whole_picture.setToolTip("Show the four rows again." if is_whole else _WHOLE_TIP)
        self._readout_place.setVisible(not is_whole)
        self._show_verdicts()

    def add_photo_verdict(self, bar: QWidget) -> None:
        self._photo_verdict = bar
        self._layout.insertWidget(0, bar)
        self._show_verdicts()

    def show_photo_verdict(self, is_about_photo: bool) -> None:
        self._is_about_photo = is_about_photo
        self._show_verdicts()

    def _show_verdicts(self) -> None:
        if self._photo_verdict is not None:
            is_visible = self._is_about_photo and self.shows_whole_picture
            self._photo_verdict.setVisible(is_visible)
            self.verdict.setHidden(is_visible)

    def show_picture(self, picture: Picture) -> None:
        self.rows.show_picture(picture)

    def show_reading(self, reading: Reading) -> None:
        self.decoder.setVisible(has_chips(reading.scene.transmitter))
        self.verdict.show_reading(reading)
        self.rows.show_reading(reading)

    def choose_decoder(self, name: str) -> None:
        self.decoder.show_key(name)
        self.verdict.choose_decoder(name)
        self.rows.choose_decoder(name)

    def choose_picture(self, picture_kind: str) -> None:
        self.picture_kind.show_key(picture_kind)
        self.rows.choose_picture(picture_kind)

    def switch_measuring(self, on: bool) -> None:
        if on:
            self.show_whole_picture(False)
        self.rows.switch_measuring(on)

    def _show_measured(self, text: str) -> None:
        self.measured.set_full_text(text)
        self.measured.setVisible(bool(text))
