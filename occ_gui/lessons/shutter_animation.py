"""Slow animation of a rolling shutter, which exposes one column after the other."""

from PySide6.QtCore import QRectF, QSize, Qt, QTimer
from PySide6.QtGui import (
    QColor,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
    QShowEvent,
)
from PySide6.QtWidgets import QWidget

from occ_gui.widgets.colours import mix_colours
from occ_gui.widgets.guarded_paint import guarded
from occ_model.results.teaching import RollingShutter

_LOOP_MS = 9000
_FRAME_MS = 33
_END_PART = 0.12  # fraction of a loop during which the finished picture stays

_LIT, _DARK = QColor("#f2c14e"), QColor("#3c4048")
_LAMP_HEIGHT, _STRIPE_HEIGHT, _GAP = 18, 26, 6
_PAUSE_KEYS = (Qt.Key.Key_Space, Qt.Key.Key_Return)


class ShutterAnimation(QWidget):
    """The LED over time at the top, a bar for each column's exposure, and the stripes below.

    Time runs to the right. A click or the space bar pauses and resumes it.
    """

    def __init__(self) -> None:
        super().__init__()
        self._shutter: RollingShutter | None = None
        self.moment = 0.0  # fraction of the animation that has passed, from 0 to 1
        self._is_paused = False
        self._timer = QTimer(self)
        self._timer.setInterval(_FRAME_MS)
        self._timer.timeout.connect(self._advance)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Animation of a rolling shutter")
        self.setAccessibleDescription(
            "Each column gathers light a little later than the column before it."
        )
        self.setToolTip("Click, or press the space bar, to pause and to resume.")

    @property
    def is_playing(self) -> bool:
        return self._timer.isActive()

    def show_shutter(self, shutter: RollingShutter) -> None:
        self._shutter = shutter
        self.update()

    def toggle(self) -> None:
        self._is_paused = not self._is_paused
        self._run_timer()

    def _run_timer(self) -> None:
        if self.isVisible() and not self._is_paused:
            self._timer.start()
        else:
            self._timer.stop()

    def _advance(self) -> None:
        self.moment = (self.moment + _FRAME_MS / _LOOP_MS) % 1.0
        self.update()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        self._run_timer()

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 - Qt's name
        super().hideEvent(event)
        self._timer.stop()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        self.toggle()
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        if event.key() in _PAUSE_KEYS:
            self.toggle()
        else:
            super().keyPressEvent(event)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(280, 200)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(160, 140)

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        if self._shutter is None:
            return
        ShutterDrawing(
            QPainter(self), self, self._shutter, min(self.moment / (1.0 - _END_PART), 1.0)
        ).draw()


class ShutterDrawing:
    def __init__(
        self, painter: QPainter, widget: QWidget, shutter: RollingShutter, moment: float
    ) -> None:
        self.painter, self._shutter = painter, shutter
        self._now = moment * shutter.duration
        self._width, self._height = widget.width(), widget.height()
        self._ink = widget.palette().color(QPalette.ColorRole.WindowText)
        self._accent = widget.palette().color(QPalette.ColorRole.Highlight)
        # In a part of each cycle, a mains lamp is brighter than its mean, which is 1.
        self._brightest = max(1.0, float(shutter.levels.max()))

    def draw(self) -> None:
        self._draw_lamp()
        self.draw_bars()
        self.draw_stripes()
        x = self._x(self._now)
        self.painter.setPen(QPen(self._accent, 2))
        self.painter.drawLine(int(x), 0, int(x), self._height - _STRIPE_HEIGHT - _GAP)

    def _x(self, time: float) -> float:
        return self._width * time / self._shutter.duration

    def _draw_lamp(self) -> None:
        edges, levels = self._shutter.edges, self._shutter.levels / self._brightest
        for begin, end, level in zip(edges[:-1], edges[1:], levels, strict=True):
            left, right = self._x(max(begin, 0.0)), self._x(min(end, self._shutter.duration))
            if right > left:
                rect = QRectF(left, 0, right - left, _LAMP_HEIGHT)
                self.painter.fillRect(rect, mix_colours(_LIT, _DARK, level))

    def draw_bars(self) -> None:
        shutter = self._shutter
        top = _LAMP_HEIGHT + _GAP
        height = self._height - _STRIPE_HEIGHT - _GAP - top
        step = height / len(shutter.columns)
        outline = QColor(self._ink)
        outline.setAlpha(90)
        for index, (start, fraction) in enumerate(
            zip(shutter.starts, shutter.lit_fraction, strict=True)
        ):
            x, y = self._x(start), top + index * step
            width = max(self._x(shutter.exposure_time), 2.0)
            elapsed = min(max(self._now - start, 0.0), shutter.exposure_time)
            bar = QRectF(x, y, width, max(step - 1.0, 1.0))
            filled_part = QRectF(x, y, width * elapsed / shutter.exposure_time, bar.height())
            self.painter.fillRect(filled_part, mix_colours(_LIT, _DARK, fraction / self._brightest))
            self.painter.setPen(QPen(outline, 1))
            self.painter.drawRect(bar)

    def draw_stripes(self) -> None:
        shutter = self._shutter
        top = self._height - _STRIPE_HEIGHT
        width = self._width / len(shutter.columns)
        for index, (start, fraction) in enumerate(
            zip(shutter.starts, shutter.lit_fraction, strict=True)
        ):
            if self._now >= start + shutter.exposure_time * (1.0 - 1e-9):
                self.painter.fillRect(
                    QRectF(index * width, top, width + 1.0, _STRIPE_HEIGHT),
                    _grey(fraction / self._brightest),
                )
        self.painter.setPen(QPen(self._ink, 1))
        self.painter.drawRect(QRectF(0.5, top + 0.5, self._width - 1.0, _STRIPE_HEIGHT - 1.0))


def _grey(fraction: float) -> QColor:
    level = round(40 + 215 * min(max(fraction, 0.0), 1.0))
    return QColor(level, level, level)
