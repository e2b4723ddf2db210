"""Verdict bar: whether the code was read, in words, colour and shape, and what holds beside."""

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal

from occ_gui.simulation.snapshot import Reading
from occ_gui.simulation.verdict import Verdict, result_of, verdict_on
from occ_gui.story.column_facts import Step, cause_of, chips_in_exposure
from occ_gui.story.state_chips import behind_run, chips_of, computing, of_pictures
from occ_gui.widgets.state_bar import StateBar
from occ_gui.widgets.state_look import State
from occ_model.scene.units import SECOND

if TYPE_CHECKING:
    from occ_gui.detection_map.own_rate_controller import OwnRate

AVERAGES_LESSON = "2-past-the-shutter"
"""The lesson on codes that are read though no column sees one chip alone."""


class VerdictBar(StateBar):
    """The verdict on the code that is read from the simulated picture."""

    step_chosen = Signal(object)  # the user takes the step that helps, a :class:`Step`
    lesson_wanted = Signal(str)  # the user asks for the lesson on what is shown, by its name

    def __init__(self) -> None:
        super().__init__()
        self._step: Step | None = None
        self._lesson = ""
        self.step_taken.connect(self._take_step)
        self._reading: Reading | None = None
        self._decoder = self._run = self._pictured = ""
        self._is_outdated = self._is_named = False
        self._failure = ""
        self._rate: OwnRate | None = None
        self.setAccessibleName("Verdict on the code")
        self._write()

    def show_reading(self, reading: Reading) -> None:
        self._reading, self._failure = reading, ""
        self._write()

    def choose_decoder(self, name: str) -> None:
        """Show the verdict on the result of this decoder; by default on the paper's."""
        self._decoder = name
        self._write()

    def show_outdated(self, outdated: bool) -> None:
        if outdated != self._is_outdated:
            self._is_outdated = outdated
            self._write()

    def show_run(self, value: str, pictured: str) -> None:
        """Say of which value of a slider that runs the verdict is.

        ``value``: the value with its label; empty while no slider runs.
        """
        if (value, pictured) != (self._run, self._pictured):
            self._run, self._pictured = value, pictured
            self._write()

    def show_failure(self, sentence: str) -> None:
        """Show that the present scene has no picture, and why; until the next results."""
        self._failure = sentence
        self._write()

    def end_failure(self) -> None:
        if self._failure:
            self._failure = ""
            self._write()

    def show_rate(self, rate: "OwnRate | None") -> None:
        """Show beside the verdict on this picture what is read of others; None if not known."""
        self._rate = rate
        self._write()

    def name_simulation(self, named: bool) -> None:
        if named != self._is_named:
            self._is_named = named
            self._write()

    def _write(self) -> None:
        reading = self._reading
        self._offer(None)
        if self._failure:
            self.show_state(State.BAD, "No picture of this scene", self._failure)
            return
        if reading is None:
            self.show_state(State.WAITING, "Computing the first picture…")
            return
        result = result_of(reading, self._decoder or reading.decoded.decoder)
        verdict = verdict_on(result, reading.sent)
        chips = chips_of(reading, result.decoder)
        if self._run:
            chips = behind_run(chips, self._pictured)
        state = verdict.state
        if self._is_outdated:
            state, chips = State.WAITING, (computing(), *chips)
        elif self._rate is not None:
            chips = (of_pictures(self._rate), *chips)
        is_unread = verdict.state is State.BAD and verdict.reason
        cause = cause_of(reading.scene, result.decoder, result.region) if is_unread else None
        if cause is None:
            heading, why = self._heading(verdict.heading), self._why(verdict, reading)
            if _is_averaged(verdict, reading) and not (self._is_outdated or self._run):
                self._offer_lesson(AVERAGES_LESSON)
        else:
            heading = self._heading(f"No code: {cause.what}")
            why = [f"{cause.why} {verdict.reason}".strip(), cause.why]
            self._offer(None if self._is_outdated else cause.step)
        self.show_state(state, heading, *why, chips=chips)

    def _take_step(self) -> None:
        if self._step is not None:
            self.step_chosen.emit(self._step)
        elif self._lesson:
            self.lesson_wanted.emit(self._lesson)

    def _offer(self, step: Step | None) -> None:
        self._step, self._lesson = step, ""
        self.offer_step(step.label if step else "")
        self.step.setToolTip("Changes the scene or the decoder in one step.")

    def _offer_lesson(self, name: str) -> None:
        self._lesson = name
        self.offer_step("Lesson")
        self.step.setToolTip("Opens the lesson on exposures longer than a chip.")

    def _heading(self, verdict: str) -> str:
        """Write whose verdict it is, where that is not plain."""
        if self._run:
            verdict = f"{self._run}: {verdict[:1].lower()}{verdict[1:]}"
        if not self._is_named:
            return f"Earlier scene: {verdict}" if self._is_outdated else verdict
        whose = "Simulation of the earlier scene" if self._is_outdated else "Simulation"
        return f"{whose}: {verdict[:1].lower()}{verdict[1:]}"

    def _why(self, verdict: Verdict, reading: Reading) -> list[str]:
        if verdict.explanation:
            # What follows a semicolon is left out where it does not fit.
            first, more, _ = verdict.explanation.partition(";")
            return [verdict.explanation, f"{first}."] if more else [verdict.explanation]
        scene = reading.scene
        exposure = SECOND.format(scene.camera.exposure_time, 4)
        period = SECOND.format(scene.transmitter.switching_period, 4)
        fewest = chips_in_exposure(scene)
        chips = f"{fewest} or {fewest + 1} chips"
        texts = [
            f"A column gathers light for {exposure}, a chip lasts {period}: each column sees "
            f"{chips}.",
            f"{exposure} of light, {period} a chip: {chips} a column.",
            f"{exposure} of light, {period} a chip",
        ]
        if not _is_averaged(verdict, reading):
            return texts
        averages = f"averages {chips}, and the averages of different codes differ; so it is read"
        return [
            f"Exposed for {exposure}, a chip lasts {period}: each column {averages}, though the "
            "band model ends.",
            f"Each column {averages}.",
            "No column sees one chip alone: the band model ends.",
            *texts,
        ]


def _is_averaged(verdict: Verdict, reading: Reading) -> bool:
    """Return whether a code is read though every column averages several chips."""
    is_good = verdict.state is State.GOOD
    return is_good and bool(reading.band_undefined) and chips_in_exposure(reading.scene) > 1
