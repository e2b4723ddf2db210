"""Steps from a photo to a scene that explains it: open, what was sent, match, apply."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QWidget

STEPS = ("open", "sent", "match", "apply")
"""The steps, in their order."""

EARLIER = "earlier"
"""What a match is worth that was made of something else than what is to be matched now."""


class PhotoSteps(QWidget):
    """A button for each step, which says whether the step is done, is next, or must wait."""

    chosen = Signal(str)
    """The step that the user goes to, one of STEPS."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words = {
            "open": "Open",
            "sent": "Sent?",
            "match": "Match",
            "apply": "Apply",
        }
        meanings = {
            "open": "Open a photo of a rolling-shutter camera.",
            "sent": "Say what the LED sent, as far as it is known.",
            "match": "Find the settings that explain the photo's stripes.",
            "apply": "Take over the settings that were found.",
        }
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 4, 0, 4)
        row.setSpacing(4)
        self.buttons: dict[str, QPushButton] = {}
        self._shown: tuple[bool, str, bool] | None = None
        for name in STEPS:
            button = self.buttons[name] = QPushButton()
            button.setObjectName("step")
            button.setToolTip(meanings[name])
            button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
            button.clicked.connect(self._choose)
            row.addWidget(button)
        self.show_state(has_photo=False, match="", is_applied=False)

    def _choose(self) -> None:
        for name, button in self.buttons.items():
            if button is self.sender():
                self.chosen.emit(name)

    def show_state(self, *, has_photo: bool, match: str, is_applied: bool) -> None:
        """Show how far the photo is explained.

        Parameters
        ----------
        match
            What its match is worth, ``"sure"`` or ``"doubtful"``; EARLIER if it answers another
            question than the present one; empty if there is none.
        """
        shown = (has_photo, match, is_applied)
        if shown == self._shown:  # at each change of the scene, and styles are slow to apply
            return
        self._shown = shown
        signs = {"": "", EARLIER: "", "sure": "✓", "doubtful": "?"}  # of a match, as its verdict
        is_present = match not in {"", EARLIER}
        done = {
            "open": "✓" if has_photo else "",
            "sent": "✓" if match else "",
            "match": signs[match],
            "apply": "✓" if is_present and is_applied else "",
        }
        able = {"open": True, "sent": has_photo, "match": has_photo, "apply": is_present}
        current = next((name for name in STEPS if not done[name]), "")
        for place, name in enumerate(STEPS, 1):
            button = self.buttons[name]
            button.setText(f"{done[name] or place} {self._words[name]}")
            button.setEnabled(able[name])
            button.setAccessibleName(self._name(name, done[name], name == current))
            button.setProperty("current", name == current)
            button.style().unpolish(button)
            button.style().polish(button)

    def _name(self, name: str, done: str, is_current: bool) -> str:
        state = {"✓": "done", "?": "doubtful"}.get(done, "")
        if is_current:
            state = "next step"
        return f"{self._words[name]}: {state}" if state else self._words[name]
