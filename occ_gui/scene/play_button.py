"""Play button: starts and stops the run of a slider."""

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QPaintEvent
from PySide6.QtWidgets import QToolButton, QWidget

from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.icons import icon

_ICON = 12


class PlayButton(QToolButton):
    """Shows whether a slider runs; the right mouse button asks for a menu.

    Parameters
    ----------
    name, label
        The slider's parameter, and its label.
    parent
        The parent widget.
    """

    switched = Signal(str, bool)
    """The parameter, and whether its slider is to run."""

    menu_asked = Signal(str)
    """The parameter whose menu is to be opened."""

    def __init__(self, name: str, label: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = name
        self._is_drawn = False
        self.setAutoRaise(True)
        self.setCheckable(True)
        self.setIconSize(QSize(_ICON, _ICON))
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setAccessibleName(self.tr("Play: {label}").format(label=label))
        self.setToolTip(
            self.tr(
                "Run the slider from end to end and back.\n"
                "The right mouse button offers speed, loop and a film of it."
            )
        )
        self.clicked.connect(self._switch)
        self.customContextMenuRequested.connect(self._ask)

    def show_playing(self, playing: bool) -> None:
        """Show whether the slider runs."""
        self.setChecked(playing)
        self._draw()

    def _switch(self, on: bool) -> None:
        self.switched.emit(self._name, on)

    def _ask(self) -> None:
        self.menu_asked.emit(self._name)

    def _draw(self) -> None:
        name = "pause" if self.isChecked() else "play"
        self.setIcon(icon(name, self.palette(), _ICON, self.devicePixelRatioF()))
        self._is_drawn = True

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the icon when it is first seen, not with the program."""
        if not self._is_drawn:
            self._draw()
        super().paintEvent(event)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._is_drawn:
            self._draw()
