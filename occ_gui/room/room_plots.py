"""Plots of a room: its plan, in which camera and aim are dragged, and the camera's picture."""

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSignalBlocker, Qt, Signal, SignalInstance
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.room.jobs import FloorMap, RoomPicture, RoomPlan
from occ_gui.scene.scene_store import Gestures
from occ_gui.widgets.building import fill
from occ_gui.widgets.colours import BAND, PHOTO, SIMULATION, pen_on, thin_pen
from occ_gui.widgets.plot import new_plot
from occ_model.arrays import FloatArray
from occ_model.errors import inflect
from occ_model.room.pose_fit import Located
from occ_model.room.room import Place

_DEVIATIONS = 2.0  # standard deviations at the edge of the error ellipse
_CIRCLE_ANGLES = np.linspace(0.0, 2.0 * math.pi, 49)  # radians

_VISIBLE_SIZE = 0.04  # fraction of the plan's width that an ellipse needs to be visible
_MARGIN = 0.8  # metres around the lamps

_DASHED = Qt.PenStyle.DashLine

_PADDING = 0.02  # fraction of the picture's height, so that the first row's number is not cut off

_HALF_NAME = 0.025  # half the height of a name, as a fraction of the picture's


class PlanPlot(QWidget):
    camera_moved = Signal(float, float, int)
    """The user drags the camera: x and y in metres, and the gesture."""

    aim_moved = Signal(float, float, int)  # the user drags the middle of what the camera sees

    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot("Plan of the room", "x (m)", "y (m)")
        self.plot.setAspectLocked(True)
        self.plot.setMouseEnabled(False, False)
        self.floor = pg.ScatterPlotItem(pen=None, symbol="s")
        self.plot.addItem(self.floor)
        self.lamps = self.plot.add_curve(thin_pen(SIMULATION))
        self.view = self.plot.add_curve(thin_pen(PHOTO, _DASHED))
        self.ellipse = self.plot.add_curve(thin_pen(BAND))
        self.names: list[pg.TextItem] = []
        self.cross = self.plot.plot([], [], pen=None, symbol="x", symbolBrush=BAND, symbolPen=BAND)
        self.aim = pg.TargetItem((0.0, 0.0), size=30, symbol="t1", pen=pg.mkPen(PHOTO, width=2))
        self.camera = pg.TargetItem((0.0, 0.0), size=14, symbol="o", pen=pg.mkPen(PHOTO, width=2))
        # If the camera looks straight up, the triangle surrounds the ring; both can be dragged.
        self.camera.setZValue(self.aim.zValue() + 1.0)
        self._report_drags(self.camera, self.camera_moved)
        self._report_drags(self.aim, self.aim_moved)
        self.plot.follow_palette(self._colour_items)
        fill(QVBoxLayout(self), self.plot, margins=0)

    def _report_drags(self, target: pg.TargetItem, moved: SignalInstance) -> None:
        self.plot.addItem(target)
        gestures = Gestures()

        def emit_position(item: pg.TargetItem) -> None:
            gesture = gestures.of_change(is_held=item.moving)
            moved.emit(float(item.pos().x()), float(item.pos().y()), gesture)

        target.sigPositionChanged.connect(emit_position)
        target.sigPositionChangeFinished.connect(gestures.end)

    def _colour_items(self, palette: QPalette) -> None:
        for name in self.names:
            name.setColor(palette.color(QPalette.ColorRole.Text))
        for target in (self.camera, self.aim):
            target.setPen(pen_on(palette, pg.mkPen(PHOTO, width=2)))

    def show_plan(self, plan: RoomPlan, place: Place, *, is_new: bool) -> None:
        """Show lamps and camera; fit the plan of another room to the pane."""
        loops = [np.vstack([outline, outline[:1]]) for outline in plan.outlines.values()]
        ends = np.cumsum([len(loop) for loop in loops]) - 1
        joined = np.vstack(loops)
        is_connected = np.ones(len(joined), dtype=np.int32)
        is_connected[ends] = 0
        self.lamps.setData(joined[:, 0], joined[:, 1], connect=is_connected)
        loop = np.vstack([plan.view, plan.view[:1]]) if len(plan.view) else plan.view
        self.view.setData(loop[:, 0], loop[:, 1])
        for target, position in ((self.camera, (place.x, place.y)), (self.aim, plan.aim)):
            with QSignalBlocker(target):
                target.setPos(QPointF(*position))
        if is_new:
            self._show_names(plan.outlines)
            low, high = joined.min(axis=0) - _MARGIN, joined.max(axis=0) + _MARGIN
            self.plot.setXRange(float(low[0]), float(high[0]), padding=0)
            self.plot.setYRange(float(low[1]), float(high[1]), padding=0)
        self.plot.setAccessibleDescription(
            f"{inflect(len(plan.outlines), 'lamp')}; "
            f"the camera is at x {place.x:.2f} m, y {place.y:.2f} m"
        )

    def _show_names(self, outlines: dict[str, FloatArray]) -> None:
        for name in self.names:
            self.plot.removeItem(name)
        self.names = []
        for text, outline in outlines.items():
            name = pg.TextItem(text, anchor=(0.5, 0.5))
            name.setPos(*outline.mean(axis=0).tolist())
            self.plot.addItem(name, ignoreBounds=True)
            self.names.append(name)
        self._colour_items(self.palette())

    def show_place(self, located: Located | None, true: Place) -> float:
        """Show a place with its error ellipse; return the factor by which its error is enlarged."""
        if located is None:
            self.ellipse.setData([], [])
            self.cross.setData([], [])
            return 1.0
        values, axes = np.linalg.eigh(located.covariance[:2, :2])
        lengths = _DEVIATIONS * np.sqrt(np.maximum(values, 0.0))
        width = float(np.ptp(self.plot.getViewBox().viewRange()[0]))
        needed = _VISIBLE_SIZE * width / max(float(lengths.max()), 1e-12)
        scale = 10.0 ** max(0, math.ceil(math.log10(max(needed, 1.0))))
        middle = np.array([true.x, true.y])
        offset = (np.array([located.place.x, located.place.y]) - middle) * scale
        circle = (
            np.stack([np.cos(_CIRCLE_ANGLES), np.sin(_CIRCLE_ANGLES)]) * lengths[:, None] * scale
        )
        x, y = (middle + offset)[:, None] + axes @ circle
        self.ellipse.setData(x, y)
        self.cross.setData([middle[0] + offset[0]], [middle[1] + offset[1]])
        return float(scale)

    def show_map(self, floor_map: FloorMap | None) -> None:
        if floor_map is None:
            self.floor.setData([], [])
            return
        brushes = {True: pg.mkBrush(SIMULATION), False: pg.mkBrush(BAND)}
        self.floor.setData(
            [
                {
                    "pos": floor_map.request.place(point.index),
                    "brush": brushes[bool(point.sure_places)],
                    "size": 9,
                }
                for point in floor_map.points
            ]
        )


class PicturePlot(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot("The camera's picture", "column", "row")
        self.plot.setAspectLocked(True)
        self.plot.invertY(True)
        self.plot.setMouseEnabled(False, False)
        self.image = pg.ImageItem(axisOrder="row-major")
        self.plot.addItem(self.image)
        self._overlays: list[pg.GraphicsObject] = []
        fill(QVBoxLayout(self), self.plot, margins=0)

    def show_room(self, picture: RoomPicture) -> None:
        rows, columns = picture.image.shape
        margin = _HALF_NAME * rows
        self.image.setImage(picture.reduced, levels=(0, 255))
        self.image.setRect(QRectF(-0.5, -0.5, columns, rows))
        self.plot.setXRange(0, columns, padding=0)
        self.plot.setYRange(0, rows, padding=_PADDING)
        for item in self._overlays:
            self.plot.removeItem(item)
        self._overlays = []
        for lamp in picture.reading.lamps if picture.reading else ():
            colour = SIMULATION if lamp.name else BAND
            loop = np.vstack([lamp.hull, lamp.hull[:1]])
            outline = pg.PlotCurveItem(loop[:, 0], loop[:, 1], pen=thin_pen(colour))
            name = pg.TextItem(lamp.name or "?", color="w", fill=colour, anchor=(0.5, 0.5))
            # The whole name stays visible, even for a lamp at the edge.
            middle = np.clip(lamp.hull.mean(axis=0), margin, (columns - margin, rows - margin))
            name.setPos(*middle.tolist())
            for item in (outline, name):
                self.plot.addItem(item, ignoreBounds=True)
                self._overlays.append(item)
