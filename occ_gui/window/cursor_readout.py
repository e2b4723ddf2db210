"""Cursor readout: column, row and grey level at the mouse, as a text for the status line."""

from collections.abc import Callable

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF, Signal
from PySide6.QtGui import QMouseEvent

from occ_gui.picture.image_view import ImageView
from occ_gui.picture.picture_pane import PicturePane
from occ_gui.profile.profile_view import ProfileView


class _Follower(QObject):
    """Emits a text for each position of the mouse in a view, an empty one when it leaves.

    The scene's own signal leaves out positions that follow fast, also that where the mouse stops.
    """

    changed = Signal(str)

    def __init__(self, view: pg.GraphicsView) -> None:
        super().__init__(view)
        self._view = view
        view.viewport().installEventFilter(self)

    def text_at(self, point: QPointF) -> str:
        raise NotImplementedError

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Leave:
            self.changed.emit("")
        elif event.type() == QEvent.Type.MouseMove and isinstance(event, QMouseEvent):
            point = self._view.mapToScene(event.position().toPoint())
            self.changed.emit(self.text_at(QPointF(point)))
        return False


class _PictureFollower(_Follower):
    def __init__(self, image: ImageView) -> None:
        super().__init__(image.simulation.graphics)
        self._image = image

    def text_at(self, point: QPointF) -> str:
        place = self._image.simulation.box.mapSceneToView(point)
        column, row = round(place.x()), round(place.y())
        levels = self._image.levels_at(column, row)
        if levels is None:
            return ""
        of_both = ", ".join(f"{whose} level {level}" for whose, level in levels.items())
        return f"Simulation: column {column}, row {row}, {of_both}"


class _PhotoFollower(_Follower):
    def __init__(self, pane: PicturePane) -> None:
        super().__init__(pane.graphics)
        self._pane = pane

    def text_at(self, point: QPointF) -> str:
        place = self._pane.box.mapSceneToView(point)
        column, row = round(place.x()), round(place.y())
        level = self._pane.level_at(column, row)
        if level is None:
            return ""
        return f"Photo: column {column}, row {row}, level {level}"


class _ProfileFollower(_Follower):
    def __init__(self, pane: ProfileView) -> None:
        super().__init__(pane.plot)
        self._pane = pane

    def text_at(self, point: QPointF) -> str:
        box = self._pane.plot.getViewBox()
        if not box.sceneBoundingRect().contains(point):
            return ""
        column = round(box.mapSceneToView(point).x())
        level = self._pane.level_at(column)
        if level is None:
            return ""
        return f"Profile: column {column}, level {level:.1f}"


def follow_profile(profile: ProfileView, show: Callable[[str], None]) -> None:
    """Show column and level under the mouse in the profile; an empty text outside of it."""
    _ProfileFollower(profile).changed.connect(show)


def follow_pictures(image: ImageView, show: Callable[[str], None]) -> None:
    """Show column, row and level under the mouse in picture and photo, as above."""
    for follower in (_PictureFollower(image), _PhotoFollower(image.photo)):
        follower.changed.connect(show)
