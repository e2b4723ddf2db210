"""What lies under the mouse, in words for the status line."""

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF, Signal

from occ_gui.picture.picture_pane import PicturePane
from occ_gui.profile.profile_view import ProfileView


class _Follower(QObject):
    """Tells what lies under the mouse in one view, and of nothing once the mouse has left it."""

    told = Signal(str)

    def __init__(self, view: pg.GraphicsView) -> None:
        super().__init__(view)
        view.scene().sigMouseMoved.connect(self._move)
        view.viewport().installEventFilter(self)

    def _move(self, point: QPointF) -> None:
        self.told.emit(self.words(point))

    def words(self, point: QPointF) -> str:
        """Say what lies at a point of the scene."""
        raise NotImplementedError

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Leave:
            self.told.emit("")
        return False


class _OverPicture(_Follower):
    def __init__(self, word: str, pane: PicturePane) -> None:
        super().__init__(pane.graphics)
        self._word, self._pane = word, pane

    def words(self, point: QPointF) -> str:
        place = self._pane.box.mapSceneToView(point)
        column, row = round(place.x()), round(place.y())
        level = self._pane.level_at(column, row)
        if level is None:
            return ""
        return self.tr("{picture}: column {column}, row {row}, level {level}").format(
            picture=self._word, column=column, row=row, level=level
        )


class _OverProfile(_Follower):
    def __init__(self, pane: ProfileView) -> None:
        super().__init__(pane.plot)
        self._pane = pane

    def words(self, point: QPointF) -> str:
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


class Pointer(QObject):
    """Tells the position and the grey level under the mouse.

    Parameters
    ----------
    profile
        The pane of the column profile.
    pictures
        The panes of pictures, by what they show.
    """

    moved = Signal(str)
    """Where the mouse is and what is there; empty where there is nothing to tell."""

    def __init__(self, profile: ProfileView, pictures: dict[str, PicturePane]) -> None:
        super().__init__(profile)
        over = [_OverPicture(word, pane) for word, pane in pictures.items()]
        for follower in (_OverProfile(profile), *over):
            follower.told.connect(self.moved)
