"""The steps from a photo to a scene that explains it, and the verdict on the match so far."""

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QWidget

from occ_gui.photo.match_figures import condition_of
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.widgets.building import fill, push_button
from occ_gui.widgets.state_bar import StateBar
from occ_gui.widgets.state_look import Badge, State
from occ_model.errors import inflect, one_line
from occ_model.results.match import PLAIN_STRIPES
from occ_model.results.match_sentence import describe_match, state_verdict
from occ_model.results.photo_table import SURE
from occ_model.scene.scene import Scene

STEPS = {
    "open": ("Open", "Open a photo of a rolling-shutter camera."),
    "sent": ("Sent?", "Say what the LED sent, as far as it is known."),
    "match": ("Match", "Find the settings that explain the photo's stripes."),
    "apply": ("Apply", "Apply the settings that were found to the scene."),
}
"""The steps in their order, each with its word and its meaning."""

EARLIER = "earlier"  # stands for a match of another part than the one chosen now


class PhotoSteps(QWidget):
    """A button for each step, which shows whether the step is done, next, or to come."""

    chosen = Signal(str)  # the step that the user goes to, one of STEPS

    def __init__(self) -> None:
        super().__init__()
        self.buttons: dict[str, QPushButton] = {}
        self._state: tuple[bool, str, bool] | None = None
        for name, (_, meaning) in STEPS.items():
            go = lambda _=False, name=name: self.chosen.emit(name)  # noqa: E731
            button = self.buttons[name] = push_button("", meaning, go)
            button.setObjectName("step")
            button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        fill(QHBoxLayout(self), *self.buttons.values(), margins=(0, 4, 0, 4), spacing=4)
        self.show_state(has_photo=False, match="", is_applied=False)

    def show_state(self, *, has_photo: bool, match: str, is_applied: bool) -> None:
        """Show which steps are done.

        ``match``: the verdict ``"sure"`` or ``"doubtful"``, EARLIER, or empty without a match.
        """
        new_state = (has_photo, match, is_applied)
        if new_state == self._state:  # called at each change of the scene, and styling is slow
            return
        self._state = new_state
        signs_of_match = {"": "", EARLIER: "", "sure": "✓", "doubtful": "?"}
        is_present = match not in {"", EARLIER}
        signs_of_steps = {
            "open": "✓" if has_photo else "",
            "sent": "✓" if match else "",
            "match": signs_of_match[match],
            "apply": "✓" if is_present and is_applied else "",
        }
        is_enabled = {"open": True, "sent": has_photo, "match": has_photo, "apply": is_present}
        current = next((name for name in STEPS if not signs_of_steps[name]), "")
        for place, (name, button) in enumerate(self.buttons.items(), 1):
            word, sign = STEPS[name][0], signs_of_steps[name]
            state = "next step" if name == current else {"✓": "done", "?": "doubtful"}.get(sign)
            button.setText(f"{sign or place} {word}")
            button.setEnabled(is_enabled[name])
            button.setAccessibleName(f"{word}: {state}" if state else word)
            button.setProperty("current", name == current)
            button.style().unpolish(button)
            button.style().polish(button)


_LAMP_TIP = (
    "Match the photo as one of a lamp, lit once in each period; its frequency is assumed until "
    "you enter it."
)


class PhotoVerdictBar(StateBar):
    """Whether the open photo is matched, how sure the match is, and its estimates.

    The verdict on the simulated picture, which may differ, is a badge beside it.
    """

    USUAL_LINES = MOST_LINES = 3
    """Enough for the first reason of a refusal, which says what to do about it."""

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName("Verdict on the photo")
        self._simulation: tuple[Badge, ...] = ()
        self.show_photo(ShownPhoto(Scene()))

    def show_simulation(self, state: State, verdict: str) -> None:
        meaning = "What was read from the simulated picture."
        self._simulation = (Badge("simulation", verdict, meaning, state),)
        self.show_photo(self._shown)

    def show_photo(self, shown: ShownPhoto) -> None:
        self._shown = shown
        state, (title, *sentences) = judge_photo(shown)
        badges = self._simulation
        if shown.present_match is not None and not shown.is_applied:
            meaning = "The simulation is of another scene. Apply the match to simulate its scene."
            badges = (Badge("applied", "not applied", meaning, State.DOUBTFUL), *badges)
        self.show_state(state, title, *sentences, badges=badges)
        is_plain = PLAIN_STRIPES in shown.refusal and not shown.is_matching
        self.offer_step("It is a &lamp" if is_plain else "", _LAMP_TIP)


def judge_photo(shown: ShownPhoto) -> tuple[State, tuple[str, ...]]:
    """Return the state of a photo's match, its title, and sentences from the longest on."""
    if shown.is_matching:
        return State.WAITING, ("Photo: matching…",)
    if shown.photo is None:
        sentence = "Open one, say what was sent if you know it, and match it."
        return State.NEUTRAL, ("No photo is open", sentence)
    if shown.refusal:
        reasons = (" ".join(shown.refusal), _shorten_reasons(shown.refusal))
        return State.BAD, ("Photo: not matched", *reasons)
    match = shown.match
    if match is None and shown.row is not None:
        return State.BAD, (f"Photo: {shown.row.verdict} in the table", shown.row.note)
    if match is None:
        sentence = "Say what was sent if you know it, and match it."
        return State.NEUTRAL, ("Photo: no match yet", sentence)
    reason, _ = shown.validity
    if reason:
        return State.WAITING, ("Photo: an earlier match is shown", f"It is {reason}.")
    condition = condition_of(match, shown.choice.certain)
    title = f"Photo: {state_verdict(match, condition)}"
    if match.verdict == SURE:  # the title has the condition
        return State.GOOD, (title, describe_match(match))
    reason = _shorten_reasons(match.reasons)
    return State.DOUBTFUL, (title, f"{describe_match(match, condition)} {reason}", reason)


def _shorten_reasons(reasons: Sequence[str]) -> str:
    more = len(reasons) - 1
    return reasons[0] + (f" And {inflect(more, 'more reason')}." if more else "")


def photo_caption(shown: ShownPhoto) -> str:
    """Return a figure's caption: the photo's name, its verdict and the estimates."""
    if shown.photo is None:
        return ""
    name = f"photo {one_line(shown.photo.path.name)}"
    match = shown.present_match
    if match is None:
        return f"{name}, not matched"
    whose = "" if shown.is_applied else ", whose match is not this scene's"
    return f"{name}{whose}. {describe_match(match, condition_of(match, shown.choice.certain))}"
