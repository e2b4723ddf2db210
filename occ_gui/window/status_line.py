"""Status line: a message, the work in progress, the level under the mouse, and computing times."""

from PySide6.QtCore import QEvent, QObject, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QStatusBar

from occ_gui.widgets.badge_row import Badge, BadgeLabel
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.plain_text import LONGEST_TEXT
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import one_line
from occ_model.scene.units import SECOND

_MESSAGE_FRACTION, _POINTED_FRACTION, _TIMING_FRACTION = 0.3, 0.4, 0.3
"""Fractions of the width: least for the message, most for the readouts."""

_SEEN_ANEW = (QEvent.Type.Show, QEvent.Type.Hide, QEvent.Type.Paint)
"""Events of a label after which it may show another text."""

_BULLET = "• "

_GAP = 8  # pixels to the left of a readout


class StatusLine(QStatusBar):
    """A status bar whose texts never overlap: each has its own label, which shortens it by dots.

    Qt's own would paint a message below the permanent texts, and cut it off where they begin. The
    whole text of each label is its tooltip.
    """

    def __init__(self) -> None:
        super().__init__()
        self._message = self._plan_change = self._times = ""
        self._shows_times = True
        self._others: list[QLabel] = []
        self._sentence = ElidedLabel()
        self._sentence.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._sentence.setAccessibleName("Message")
        self.reading = WorkBar("How much of the photo has been read")
        self.filming = WorkBar("How much of the animation has been written")
        self.pointed, self.timing = _Readout(), _Readout()
        # Of a size that no other text takes from it.
        self.accuracy = BadgeLabel(Badge("accuracy", "", ""))
        self.accuracy.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.accuracy.hide()
        self.addWidget(self._sentence, 1)
        for widget in (self.reading, self.filming, self.pointed, self.timing, self.accuracy):
            self.addPermanentWidget(widget)
        for readout in (self.pointed, self.timing):
            readout.hide()

    def showMessage(self, message: str, timeout: int | None = 0) -> None:  # noqa: ARG002, N802 - Qt's name
        """Show a message in place of the previous one, until :meth:`clearMessage`."""
        self._message = one_line(message, LONGEST_TEXT)
        if self._message:
            self._plan_change = ""  # it is older news
        self._show_sentence()

    def clearMessage(self) -> None:  # noqa: N802 - Qt's name
        self.showMessage("")

    def currentMessage(self) -> str:  # noqa: N802 - Qt's name
        return self._message

    def leave_to(self, *labels: QLabel) -> None:
        """Suppress messages that one of these labels shows in full while it is visible."""
        for label in labels:
            self._others.append(label)
            label.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if self._message and event.type() in _SEEN_ANEW:
            self._show_sentence()
        return super().eventFilter(watched, event)

    def _is_shown_elsewhere(self) -> bool:
        texts = (each.text() for each in self._others if each.isVisible())
        return bool(self._message) and any(self._message in _in_one_line(text) for text in texts)

    def show_accuracy(self, badge: Badge | None) -> None:
        """Show what is left out by hand, always and whole; None for nothing."""
        self.accuracy.setVisible(badge is not None)
        if badge is not None:
            self.accuracy.show_badge(badge)
            self.accuracy.updateGeometry()

    def show_plan_change(self, sentence: str) -> None:
        """Show which effects the plan has switched, while there is no message; empty removes it."""
        self._plan_change = sentence
        self._show_sentence()

    def show_timing(self, simulation: float, reading: float) -> None:
        """Show the seconds of the last simulation and of its decoding."""
        simulated, read = (SECOND.format(seconds, 3) for seconds in (simulation, reading))
        self._times = f"simulated in {simulated}, read in {read}"
        self.show_times(self._shows_times)

    def show_times(self, shown: bool) -> None:
        self._shows_times = shown
        self.timing.set_full_text(self._times if shown else "")

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._sentence.setMinimumWidth(round(_MESSAGE_FRACTION * self.width()))
        self.pointed.setMaximumWidth(round(_POINTED_FRACTION * self.width()))
        self.timing.setMaximumWidth(round(_TIMING_FRACTION * self.width()))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a width that does not depend on the present one: the window can be narrowed."""
        return QSize(self.reading.minimumSizeHint().width(), super().minimumSizeHint().height())

    def _show_sentence(self) -> None:
        is_shown = self._is_shown_elsewhere()
        self._sentence.set_full_text("" if is_shown else self._message or self._plan_change)


def _in_one_line(text: str) -> str:
    return " ".join(text.replace(_BULLET, " ").split())


class _Readout(ElidedLabel):
    """A label as wide as its whole text, where there is space."""

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
