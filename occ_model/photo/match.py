"""Find the scene whose stripes match those of a photo.

The exact exposure integral, under slowly varying light, is fitted to the column means by least
squares.
"""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.errors import MatchError
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.evidence.hypothesis import Hypothesis, is_turned
from occ_model.photo.evidence.unexplained import why_not_as_sent, why_unread
from occ_model.photo.evidence.verdict import Judge, rows_alike
from occ_model.photo.fit.best_timing import EXPLAINED_CORRELATION
from occ_model.photo.fit.camera_response import AVERAGINGS, CameraTone, camera_tones
from occ_model.photo.fit.chip_runs import is_single_pulse
from occ_model.photo.fitted_scene import (
    exposure_time,
    make_match,
    readout_and_frequency,
    scale_frequency,
)
from occ_model.photo.lamp_chips import in_chips, with_lamp
from occ_model.photo.lamp_fit.match import match_lamp
from occ_model.photo.photo_scene import with_notes
from occ_model.photo.reading.load import Corners, Photo, region_within
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.lamp import Lamp
from occ_model.results.match import ESTIMATES, Alternative, Match, Stripes
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.transmitter.scheme import sent_chips

__all__ = ["ESTIMATES", "PATTERN_SOURCES", "match_photo"]

PATTERN_SOURCES = ("auto", "scene", "read")
"""Source of the sent pattern: the scene, the photo, or whichever of them fits."""

_SURE_DUTY_CORRELATION = 0.998
"""Correlation of the scene's pulse above which no other duty is searched for."""
_SAME_DUTY = 2.0  # standard deviations within which a measured duty is the scene's
_REPORT_INTERVAL = 0.05  # minimum time between two reports of progress


def match_photo(  # noqa: PLR0913 - all but the first two are words with defaults
    photo: Photo,
    scene: Scene,
    *,
    estimate: str = "readout_time",
    sent: str = "auto",
    averaging: str = "auto",
    fit_gamma: bool = False,
    region: Corners | Lamp | None = None,
    progress: Callable[[float], object] | None = None,
) -> Match:
    """Find the settings whose stripes match those of a photo.

    The uncertainties are those of the fit; effects outside the model can cause larger errors.

    Parameters
    ----------
    photo
        The photo. Where its samples are in proportion to the light, light is averaged and there is
        no gamma, whatever ``averaging``, ``fit_gamma`` and the scene say.
    scene
        The known settings: the light that is sent, a code or a lamp of a frequency and a duty, and
        its frequency or the readout time.
    estimate
        The unknown one of these two: ``"readout_time"`` or ``"switching_frequency"``, which stands
        for a lamp's frequency, too.
    sent
        ``"scene"``: the scene's light was sent. ``"read"``: the shortest pattern that explains the
        stripes is read from them. ``"auto"``: whichever of them is more likely; a lamp may have
        another duty.
    averaging
        ``"pixel-value"`` or ``"light"``, as the scene's parameter, or ``"auto"``: the better match.
    fit_gamma
        Whether gamma is estimated too; light is then averaged.
    region
        First row, row after the last, first column and column after the last of the rectangle in
        which stripes are searched; or a lamp; None for the whole photo.
    progress
        Called with the fraction of the work that is done. What it raises ends the match.

    Raises
    ------
    MatchError
        The photo shows no stripes, or no pattern and settings in range explain them better than
        chance and than no code at all.
    ParameterError
        ``estimate``, ``sent`` or ``averaging`` is not one of these words, ``region`` is not a
        rectangle of the photo, or the scene's light is neither a code nor a lamp.
    """
    check_words(estimate, sent, averaging)
    given, scene = scene, in_chips(scene, is_read=sent == "read")
    if photo.is_linear:
        scene = scene.replace(gamma=1.0, enhancement="none")
        averaging, fit_gamma = "light", False
    report = _Progress(progress or (lambda _fraction: None))
    report(0.0)
    lamp = _match_as_lamp(photo, given, estimate, sent, region)
    if lamp is not None and lamp.verdict == "sure":
        report(1.0)
        return lamp
    how = _Settings(estimate, sent, averaging, fit_gamma, region)
    try:
        match = _match_chips(photo, given, scene, how, report)
    except MatchError:
        if lamp is None:
            raise
        match = lamp
    report(1.0)
    return match


@dataclass(frozen=True, slots=True)
class _Settings:
    """How a photo is matched, as :func:`match_photo` is told."""

    estimate: str
    sent: str
    averaging: str
    fit_gamma: bool
    region: Corners | Lamp | None


def _match_chips(
    photo: Photo, given: Scene, scene: Scene, how: _Settings, report: "_Progress"
) -> Match:
    """Match the chips of a scene, or those that are read; ``given``: before a lamp was in chips."""
    stripes, scene = find_stripes(photo, how.region), with_notes(scene, photo)
    candidates = Candidates(
        stripes,
        scene,
        _cameras(stripes, scene, how.averaging, how.fit_gamma, report.again),
        how.fit_gamma,
        how.estimate,
        photo.exposure_time,
        report.again,
    )
    report(0.2)
    blinks = how.sent == "read" or is_single_pulse(sent_chips(scene.transmitter))
    judge = Judge(stripes, rows_alike(photo, stripes.region), blinks=blinks)
    hypotheses, unread = _hypotheses(candidates, how.sent, report)
    try:
        chosen = judge.choose(hypotheses)
    except MatchError as error:
        raise MatchError(*unread, *error.reasons) from None
    case = _Case(photo, given, candidates, judge, hypotheses, how.sent, report)
    as_sent = next((one for one in hypotheses if not one.was_read), None)
    noted = candidates.as_noted(chosen) if chosen is as_sent and how.sent == "auto" else None
    match = case.concluded(noted or chosen)
    if as_sent is not None and chosen.rate != 1.0 and case.may_be_as_sent(match):
        match = case.concluded(as_sent)
    return match


def _match_as_lamp(
    photo: Photo, scene: Scene, estimate: str, sent: str, region: Corners | Lamp | None
) -> Match | None:
    """Match a lamp's stripes by their shape; None if a code is sent or they are not a lamp's."""
    if sent == "read" or blinking_lamp(scene.transmitter) is None:
        return None
    within = region.region if isinstance(region, Lamp) else region_within(photo, region)
    try:
        return match_lamp(photo, scene, within, estimate=estimate, is_duty_known=sent == "scene")
    except MatchError:
        return None


@dataclass(frozen=True, eq=False, slots=True)
class _Case:
    """The hypotheses about a photo, and what a conclusion from one of them needs."""

    photo: Photo
    given: Scene  # What was known, before its lamp was in chips
    candidates: Candidates
    judge: Judge
    hypotheses: Sequence[Hypothesis]
    sent: str
    report: "_Progress"

    def concluded(self, chosen: Hypothesis) -> Match:
        """Express a hypothesis as a match, with the verdict on it beside the others."""
        photo, scene, estimate = self.photo, self.candidates.scene, self.candidates.estimate
        found, beside = self.candidates.corrected(chosen)
        others = [*(one for one in self.hypotheses if one is not chosen), *beside]
        apart = [one for one in others if not is_turned(one, found)]
        verdict = self.judge.verdict(found, apart, is_given=self.sent == "scene")
        self.report(0.9)
        chips = make_match(
            photo,
            scale_frequency(scene, found.rate),
            estimate,
            self.candidates.stripes,
            found.explanation,
            self.report.again,
            was_read=found.was_read,
        )
        match = with_lamp(chips, self.given)
        other = _exchanged_exposure(photo, match, self.sent)
        exchanged = () if other is None else (_doubt_of_exchange(match, other),)
        return replace(
            match,
            reasons=(*verdict.reasons, *self._doubts_by_kind(found), *match.reasons),
            exposure_reasons=(*verdict.exposure_reasons, *exchanged, *match.exposure_reasons),
            other_exposures=tuple(sorted({*match.other_exposures, *([other] if other else [])})),
            alternatives=tuple(
                _alternative(one, evidence, scene, estimate) for one, evidence in verdict.others
            ),
        )

    def _doubts_by_kind(self, found: Hypothesis) -> list[str]:
        """Doubt chips that were read where the frequency of a pulse was given."""
        given = sent_chips(self.candidates.scene.transmitter)
        blinks = is_single_pulse(given) and given.min() < given.max()
        if self.sent == "read" or is_single_pulse(found.chips) or not blinks:
            return []
        return [
            "What was read is not a lamp's light, as is given: the frequency given may be that of "
            "a code's chips."
        ]

    def may_be_as_sent(self, match: Match) -> bool:
        """Whether a duty that was searched is that of the scene, within its error."""
        error, duty = match.uncertainties.get("duty"), match.duty
        given = float(sent_chips(self.candidates.scene.transmitter).mean())
        return error is not None and duty is not None and abs(duty - given) <= _SAME_DUTY * error


class _Progress:
    """Reports the fraction of the work that is done, again and again while a part of it lasts."""

    def __init__(self, report: Callable[[float], object]) -> None:
        self._report, self._fraction, self._last = report, 0.0, 0.0

    def __call__(self, fraction: float) -> None:
        self._fraction, self._last = fraction, time.monotonic()
        self._report(fraction)

    def again(self) -> None:
        """Report the same fraction, if some time has passed: the receiver may end the work so."""
        if time.monotonic() - self._last > _REPORT_INTERVAL:
            self(self._fraction)


def check_words(estimate: str, sent: str, averaging: str) -> None:
    """Refuse choices that are not allowed, before any work."""
    check_choice("estimate", estimate, ESTIMATES)
    check_choice("sent", sent, PATTERN_SOURCES)
    check_choice("averaging", averaging, ("auto", *AVERAGINGS))


def _cameras(
    stripes: Stripes, scene: Scene, averaging: str, fit_gamma: bool, check: Callable[[], object]
) -> list[CameraTone]:
    averagings = AVERAGINGS if averaging == "auto" else (averaging,)
    if fit_gamma:
        averagings = ("light",)
    low, high = float(np.median(stripes.low)), float(np.median(stripes.high))
    return camera_tones(scene, averagings, low, high, check)


def _hypotheses(
    candidates: Candidates, sent: str, report: Callable[[float], object]
) -> tuple[list[Hypothesis], list[str]]:
    """Return what may be sent, and why nothing could be read from the stripes, if so."""
    as_sent = None if sent == "read" else candidates.as_sent()
    report(0.5)
    found, unread = ([], []) if sent == "scene" else _read(candidates, as_sent, sent)
    report(0.8)
    if as_sent is not None:
        # Where both ways lead to the scene's chips, then perhaps to different timings.
        agreed = [
            replace(one, sent=as_sent.sent, bits=0.0, was_read=False)
            for one in found
            if is_turned(one, as_sent)
        ]
        best = min([as_sent, *agreed], key=lambda one: one.fit.residual)
        found = [best, *(one for one in found if not is_turned(one, as_sent))]
    if not found:
        chips = sent_chips(candidates.scene.transmitter)
        varies = bool(chips.min() < chips.max())
        raise MatchError(*([] if sent == "read" else [why_not_as_sent(varies)]), *unread)
    return found, unread


def _read(
    candidates: Candidates, as_sent: Hypothesis | None, sent: str
) -> tuple[list[Hypothesis], list[str]]:
    """Fit what is read; of a single pulse whose frequency is given only the duty can be another.

    Where nothing is read the second list says why.
    """
    read = candidates.read(as_sent)
    chips = sent_chips(candidates.scene.transmitter)
    is_pulse = bool(chips.min() < chips.max()) and is_single_pulse(chips)
    is_given = is_pulse and sent != "read"
    explained = 0.0 if as_sent is None else as_sent.fit.correlation
    stripes = candidates.stripes
    is_unread = not read and (stripes.period is None or explained < EXPLAINED_CORRELATION)
    unread = [why_unread(stripes, is_given=is_given)] if is_unread else []
    if not is_given:
        return read, unread
    others = [
        one
        for one in read
        if not is_single_pulse(one.chips) or (as_sent is not None and is_turned(one, as_sent))
    ]
    if explained >= _SURE_DUTY_CORRELATION:
        return others, unread
    dimmed = candidates.dimmed(as_sent)
    return others if dimmed is None else [*others, dimmed], unread


def _exchanged_exposure(photo: Photo, match: Match, sent: str) -> float | None:
    """Return the other exposure time that explains a pulse as well: that of its light.

    The stripes of a pulse are symmetric in its length and its exposure. Only a noted exposure, or a
    pulse that is stated to be sent, decides which of them is which.
    """
    lamp = match.lamp
    if photo.exposure_time is not None or sent == "scene" or lamp is None:
        return None
    lit, period = lamp.duty / lamp.frequency, 1.0 / lamp.frequency
    error = math.hypot(
        match.uncertainties["exposure_time"], match.uncertainties.get("duty", 0.0) * period
    )
    apart = abs(match.exposure_time - lit) > _SAME_DUTY * error
    return float(lit) if apart and match.exposure_time < period else None


def _doubt_of_exchange(match: Match, other: float) -> str:
    fraction = PERCENT.format(match.exposure_in_periods, 3)
    time_ = quantity("exposure_time").format(other)
    return (
        f"A lamp with a duty of {fraction}, exposed for {time_}, makes the same stripes, and the "
        "photo notes no exposure time: the duty may be that of the exposure. If the duty is known, "
        "state that what the scene sends is sent."
    )


def _alternative(other: Hypothesis, evidence: float, scene: Scene, estimate: str) -> Alternative:
    scene = scale_frequency(scene, other.rate)
    readout, frequency = readout_and_frequency(other.fit, scene, estimate)
    return Alternative(
        sent=other.sent,
        pattern="".join(map(str, other.chips.tolist())),
        correlation=other.fit.correlation,
        evidence=float(evidence),
        readout_time=readout,
        switching_frequency=frequency,
        exposure_time=exposure_time(other.fit, scene, estimate),
    )
