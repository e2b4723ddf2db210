"""Verdict bar: whether the code was read, in words, colour and shape, with further badges."""

import math
from collections.abc import Callable, Iterator

from PySide6.QtCore import Signal

from occ_gui.detection_map.slider_strip import SceneRate
from occ_gui.simulation.snapshot import Reading
from occ_gui.simulation.verdict import (
    CodeVerdict,
    cause_in,
    describe_bars,
    describe_missing,
    is_right,
    result_of,
    verdict_on,
)
from occ_gui.story.column_facts import READ_BY_ALL, chips_in_exposure
from occ_gui.widgets.state_bar import CHANGES_SCENE, StateBar
from occ_gui.widgets.state_look import Badge, State
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, overexposed_text, symptom
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import TOLERANCE, unit_of
from occ_model.scene.units import PERCENT, SECOND

_COMPUTING = "computing"  # key of the badge for results that are still to come
_GOOD_RATE = 0.99  # fraction of right bits from which a decoder reads


def make_badges(reading: Reading, decoder: str) -> Iterator[Badge]:
    """Yield all badges of a reading, for which the decoder's verdict is shown."""
    if not reading.has_picture:
        meaning = "Read from the column profile or a draft; the exact picture is being computed."
        yield Badge(_COMPUTING, "computing the picture", meaning, State.WAITING, stays=True)
    if reading.overexposed:
        text = f"overexposed: {PERCENT.format(reading.overexposed, 2)}"
        yield Badge("overexposed", text, overexposed_text(reading.overexposed), State.DOUBTFUL)
    yield _make_ratio_badge(reading)
    if reading.scene.transmitter.light != "code":  # nothing is read
        return
    yield from _list_other_decoders(reading, decoder)
    if reading.missing_effects:
        yield Badge("left out", "effects left out", describe_missing(reading), State.DOUBTFUL)


def _make_ratio_badge(reading: Reading) -> Badge:
    exposure, sent = reading.scene.camera.exposure_time, reading.scene.transmitter
    if has_chips(sent):
        meaning = "Exposure time over chip duration. Above 1, each column sees more than one chip."
        ratio = exposure / sent.switching_period
        return Badge("ratio", f"t / t<sub>LED</sub> = {ratio:.3g}", meaning)
    meaning = (
        "Exposure time over the period of the light. If it is an integer k, at the light's "
        "nulls k / t, there are no bars."
    )
    return Badge("ratio", f"t / period = {exposure / reading.light_period:.3g}", meaning)


def make_computing_badge() -> Badge:
    return Badge(_COMPUTING, "computing", "Results are being computed.", State.WAITING, stays=True)


def make_rate_badge(rate: SceneRate) -> Badge:
    """Return the success rate of pictures that begin at any time."""
    text = f"{rate.images} pictures: {100.0 * rate.fraction:.3g} % of bits read"
    meaning = (
        f"This is one picture. Of {rate.images} with different start times, "
        f"{100.0 * rate.fraction:.3g} % of the bits are read (95 % interval {100.0 * rate.low:.1f} "
        f"to {100.0 * rate.high:.1f} %), and every bit of {rate.whole} pictures. The strips show "
        "the same percentage."
    )
    state = State.DOUBTFUL if rate.fraction else State.BAD
    return Badge("rate", text, meaning, State.GOOD if rate.fraction >= _GOOD_RATE else state)


def add_picture_value(badges: tuple[Badge, ...], picture_value: str) -> tuple[Badge, ...]:
    """Add a badge with the picture's value of a running slider.

    ``picture_value``: that value; empty if the results have the same one.
    """
    rest = tuple(badge for badge in badges if badge.key != _COMPUTING)
    if not picture_value:
        return rest
    meaning = "The slider runs ahead of the picture, which is still of this value."
    return (Badge(_COMPUTING, f"picture: {picture_value}", meaning, stays=True), *rest)


def _list_other_decoders(reading: Reading, decoder: str) -> list[Badge]:
    # Other decoders have read the picture only if they were chosen before.
    tried = [name for name in (*READ_BY_ALL, decoder) if name in reading.results]
    right = [name for name in tried if is_right(reading.results[name], reading.sent)]
    others = [name for name in right if name != decoder]
    if not reading.sent or not others:
        return []
    names = ", ".join(others)
    meaning = (
        f"Every picture is read with the decoders {', '.join(READ_BY_ALL)}; of these, {names} also "
        "read all bits. Other decoders read a picture when they are chosen."
    )
    text = f"also read by: {names}" if decoder in right else f"read by: {names}"
    return [Badge("others", text, meaning, State.GOOD)]


AVERAGES_LESSON = "2-past-the-shutter"
"""The lesson on codes that are read though each column averages several chips."""

_LESSON_TIP = "Opens the lesson on exposures longer than a chip."
_COLOURS_TIP = "Shows all three colours and what is read in each of them."


class VerdictBar(StateBar):
    """The verdict on the code that is read from the simulated picture."""

    step_chosen = Signal(object)
    """The user takes the step that helps, a :class:`~occ_model.results.decoding.Remedy`."""
    lesson_requested = Signal(str)  # the user asks for the lesson on what is shown, by its name
    colours_requested = Signal()  # the user asks for all three colours of a colour camera

    def __init__(self) -> None:
        super().__init__()
        self._colour = ""
        self._take_step: Callable[[], object] = lambda: None
        self.step_taken.connect(lambda: self._take_step())
        self._reading: Reading | None = None
        self._decoder = PAPER_DECODER
        self._running_value = self._picture_value = ""
        self._is_outdated = self._names_simulation = False
        self._failure = ""
        self._rate: SceneRate | None = None
        self.setAccessibleName("Verdict on the code")
        self._write()

    def show_reading(self, reading: Reading) -> None:
        self._reading, self._failure = reading, ""
        of_code = has_chips(reading.scene.transmitter)
        self.setAccessibleName(f"Verdict on the {'code' if of_code else 'bars'}")
        self._write()

    def choose_decoder(self, name: str) -> None:
        self._decoder = name
        self._write()

    def show_outdated(self, outdated: bool) -> None:
        if outdated != self._is_outdated:
            self._is_outdated = outdated
            self._write()

    def show_run(self, value: str, picture_value: str) -> None:
        """Show which value of a running slider the verdict is for; empty while none runs."""
        if (value, picture_value) != (self._running_value, self._picture_value):
            self._running_value, self._picture_value = value, picture_value
            self._write()

    def show_failure(self, sentence: str) -> None:
        """Show why the present scene has no picture, until the next results."""
        self._failure = sentence
        self._write()

    def end_failure(self) -> None:
        if self._failure:
            self._failure = ""
            self._write()

    def show_rate(self, rate: SceneRate | None) -> None:
        """Show the rate of other pictures next to the verdict on this one; None if unknown."""
        self._rate = rate
        self._write()

    def name_simulation(self, named: bool) -> None:
        if named != self._names_simulation:
            self._names_simulation = named
            self._write()

    def name_colour(self, colour: str) -> None:
        """Name the colour that the verdict is on; empty for a monochrome camera."""
        if colour != self._colour:
            self._colour = colour
            self._write()

    def _write(self) -> None:
        reading = self._reading
        self._offer("")
        if self._failure:
            self.show_state(State.BAD, "No picture of this scene", self._failure)
            return
        if reading is None:
            self.show_state(State.WAITING, "Computing the first picture…")
            return
        result = result_of(reading, self._decoder)
        verdict = verdict_on(result, reading.sent)
        badges = tuple(make_badges(reading, result.decoder))
        if self._running_value:
            badges = add_picture_value(badges, self._picture_value)
        state = verdict.state
        if self._is_outdated:
            state, badges = State.WAITING, (make_computing_badge(), *badges)
        elif self._rate is not None:
            badges = (make_rate_badge(self._rate), *badges)
        heading, *sentences = self._compose(reading, result, verdict)
        self.show_state(state, self._make_heading(heading), *sentences, badges=badges)

    def _compose(self, reading: Reading, result: DecodeResult, verdict: CodeVerdict) -> list[str]:
        """Return a heading and its explanation in ever fewer words; offer the step that helps."""
        if not has_chips(reading.scene.transmitter):
            return [*describe_bars(reading)]
        cause = cause_in(reading, result)
        if cause is not None:
            remedy = cause.remedy
            if remedy is not None and not self._is_outdated:
                self._offer(remedy.label, lambda: self.step_chosen.emit(remedy))
            verdict_in_short = "No code" if result.code is None else verdict.title
            why = f"{cause.why} {symptom(verdict.reason)}".strip()
            return [f"{verdict_in_short}: {cause.what}", why, cause.why, symptom(cause.why)]
        if self._colour:
            self._offer("Three colours", self.colours_requested.emit, _COLOURS_TIP)
        elif _is_averaged(verdict, reading) and not (self._is_outdated or self._running_value):
            self._offer("Lesson", lambda: self.lesson_requested.emit(AVERAGES_LESSON), _LESSON_TIP)
        # While the cause is being searched for, the heading names no symptom.
        heading = verdict.title if reading.causes is None else verdict.heading
        return [heading + _describe_error(verdict, reading), *self._explain(verdict, reading)]

    def _offer(
        self, label: str, take: Callable[[], object] = lambda: None, tip: str = CHANGES_SCENE
    ) -> None:
        """Offer a step, which ``take`` takes; no step without a label."""
        self._take_step = take
        self.offer_step(label, tip)

    def _make_heading(self, verdict: str) -> str:
        """Return the heading, which names the verdict's source if several verdicts are visible."""
        if self._colour:
            verdict = f"{self._colour.capitalize()}: {verdict[:1].lower()}{verdict[1:]}"
        if self._running_value:
            verdict = f"{self._running_value}: {verdict[:1].lower()}{verdict[1:]}"
        if not self._names_simulation:
            return f"Earlier scene: {verdict}" if self._is_outdated else verdict
        subject = "Simulation of the earlier scene" if self._is_outdated else "Simulation"
        return f"{subject}: {verdict[:1].lower()}{verdict[1:]}"

    def _explain(self, verdict: CodeVerdict, reading: Reading) -> list[str]:
        if verdict.explanation:
            # The part after a semicolon is dropped where it does not fit.
            reason = verdict.reason if reading.causes is None else verdict.explanation
            first, more, _ = reason.partition(";")
            return [reason, f"{first}."] if more else [reason]
        if verdict.state in (State.BAD, State.DOUBTFUL):  # the exposure would seem to be the cause
            return ["" if verdict.reason else "The decoder does not detect this."]
        scene = reading.scene
        exposure = SECOND.format(scene.camera.exposure_time, 4)
        period = SECOND.format(scene.transmitter.switching_period, 4)
        chip_count = chips_in_exposure(scene)
        chips = f"{chip_count} or {chip_count + 1} chips"
        texts = [
            f"A column gathers light for {exposure}, a chip lasts {period}: each column sees "
            f"{chips}.",
            f"{exposure} of light, {period} a chip: {chips} a column.",
            f"{exposure} of light, {period} a chip",
        ]
        if not _is_averaged(verdict, reading):
            return texts
        averages = f"averages {chips}; different codes give different averages, so the code is read"
        return [
            f"Exposure {exposure}, chip {period}: each column {averages}, though the "
            "band model ends.",
            f"Each column {averages}.",
            "Each column sees more than one chip: the band model ends.",
            *texts,
        ]


def _describe_error(verdict: CodeVerdict, reading: Reading) -> str:
    """Qualify a good verdict if more is left out than by default; otherwise empty."""
    if verdict.state is not State.GOOD or reading.error <= TOLERANCE.default:
        return ""
    observable = reading.request.settings.observable
    # The error of single columns and decisions may slightly exceed its estimate.
    prefix = "up to" if observable == "image" else "about"
    amount = f"{prefix} {reading.error:.2g} {unit_of(observable)}"
    return f" ({amount if math.isfinite(reading.error) else 'an unknown part'} left out)"


def _is_averaged(verdict: CodeVerdict, reading: Reading) -> bool:
    """Return whether a code is read though every column averages several chips."""
    is_good = verdict.state is State.GOOD
    return is_good and bool(reading.band_undefined) and chips_in_exposure(reading.scene) > 1
