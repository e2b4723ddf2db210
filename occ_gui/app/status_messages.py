"""Status messages, and the event that ends each of them."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from occ_gui.scene.control_panel import ControlPanel
from occ_gui.window.main_window import MainWindow
from occ_model.scene.parameters import PARAMETERS

if TYPE_CHECKING:
    from occ_gui.accuracy.accuracy_view import AccuracyView
    from occ_gui.photo.photo_view import PhotoView

_CHANGE, _PICTURE, _PHOTO, _MATCH = "a change of the scene", "a picture", "a photo", "a match"


class StatusMessages(QObject):
    """Shows messages in the status line until an event ends them; refusals at fields, too."""

    def __init__(self, window: MainWindow, controls: ControlPanel) -> None:
        super().__init__(window)
        self._window, self._controls = window, controls
        self._failing: tuple[str, ...] = ()

    def follow(self, *forms: "AccuracyView | PhotoView") -> None:
        """Show refusals of these forms, each until a valid value is entered there."""
        for form in forms:
            form.refused.connect(self.show_note)
            form.accepted.connect(self.end_refusal)

    def show_note(self, sentence: str) -> None:
        """Show a remark on the present scene, until the next change of scene or settings."""
        self._window.say(sentence, until=_CHANGE)

    def show_failure(self, sentence: str, parameters: Sequence[str] = ()) -> None:
        """Show why a scene has no picture, also at the fields concerned, until the next picture."""
        self._window.say(sentence, until=_PICTURE)
        self._controls.end_refusals(self._failing)
        self._failing = tuple(parameters)
        self._controls.show_problem(sentence, parameters)

    def show_photo_failure(self, sentence: str) -> None:
        """Show why a photo cannot be read, until the next photo."""
        self._window.say(sentence, until=_PHOTO)

    def show_match_failure(self, sentence: str) -> None:
        """Show why a photo cannot be matched, until the next match or photo."""
        self._window.say(sentence, until=_MATCH)

    def end_refusal(self) -> None:
        self._window.happened(_CHANGE)
        self._controls.end_refusals(name for name in PARAMETERS if name not in self._failing)

    def end_failure(self) -> None:
        self._window.happened(_PICTURE)
        self._controls.end_refusals(self._failing)
        self._failing = ()

    def end_photo_failure(self) -> None:
        self._window.happened(_PHOTO)
        self._window.happened(_MATCH)

    def end_match_failure(self) -> None:
        self._window.happened(_MATCH)
