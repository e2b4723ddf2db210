"""Player: runs a slider from end to end and back, while the picture follows."""

from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from occ_gui.scene.parameter_rows import QuantityRow
from occ_gui.widgets.icons import IconButton
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

_FRAME_MS = 40

_ICON = 12  # pixels of a side

SPEEDS = {"slow": 20.0, "normal": 10.0, "fast": 5.0}  # seconds from one end to the other

_RELATIVE_TOLERANCE = 1e-9


class PlayButton(IconButton):
    """Button that runs a slider or stops it; the right mouse button opens a menu."""

    switched = Signal(str, bool)  # the parameter, and whether its slider is to run
    menu_asked = Signal(str)  # the parameter whose menu is to be opened

    def __init__(self, name: str, label: str) -> None:
        super().__init__("play", _ICON)
        self.setCheckable(True)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setAccessibleName(f"Play: {label}")
        self.setToolTip(
            "Run the slider from end to end and back.\n"
            "The right mouse button opens a menu: speed, loop, animation."
        )
        self.clicked.connect(lambda on: self.switched.emit(name, on))
        self.customContextMenuRequested.connect(lambda: self.menu_asked.emit(name))

    def show_playing(self, playing: bool) -> None:
        self.setChecked(playing)
        self.show_drawing("pause" if playing else "play")


class Player(QObject):
    """Runs one slider at a time, until anything else changes its value."""

    animation_asked = Signal(str)  # the parameter whose run is to be written as an animation
    run_changed = Signal(str)  # the parameter whose slider runs from now on; empty for none

    def __init__(
        self,
        rows: dict[str, QuantityRow],
        buttons: dict[str, PlayButton],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._rows, self._buttons = rows, buttons
        self.parameter = ""  # the parameter that runs; empty for none
        self.speed, self.is_looping = "normal", True
        self._direction = 1.0
        self._fraction = 0.0
        self._last_value: float | None = None
        self._clock = QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.setInterval(_FRAME_MS)
        self._timer.timeout.connect(self._advance)
        for button in buttons.values():
            button.switched.connect(self._switch)
            button.menu_asked.connect(self._open_menu)

    def play(self, name: str) -> None:
        """Run a slider from its position, and stop any other."""
        self.stop()
        row = self._rows[name]
        self.parameter, self._fraction, self._direction = name, row.fraction, 1.0
        self._last_value = None
        row.begin_run()
        self._buttons[name].show_playing(True)
        self.run_changed.emit(name)
        self._clock.start()
        self._timer.start()

    def stop(self) -> None:
        self._timer.stop()
        if self.parameter:
            self._rows[self.parameter].end_run()
            self._buttons[self.parameter].show_playing(False)
            self.parameter = ""
            self.run_changed.emit("")

    def follow_scene(self, scene: Scene) -> None:
        if not self.parameter or self._last_value is None:
            return
        if not PARAMETERS[self.parameter].is_of(scene.transmitter.light):
            self.stop()
            return
        value = float(scene.value(self.parameter))
        if abs(value - self._last_value) > _RELATIVE_TOLERANCE * abs(self._last_value):
            self.stop()

    def _advance(self) -> None:
        self._fraction += self._direction * 1e-3 * self._clock.restart() / SPEEDS[self.speed]
        is_over = self._fraction < 0.0 and not self.is_looping
        if not 0.0 <= self._fraction <= 1.0:
            self._fraction = min(max(self._fraction, 0.0), 1.0)
            self._direction = -self._direction
        row = self._rows[self.parameter]
        self._last_value = row.value_at(self._fraction)  # before the scene changes
        row.run_to(self._fraction)
        if is_over:
            self.stop()

    def _switch(self, name: str, on: bool) -> None:
        if on:
            self.play(name)
        else:
            self.stop()

    def _open_menu(self, name: str) -> None:
        button = self._buttons[name]
        menu = self.menu_of(name)
        menu.popup(button.mapToGlobal(button.rect().bottomLeft()))

    def menu_of(self, name: str) -> QMenu:
        menu = QMenu(self._buttons[name])
        speeds = QActionGroup(menu)
        for speed in SPEEDS:
            action = menu.addAction(f"&{speed.capitalize()}")
            action.setCheckable(True)
            action.setChecked(speed == self.speed)
            action.setData(speed)
            speeds.addAction(action)
        speeds.triggered.connect(self._choose_speed)
        menu.addSeparator()
        loop = menu.addAction("&Loop")
        loop.setCheckable(True)
        loop.setChecked(self.is_looping)
        loop.toggled.connect(self._set_loop)
        animation = menu.addAction("Save as &animation…")
        animation.triggered.connect(lambda: self.animation_asked.emit(name))
        menu.aboutToHide.connect(menu.deleteLater)
        return menu

    def _choose_speed(self, action: QAction) -> None:
        self.speed = str(action.data())

    def _set_loop(self, on: bool) -> None:
        self.is_looping = on
