"""Verdict bar: whether the code was read, in words, colour and shape, and what holds beside."""

from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.decoding.verdict import Verdict, result_of, verdict_on
from occ_gui.simulation.snapshot import Reading
from occ_gui.story.column_facts import chips_in_exposure
from occ_gui.story.state_chips import ChipRow, chips_of, computing
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.state_look import State, StateIcon, colours_of
from occ_model.scene.units import SECOND

_ICON = 32
_LARGER = 1.25
_RADIUS = 8
_PADDING, _MARGIN = 12, 5


class VerdictBar(QWidget):
    """The verdict on the code in large letters, why it is so below, and chips at the right."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._reading: Reading | None = None
        self._decoder = ""
        self._is_outdated = False
        self._failure = self._title = self._sentence = ""
        self.icon = StateIcon(_ICON)
        self.title = ElidedLabel("", Qt.TextElideMode.ElideRight)
        font = self.title.font()
        font.setBold(True)
        font.setPointSizeF(_LARGER * font.pointSizeF())
        self.title.setFont(font)
        self.sentence = ElidedLabel("", Qt.TextElideMode.ElideRight)
        self.chips = ChipRow()
        self.setAccessibleName(self.tr("Verdict on the code"))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        for part in (self.icon, self.title, self.sentence, self.chips):
            part.setParent(self)
        self._write()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the height of title and sentence."""
        return QSize(400, self.minimumSizeHint().height())

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the smallest size: the texts are shortened, the chips counted."""
        return QSize(_ICON + 4 * _PADDING, self._heights()[0] + self._heights()[1] + 2 * _MARGIN)

    def _heights(self) -> tuple[int, int]:
        title = max(self.title.fontMetrics().height(), self.chips.sizeHint().height()) + 2
        return title, self.sentence.fontMetrics().height() + 2

    def _place(self) -> None:
        """Give the title the width that it needs, and the chips what is left."""
        first, second = self._heights()
        left = 2 * _PADDING + _ICON
        room = max(0, self.width() - left - _PADDING)
        wanted = self.title.fontMetrics().horizontalAdvance(self._title) + 4
        chips = self.chips.minimumSizeHint().width() if self.chips.chips else 0
        title = max(0, min(wanted, room - _PADDING - chips))
        self.icon.move(_PADDING, (self.height() - _ICON) // 2)
        self.title.setGeometry(left, _MARGIN, title, first)
        beside = left + title + _PADDING
        height = self.chips.sizeHint().height()
        top = _MARGIN + (first - height) // 2
        self.chips.setGeometry(beside, top, max(0, left + room - beside), height)
        self.sentence.setGeometry(left, _MARGIN + first, room, second)
        # A widget that is not shown yet is not told of its size.
        self.title.set_full_text(self._title)
        self.sentence.set_full_text(self._sentence)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Place the parts anew."""
        super().resizeEvent(event)
        self._place()

    @property
    def state(self) -> State:
        """The state that colour and icon show."""
        return self.icon.state

    def show_reading(self, reading: Reading) -> None:
        """Show the verdict on this reading in place of the previous one."""
        self._reading, self._failure = reading, ""
        self._write()

    def choose_decoder(self, name: str) -> None:
        """Show the verdict on the result of this decoder; by default on the paper's."""
        self._decoder = name
        self._write()

    def show_outdated(self, outdated: bool) -> None:
        """Show whether the results are of an earlier scene; they are not the present verdict."""
        if outdated != self._is_outdated:
            self._is_outdated = outdated
            self._write()

    def show_failure(self, sentence: str) -> None:
        """Show that the present scene has no picture, and why; until the next results."""
        self._failure = sentence
        self._write()

    def end_failure(self) -> None:
        """Wait for the picture of another scene."""
        if self._failure:
            self._failure = ""
            self._write()

    def _write(self) -> None:
        reading = self._reading
        if self._failure:
            title = self.tr("No picture of this scene")
            self._show(State.BAD, title, self._failure)
            self.chips.show_chips(())
            return
        if reading is None:
            self._show(State.WAITING, self.tr("Computing the first picture…"), "")
            self.chips.show_chips(())
            return
        result = result_of(reading, self._decoder or reading.decoded.decoder)
        verdict = verdict_on(result, reading.sent)
        chips = chips_of(reading, result.decoder)
        if self._is_outdated:
            heading = self.tr("Earlier scene: {verdict}").format(verdict=verdict.heading)
            self._show(State.WAITING, heading, self._why(verdict, reading))
            chips = (computing(), *chips)
        else:
            self._show(verdict.state, verdict.heading, self._why(verdict, reading))
        self.chips.show_chips(chips)
        self._place()

    def _why(self, verdict: Verdict, reading: Reading) -> str:
        if verdict.explanation:
            return verdict.explanation
        scene = reading.scene
        fewest = chips_in_exposure(scene)
        text = self.tr(
            "A column gathers light for {exposure}, a chip lasts {period}: each column sees "
            "{fewest} or {most} chips"
        )
        if reading.band_undefined:
            text += self.tr("; the band model ends there, this simulation goes on")
        return text.format(
            exposure=SECOND.format(scene.camera.exposure_time, 4),
            period=SECOND.format(scene.transmitter.switching_period, 4),
            fewest=fewest,
            most=fewest + 1,
        ) + "."  # fmt: skip

    def _show(self, state: State, title: str, sentence: str) -> None:
        if state is not self.icon.state:
            self.icon.show_state(state)
            self._take_colours()
        self._title, self._sentence = title, sentence
        self._place()
        self.setAccessibleDescription(f"{title}. {sentence}".strip())

    def _take_colours(self) -> None:
        ink = colours_of(self.state, self.palette()).ink
        for label in (self.title, self.sentence):
            palette = QPalette()  # in which all other colours stay those of the theme
            palette.setColor(QPalette.ColorRole.WindowText, ink)
            label.setPalette(palette)
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "chips"):
            self._take_colours()

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the coloured area, with a line of the same ink at its left."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colours = colours_of(self.state, self.palette())
        painter.setPen(colours.ink)
        painter.setBrush(colours.paper)
        place = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(place, _RADIUS, _RADIUS)
        painter.end()
