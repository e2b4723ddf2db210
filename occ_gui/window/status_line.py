"""Status line: a message, the work in progress, the level under the mouse, and computing times."""

from PySide6.QtCore import QEvent, QObject, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QStatusBar

from occ_gui.widgets.building import ElidedLabel
from occ_gui.widgets.plain_text import LONGEST_TEXT
from occ_gui.widgets.state_look import Badge, BadgeLabel
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import one_line
from occ_model.scene.units import SECOND

_MESSAGE_FRACTION, _CURSOR_FRACTION, _TIMING_FRACTION = 0.3, 0.4, 0.3
"""Fractions of the width: least for the message, most for the readouts."""

_TEXT_EVENTS = (QEvent.Type.Show, QEvent.Type.Hide, QEvent.Type.Paint)
"""Events of a label after which it may show another text."""

_BULLET = "• "

_BADGES = ("photo", "accuracy")  # keys of the badges, which no other text replaces

_GAP = 8  # pixels to the left of a readout


class StatusLine(QStatusBar):
    """A status bar whose texts never overlap, because each has its own label, which elides it.

    Qt's own status bar would paint a message below the permanent texts. The whole text of each
    label is its tooltip.
    """

    def __init__(self) -> None:
        super().__init__()
        self._message = self._plan_change = self._times = ""
        self._shows_times = True
        self._other_labels: list[QLabel] = []
        self._sentence = ElidedLabel()
        self._sentence.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._sentence.setAccessibleName("Message")
        self.loading_bar = WorkBar("Progress of reading the photo")
        self.animation_bar = WorkBar("Progress of writing the animation")
        self.readout, self.timing = _Readout(), _Readout()
        self.photo, self.accuracy = (BadgeLabel(Badge(key, "", "")) for key in _BADGES)
        self.addWidget(self._sentence, 1)
        for widget in (self.loading_bar, self.animation_bar, self.readout, self.timing):
            self.addPermanentWidget(widget)
        for badge in (self.photo, self.accuracy):
            # Its size is fixed, so that other texts cannot reduce it.
            badge.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
            badge.hide()
            self.addPermanentWidget(badge)
        for readout in (self.readout, self.timing):
            readout.hide()

    def showMessage(self, message: str, timeout: int | None = 0) -> None:  # noqa: ARG002, N802 - Qt's name
        """Show a message in place of the previous one, until :meth:`clearMessage`."""
        self._message = one_line(message, LONGEST_TEXT)
        if self._message:
            self._plan_change = ""  # which is older than the message
        self._show_sentence()

    def clearMessage(self) -> None:  # noqa: N802 - Qt's name
        self.showMessage("")

    def currentMessage(self) -> str:  # noqa: N802 - Qt's name
        return self._message

    def leave_to(self, *labels: QLabel) -> None:
        """Suppress messages that one of these labels shows in full while it is visible."""
        for label in labels:
            self._other_labels.append(label)
            label.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if self._message and event.type() in _TEXT_EVENTS:
            self._show_sentence()
        return super().eventFilter(watched, event)

    @property
    def is_shown_elsewhere(self) -> bool:
        """Whether one of these labels shows the message."""
        texts = (label.text() for label in self._other_labels if label.isVisible())
        return bool(self._message) and any(self._message in _join_lines(text) for text in texts)

    def show_accuracy(self, badge: Badge | None) -> None:
        """Show the badge of the accuracy, which is never elided; None hides it."""
        _show(self.accuracy, badge)

    def show_photo(self, badge: Badge | None) -> None:
        """Show the badge of an open photo that is out of view; None hides it."""
        _show(self.photo, badge)

    def show_plan_change(self, sentence: str) -> None:
        """Show which effects the plan has switched, while there is no message; empty removes it."""
        self._plan_change = sentence
        self._show_sentence()

    def show_timing(self, simulation: float, reading: float | None) -> None:
        """Show the seconds of the last simulation, and of its decoding; None if none was needed."""
        self._times = f"simulated in {SECOND.format(simulation, 3)}"
        if reading is not None:
            self._times += f", read in {SECOND.format(reading, 3)}"
        self.show_times(self._shows_times)

    def show_times(self, on: bool) -> None:
        self._shows_times = on
        self.timing.set_full_text(self._times if on else "")

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._sentence.setMinimumWidth(round(_MESSAGE_FRACTION * self.width()))
        self.readout.setMaximumWidth(round(_CURSOR_FRACTION * self.width()))
        self.timing.setMaximumWidth(round(_TIMING_FRACTION * self.width()))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a width that does not depend on the texts, so that the window can be narrowed."""
        return QSize(self.loading_bar.minimumSizeHint().width(), super().minimumSizeHint().height())

    def _show_sentence(self) -> None:
        is_elsewhere = self.is_shown_elsewhere
        self._sentence.set_full_text("" if is_elsewhere else self._message or self._plan_change)


def _show(label: BadgeLabel, badge: Badge | None) -> None:
    label.setVisible(badge is not None)
    if badge is not None:
        label.show_badge(badge)
        label.updateGeometry()


def _join_lines(text: str) -> str:
    return " ".join(text.replace(_BULLET, " ").split())


class _Readout(ElidedLabel):
    """A label as wide as its whole text if there is space."""

    def __init__(self) -> None:
        super().__init__()
        self.setContentsMargins(_GAP, 0, 0, 0)

    def set_full_text(self, text: str) -> None:
        super().set_full_text(text)
        self.setVisible(bool(text))
        self.updateGeometry()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        width = self.fontMetrics().horizontalAdvance(self._full) + _GAP + 1
        return QSize(width if self._full else 0, super().sizeHint().height())
