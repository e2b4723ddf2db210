"""Welcome page: four ways to begin, shown at the first start and from the menu."""

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.shell.feature import Service
from occ_gui.shell.shell import Shell
from occ_gui.widgets.building import embolden, fill, paragraph
from occ_gui.widgets.icons import pixmap
from occ_gui.window.main_window import MainWindow

_PICTURE = 96
_BUTTON_TITLE_SCALE = 1.2
_LEAST_SIDE = 208


class StartButton(QPushButton):
    def __init__(self, picture: str, title: str, sentence: str) -> None:
        super().__init__()
        self._name = picture
        self._picture, self._sentence = QLabel(), QLabel(sentence)
        self._title = embolden(QLabel(title), _BUTTON_TITLE_SCALE)
        self.setAccessibleName(title)
        self.setAccessibleDescription(sentence)
        labels = (self._picture, self._title, self._sentence)
        for label in labels:
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            label.setAlignment(Qt.AlignmentFlag.AlignHCenter)
            label.setWordWrap(label is not self._picture)
        self._layout = fill(QVBoxLayout(self), *labels, None, margins=16, spacing=8)
        self._draw_picture()

    def size_for(self, width: int = _LEAST_SIDE) -> QSize:
        """Return the size at which all texts are visible, with at least this width."""
        width = max(width, self._layout.minimumSize().width())
        return QSize(width, max(_LEAST_SIDE, self._layout.heightForWidth(width)))

    def _draw_picture(self) -> None:
        colour = self.palette().color(QPalette.ColorRole.ButtonText)
        self._picture.setPixmap(pixmap(self._name, colour, _PICTURE, self.devicePixelRatioF()))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.DevicePixelRatioChange):
            self._draw_picture()


_TITLE_SCALE = 1.5


class WelcomeDialog(QDialog):
    """Asks what the user wants to do first; closing it leads to free exploration."""

    chosen = Signal(str)  # the task that the user wants: a key of ``buttons``

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Welcome")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        title = embolden(QLabel("Light that carries bits"), _TITLE_SCALE)
        about = paragraph(
            "An LED panel blinks a code, a phone's camera photographs it as stripes, and the "
            "code is read back from them. See how this works, and where its limits are."
        )
        self.buttons = {
            "learn": StartButton(
                "door-learn",
                "Learn in five minutes",
                "See how a rolling shutter turns a blinking lamp into stripes.",
            ),
            "photo": StartButton(
                "door-photo",
                "Match my photo",
                "Open a photo of a blinking LED, and measure the camera with it.",
            ),
            "bars": StartButton(
                "door-bars",
                "My lamp makes bars",
                "Find the shutter speeds that show none in your pictures and films.",
            ),
            "explore": StartButton(
                "door-explore",
                "Free exploration",
                "Move the sliders, and watch picture, profile and code follow.",
            ),
        }
        width = max(button.size_for().width() for button in self.buttons.values())
        height = max(button.size_for(width).height() for button in self.buttons.values())
        row = fill(QHBoxLayout(), *self.buttons.values(), spacing=16)
        for name, button in self.buttons.items():
            button.setFixedSize(width, height)
            button.setProperty("task", name)
            button.clicked.connect(self._choose_task)
        fill(QVBoxLayout(self), title, about, row, margins=24, spacing=16)

    def _choose_task(self) -> None:
        name = self.sender().property("task")
        self.accept()
        self.chosen.emit(name)


_SHOWN_KEY = "welcome/seen"
_MODES = {"learn": "lessons", "photo": "photo", "bars": "limits", "explore": "explore"}


class Welcome(Service):
    def __init__(
        self, window: MainWindow, shell: Shell, preferences: Preferences, files: FileController
    ) -> None:
        super().__init__()
        self._window, self._shell = window, shell
        self._preferences, self._files = preferences, files
        self.dialog: WelcomeDialog | None = None  # the page, while it is shown

    def show_once(self) -> None:
        """Show the page if it has never been shown to this user."""
        if self._preferences.recall(_SHOWN_KEY) == "":
            self._preferences.keep(_SHOWN_KEY, "yes")
            self.show()

    def show(self) -> None:
        if self.dialog is None:
            self.dialog = WelcomeDialog(self._window)
            self.dialog.chosen.connect(self.enter)
            self.dialog.finished.connect(self._forget_dialog)
        self.dialog.show()
        self.dialog.activateWindow()

    def enter(self, task: str) -> None:
        """Arrange the window for what the user has chosen, and begin it."""
        self._window.modes.switch(_MODES[task])
        if task == "learn":
            self._window.bring_to_front("lessons")
            self._shell.pane("lessons").controller.begin_first()
        elif task == "photo":
            self._files.ask_for_photo()
        elif task == "bars":
            self._window.bring_to_front("bands")
            self._shell.pane("bands").view.lamp.form.lamp.setFocus()

    def _forget_dialog(self) -> None:
        self.dialog = None
