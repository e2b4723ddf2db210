"""Transport: buttons that play a film and step through it, and where it stands."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.icon_button import IconButton

_ICON = 16


class TransportButton(IconButton):
    def __init__(self, drawing: str, name: str, meaning: str) -> None:
        super().__init__(drawing, _ICON)
        self.rename(drawing, name, meaning)

    def rename(self, drawing: str, name: str, meaning: str) -> None:
        self.show_drawing(drawing)
        self.setAccessibleName(name)
        self.setToolTip(meaning)


class Transport(QWidget):
    """Play, step back, step on, and the frame and time that are shown."""

    play_asked = Signal()  # the user starts or stops the film
    step_asked = Signal(int)  # how many frames the user goes on; back where it is below zero

    def __init__(self) -> None:
        super().__init__()
        self.back = TransportButton("step-back", "Step back", "Show the frame before (Left).")
        self.play = TransportButton("play", "", "")
        self.on = TransportButton("step-on", "Step on", "Show the next frame (Right).")
        self.place = ElidedLabel()
        self.place.setAccessibleName("Frame and time shown")
        self.place.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(2)
        for button in (self.back, self.play, self.on):
            layout.addWidget(button)
        layout.addSpacing(6)
        layout.addWidget(self.place, 1)
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
        """Show which frame is seen, of how many, and its time in seconds."""
        if time is None:
            self.place.set_full_text("")
            return
        of_all = f" of {count}" if count else ""
        self.place.set_full_text(f"frame {index + 1}{of_all}, {time:.4f} s")

    def set_usable(self, usable: bool) -> None:
        """Let the buttons be pressed while there is a film of several frames."""
        for button in (self.back, self.play, self.on):
            button.setEnabled(usable)
