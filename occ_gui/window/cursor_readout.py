"""Cursor readout: column, row and grey level at the mouse, for the status line."""

from collections.abc import Callable

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF, Signal
from PySide6.QtGui import QMouseEvent

from occ_gui.picture.image_view import ImageView
from occ_gui.picture.picture_pane import PicturePane
from occ_gui.profile.profile_view import ProfileView


class _MouseFollower(QObject):
    """Shows a text for each position of the mouse in a view, and none when the mouse leaves it.

    The signal of pyqtgraph's scene skips positions in quick succession, even the last one.
    """

    # A signal, because the label that shows the text may be deleted before the view.
    moved = Signal(str)

    def __init__(
        self, view: pg.GraphicsView, text_at: Callable[[QPointF], str], show: Callable[[str], None]
    ) -> None:
        super().__init__(view)
        self._view, self._text_at = view, text_at
        self.moved.connect(show)
        view.viewport().installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Leave:
            self.moved.emit("")
        elif event.type() == QEvent.Type.MouseMove and isinstance(event, QMouseEvent):
            point = self._view.mapToScene(event.position().toPoint())
            self.moved.emit(self._text_at(QPointF(point)))
        return False


def follow_profile(profile: ProfileView, show: Callable[[str], None]) -> None:
    """Show column and level under the mouse in the profile; an empty text outside."""

    def text_at(point: QPointF) -> str:
        box = profile.plot.getViewBox()
        if not box.sceneBoundingRect().contains(point):
            return ""
        column = round(box.mapSceneToView(point).x())
        level = profile.level_at(column)
        return "" if level is None else f"Profile: column {column}, level {level:.1f}"

    _MouseFollower(profile.plot, text_at, show)


def follow_pictures(image: ImageView, show: Callable[[str], None]) -> None:
    """Show column, row and level under the mouse in picture and photo; empty outside."""

    def pixel_at(pane: PicturePane, point: QPointF) -> tuple[int, int]:
        position = pane.box.mapSceneToView(point)
        return round(position.x()), round(position.y())

    def describe_simulation(point: QPointF) -> str:
        column, row = pixel_at(image.simulation, point)
        levels = image.levels_at(column, row)
        if levels is None:
            return ""
        text = ", ".join(f"{kind} level {level}" for kind, level in levels.items())
        return f"Simulation: column {column}, row {row}, {text}"

    def describe_photo(point: QPointF) -> str:
        column, row = pixel_at(image.photo, point)
        level = image.photo.level_at(column, row)
        return "" if level is None else f"Photo: column {column}, row {row}, level {level}"

    _MouseFollower(image.simulation.graphics, describe_simulation, show)
    _MouseFollower(image.photo.graphics, describe_photo, show)
