"""Bars of the film: a bar to open and read films, and a bar to play and step through one."""

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QMenu, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.video.camera import AXES, CameraDevice
from occ_gui.widgets.building import check_box, fill, name_widget, push_button
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.icons import IconButton
from occ_gui.widgets.keyed_combo_box import KeyedComboBox
from occ_gui.widgets.plain_text import in_menu

_ICON = 16


class FilmBar(QWidget):
    open_asked = Signal()

    close_asked = Signal()  # the user closes the film, or stops the camera
    cameras_asked = Signal()  # the user wants to see which cameras there are

    camera_chosen = Signal(object)

    read_asked = Signal()  # the user begins to read the film, or stops it

    def __init__(self) -> None:
        super().__init__()
        tip = "Choose a film of a rolling-shutter camera."
        self.open = push_button("Open fil&m…", tip, self.open_asked)
        self.camera = push_button("Camera", "Read live from a camera of this computer.")
        self.cameras = QMenu(self.camera)
        self.camera.setMenu(self.cameras)
        self.cameras.aboutToShow.connect(self.cameras_asked)
        self.close_film = push_button("Close", do=self.close_asked)
        self.axis = KeyedComboBox(
            "What the shutter scans",
            "Whether the shutter scans the picture line by line or column by column.\n"
            "For a film, this is found from its first frames; change it if it is wrong.",
            dict(zip(AXES, ("line by line", "column by column"), strict=True)),
            is_fixed=True,
        )
        self.lock = check_box("Hold exposure", "Keep the camera's exposure as it is now.")
        self.read = push_button("", do=self.read_asked)
        self.title = name_widget(ElidedLabel(), "Film")
        self.title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        left = (self.open, self.camera, self.axis, self.lock, self.close_film)
        buttons = fill(QHBoxLayout(), *left, None, self.read, margins=0)
        fill(QVBoxLayout(self), buttons, self.title, margins=0, spacing=4)
        self.show_film("", is_film=False, is_live=False)
        self.show_reading(False)

    def show_film(self, title: str, *, is_film: bool, is_live: bool) -> None:
        """Show what is open: a film, a camera, or else the simulated film."""
        self.title.set_full_text(title)
        self.close_film.setVisible(is_film or is_live)
        self.close_film.setText("Stop camera" if is_live else "Close")
        self.close_film.setToolTip(
            "Release the camera; the last picture stays."
            if is_live
            else "Close the film, and show the simulated one."
        )
        self.axis.setVisible(is_film or is_live)
        self.lock.setVisible(is_live)
        self.read.setVisible(not is_live)

    def show_reading(self, reading: bool, done: bool = False) -> None:
        self.read.setText("Stop reading" if reading else "Read again" if done else "Read the film")
        self.read.setToolTip(
            "Stop; what has been read so far stays."
            if reading
            else "Find the packets in all frames, and measure the camera's clock."
        )

    def list_cameras(self, devices: Sequence[CameraDevice] | None) -> None:
        self.cameras.clear()
        for device in devices or ():
            action = self.cameras.addAction(in_menu(device.name))
            action.triggered.connect(lambda _=False, device=device: self.camera_chosen.emit(device))
        if not devices:
            words = "No camera was found" if devices is not None else "Looking…"
            self.cameras.addAction(words).setEnabled(False)


class TransportButton(IconButton):
    def __init__(self, drawing: str, name: str, meaning: str) -> None:
        super().__init__(drawing, _ICON)
        self.rename(drawing, name, meaning)

    def rename(self, drawing: str, name: str, meaning: str) -> None:
        self.show_drawing(drawing)
        self.setAccessibleName(name)
        self.setToolTip(meaning)


class Transport(QWidget):
    """Buttons to play and step, and the number and time of the frame that is shown."""

    play_asked = Signal()  # the user starts or stops the film
    step_asked = Signal(int)  # the number of frames that the user steps forward; negative for back

    def __init__(self) -> None:
        super().__init__()
        self.back = TransportButton("step-back", "Step back", "Show the frame before (Left).")
        self.play = TransportButton("play", "", "")
        self.on = TransportButton("step-on", "Step on", "Show the next frame (Right).")
        self.place = name_widget(ElidedLabel(), "Frame and time shown")
        self.place.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        parts = (self.back, self.play, self.on, 6, (self.place, 1))
        fill(QHBoxLayout(self), *parts, margins=0, spacing=2)
        self.back.clicked.connect(lambda: self.step_asked.emit(-1))
        self.on.clicked.connect(lambda: self.step_asked.emit(1))
        self.play.clicked.connect(self.play_asked)
        self.show_playing(False)

    def show_playing(self, playing: bool) -> None:
        if playing:
            self.play.rename("pause", "Pause", "Stop at this frame (Space).")
        else:
            self.play.rename("play", "Play", "Play the film at its own speed (Space).")

    def show_place(self, index: int, count: int | None, time: float | None) -> None:
        """Show the index of the frame, the number of frames, and the time in seconds."""
        if time is None:
            self.place.set_full_text("")
            return
        of_all = f" of {count}" if count else ""
        self.place.set_full_text(f"frame {index + 1}{of_all}, {time:.4f} s")

    def set_usable(self, usable: bool) -> None:
        for button in (self.back, self.play, self.on):
            button.setEnabled(usable)
