"""Play button: starts and stops the run of a slider."""

from PySide6.QtCore import Qt, Signal

from occ_gui.widgets.icon_button import IconButton

_ICON = 12


class PlayButton(IconButton):
    """Shows whether a slider runs; the right mouse button asks for a menu."""

    switched = Signal(str, bool)  # the parameter, and whether its slider is to run
    menu_asked = Signal(str)  # the parameter whose menu is to be opened

    def __init__(self, name: str, label: str) -> None:
        super().__init__("play", _ICON)
        self._name = name
        self.setCheckable(True)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setAccessibleName(f"Play: {label}")
        self.setToolTip(
            "Run the slider from end to end and back.\n"
            "The right mouse button offers speed, loop and a film of it."
        )
        self.clicked.connect(self._switch)
        self.customContextMenuRequested.connect(self._ask)

    def show_playing(self, playing: bool) -> None:
        self.setChecked(playing)
        self.show_drawing("pause" if playing else "play")

    def _switch(self, on: bool) -> None:
        self.switched.emit(self._name, on)

    def _ask(self) -> None:
        self.menu_asked.emit(self._name)
