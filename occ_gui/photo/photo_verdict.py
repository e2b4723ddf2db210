"""The steps from a photo to a scene that explains it, and the verdict on the match so far."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QWidget

from occ_gui.photo.match_figures import condition_of
from occ_gui.photo.match_result import STATES
from occ_gui.widgets.building import fill, push_button
from occ_gui.widgets.state_bar import StateBar
from occ_gui.widgets.state_look import Badge, State
from occ_model.errors import inflect, one_line
from occ_model.photo.reading.load import Photo
from occ_model.results.match import PLAIN_STRIPES, Match
from occ_model.results.match_sentence import describe_match, state_verdict
from occ_model.results.photo_table import SURE, PhotoRow

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


class PhotoVerdictBar(StateBar):
    """Whether the open photo is matched, how sure the match is, and its estimates.

    The verdict on the simulated picture, which may differ, is a badge beside it.
    """

    USUAL_LINES = MOST_LINES = 3
    """Enough for the first reason of a refusal, which says what to do about it."""

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName("Verdict on the photo")
        self.step.setToolTip(
            "Match the photo as one of a lamp, lit once in each period; its frequency is assumed "
            "until you enter it."
        )
        self._photo: Photo | None = None
        self._match: Match | None = None
        self._row: PhotoRow | None = None
        self._is_running = False
        self._refusal: tuple[str, ...] = ()
        self._outdated_reason = ""
        self._is_applied = True
        self._certain: Mapping[str, float] = {}
        self._simulation: tuple[Badge, ...] = ()
        self._write()

    def show_photo(self, photo: Photo | None) -> None:
        self._photo, self._match = photo, None
        self._refusal, self._outdated_reason = (), ""
        self._write()

    def show_row(self, row: PhotoRow | None) -> None:
        """Show the table's result for this photo, which has not been matched on its own yet."""
        self._row = row
        self._write()

    def begin_match(self) -> None:
        self._is_running, self._refusal = True, ()
        self._write()

    def end_match(self, refusal: Sequence[str] = ()) -> None:
        """Show that no match is running, with the reasons why none was found."""
        self._is_running, self._refusal = False, tuple(refusal)
        self._write()

    def show_match(self, match: Match | None) -> None:
        self._match, self._outdated_reason = match, ""
        self.end_match()

    def show_outdated(self, why: str) -> None:
        """Show why the match is outdated, empty if it is not."""
        self._outdated_reason = why
        self._write()

    def show_certain(self, certain: Mapping[str, float]) -> None:
        self._certain = certain
        self._write()

    def show_applied(self, applied: bool) -> None:
        if applied != self._is_applied:
            self._is_applied = applied
            self._write()

    def show_simulation(self, state: State, verdict: str) -> None:
        meaning = "What was read from the simulated picture."
        badges = (Badge("simulation", verdict, meaning, state),)
        if badges != self._simulation:
            self._simulation = badges
            self._write()

    def _write(self) -> None:
        state, (title, *sentences) = self._judge()
        badges = self._simulation
        is_present = self._match is not None and not self._outdated_reason and not self._refusal
        if is_present and not self._is_applied:
            meaning = "The simulation is of another scene. Apply the match to simulate its scene."
            badges = (Badge("applied", "not applied", meaning, State.DOUBTFUL), *badges)
        self.show_state(state, title, *sentences, badges=badges)
        is_plain = PLAIN_STRIPES in self._refusal
        self.offer_step("It is a &lamp" if is_plain else "")

    def _judge(self) -> tuple[State, tuple[str, ...]]:
        if self._is_running:
            return State.WAITING, ("Photo: matching…",)
        if self._photo is None:
            sentence = "Open one, say what was sent if you know it, and match it."
            return State.NEUTRAL, ("No photo is open", sentence)
        if self._refusal:
            reasons = (" ".join(self._refusal), _shorten_reasons(self._refusal))
            return State.BAD, ("Photo: not matched", *reasons)
        if self._match is None and self._row is not None:
            return self._judge_row(self._row)
        if self._match is None:
            sentence = "Say what was sent if you know it, and match it."
            return State.NEUTRAL, ("Photo: no match yet", sentence)
        if self._outdated_reason:
            sentence = f"It is {self._outdated_reason}."
            return State.WAITING, ("Photo: an earlier match is shown", sentence)
        return self._judge_match(self._match)

    def _judge_match(self, match: Match) -> tuple[State, tuple[str, ...]]:
        title = f"Photo: {state_verdict(match, condition_of(match, self._certain))}"
        if match.verdict == SURE:  # the title has the condition
            return State.GOOD, (title, describe_match(match))
        sentence = self._describe_match(match)
        reason = _shorten_reasons(match.reasons)
        return State.DOUBTFUL, (title, f"{sentence} {reason}", reason)

    def caption(self) -> str:
        """Return a figure's caption: the photo's name, its verdict and the estimates."""
        if self._photo is None:
            return ""
        name = f"photo {one_line(self._photo.path.name)}"
        if self._match is None or self._outdated_reason or self._refusal:
            return f"{name}, not matched"
        whose = "" if self._is_applied else ", whose match is not this scene's"
        return f"{name}{whose}. {self._describe_match(self._match)}"

    def _judge_row(self, row: PhotoRow) -> tuple[State, tuple[str, ...]]:
        """Return the state and the sentences for the table's result."""
        state = STATES.get(row.verdict, State.BAD)
        is_matched = state is not State.BAD
        advice = "Match it on its own to see its curves and to apply the match." * is_matched
        title = f"Photo: {row.verdict} in the table"
        return state, (title, f"{row.note} {advice}".strip(), row.note or advice)

    def _describe_match(self, match: Match) -> str:
        return describe_match(match, condition_of(match, self._certain))


def _shorten_reasons(reasons: Sequence[str]) -> str:
    more = len(reasons) - 1
    return reasons[0] + (f" And {inflect(more, 'more reason')}." if more else "")
