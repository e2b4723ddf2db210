"""Status messages: which event ends the display of each message in the status line."""

from PySide6.QtCore import QObject

from occ_gui.app.wording import with_labels
from occ_gui.window.main_window import MainWindow

_CHANGE, _PICTURE, _PHOTO, _MATCH = "a change of the scene", "a picture", "a photo", "a match"


class StatusMessages(QObject):
    """Shows messages in the status line of a window until the event that makes them obsolete.

    Parameters
    ----------
    window
        The window.
    """

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window

    def show_refusal(self, sentence: str) -> None:
        """Show why an input is not valid, until the next change of scene or settings."""
        self._window.say(with_labels(sentence), until=_CHANGE)

    def show_failure(self, sentence: str) -> None:
        """Show why a scene has no picture, until the next picture."""
        self._window.say(sentence, until=_PICTURE)

    def show_photo_failure(self, sentence: str) -> None:
        """Show why a photo cannot be read, until the next photo."""
        self._window.say(sentence, until=_PHOTO)

    def show_match_failure(self, sentence: str) -> None:
        """Show why a photo cannot be matched, until the next match or photo."""
        self._window.say(sentence, until=_MATCH)

    def end_refusal(self) -> None:
        """Remove a refusal: scene or settings change."""
        self._window.happened(_CHANGE)

    def end_failure(self) -> None:
        """Remove the failure of a simulation: there is a new picture."""
        self._window.happened(_PICTURE)

    def end_photo_failure(self) -> None:
        """Remove the failure of a photo or its match: there is another photo, or none."""
        self._window.happened(_PHOTO)
        self._window.happened(_MATCH)

    def end_match_failure(self) -> None:
        """Remove the failure of a match: there is a new one."""
        self._window.happened(_MATCH)
