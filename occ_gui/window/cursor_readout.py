"""Cursor readout: column, row and grey level at the mouse, as a text for the status line."""

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF, Signal

from occ_gui.picture.picture_pane import PicturePane
from occ_gui.profile.profile_view import ProfileView


class _Follower(QObject):
    """Emits a text for each position of the mouse in a view, an empty one when it leaves."""

    changed = Signal(str)

    def __init__(self, view: pg.GraphicsView) -> None:
        super().__init__(view)
        view.scene().sigMouseMoved.connect(self._move)
        view.viewport().installEventFilter(self)

    def _move(self, point: QPointF) -> None:
        self.changed.emit(self.text_at(point))

    def text_at(self, point: QPointF) -> str:
        """Return the text for a point of the graphics scene."""
        raise NotImplementedError

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Leave:
            self.changed.emit("")
        return False


class _PictureFollower(_Follower):
    def __init__(self, title: str, pane: PicturePane) -> None:
        super().__init__(pane.graphics)
        self._title, self._pane = title, pane

    def text_at(self, point: QPointF) -> str:
        place = self._pane.box.mapSceneToView(point)
        column, row = round(place.x()), round(place.y())
        level = self._pane.level_at(column, row)
        if level is None:
            return ""
        return self.tr("{picture}: column {column}, row {row}, level {level}").format(
            picture=self._title, column=column, row=row, level=level
        )


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
        return self.tr("Profile: column {column}, level {level:.1f}").format(
            column=column, level=level
        )


class CursorReadout(QObject):
    """Reports position and grey level under the mouse.

    Parameters
    ----------
    profile
        The pane of the column profile.
    pictures
        The panes of pictures, by their titles.
    """

    moved = Signal(str)
    """Position and grey level as a text; empty outside of the panes."""

    def __init__(self, profile: ProfileView, pictures: dict[str, PicturePane]) -> None:
        super().__init__(profile)
        followers = [_PictureFollower(title, pane) for title, pane in pictures.items()]
        for follower in (_ProfileFollower(profile), *followers):
            follower.changed.connect(self.moved)
