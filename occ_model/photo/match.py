"""Find the scene whose stripes match those of a photo.

The stripes of a lamp are fitted by their shape. For chips the exact exposure integral, under slowly
varying light, is fitted to the column means by least squares.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from occ_model.errors import MatchError, ParameterError
from occ_model.photo.camera.advice import mains_advice
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.evidence.hypothesis import Hypothesis, is_rotation
from occ_model.photo.evidence.unexplained import why_not_as_sent, why_unread
from occ_model.photo.evidence.verdict import Judge, correlate_rows
from occ_model.photo.fit.best_timing import EXPLAINED_CORRELATION
from occ_model.photo.fit.camera_response import AVERAGINGS, CameraResponse, camera_responses
from occ_model.photo.fitted_scene import exposure_time, make_match, readout_and_frequency
from occ_model.photo.lamp_fit.match import match_lamp
from occ_model.photo.photo_scene import with_notes
from occ_model.photo.reading.load import Corners, Photo, region_within
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.lamp import Lamp
from occ_model.results.match import ESTIMATES, Alternative, Match, Stripes
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import sent_chips

__all__ = ["ESTIMATES", "PATTERN_SOURCES", "match_photo"]

PATTERN_SOURCES = ("auto", "scene", "read")
"""Source of the sent pattern: the scene, the photo, or whichever of them fits."""

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
        stripes is read from them. ``"auto"``: whichever of them is more likely. A lamp's duty is
        read unless this is ``"scene"``.
    averaging
        ``"pixel-value"`` or ``"light"``, as the scene's parameter, or ``"auto"``: the better match.
        A lamp's light is averaged.
    fit_gamma
        Whether gamma is estimated too; light is then averaged.
    region
        First row, row after the last, first column and column after the last of the rectangle in
        which stripes are searched; or a lamp; None for the whole photo.
    progress
        Called with the fraction of the work that is done. An exception from it ends the match.

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
    report = _Progress(progress or (lambda _fraction: None))
    report(0.0)
    if _is_lamp(scene, sent):
        within = region_within(photo, region.region if isinstance(region, Lamp) else region)
        advice = mains_advice(scene) if estimate == "readout_time" else ()
        try:
            match = match_lamp(
                photo, scene, within,
                estimate=estimate, is_duty_known=sent == "scene", fit_gamma=fit_gamma,
                check=report.again,
            )  # fmt: skip
        except MatchError as error:
            raise MatchError(*error.reasons, *advice) from None
        if match.reasons:
            match = replace(match, reasons=(*match.reasons, *advice))
    else:
        how = _Settings(estimate, sent, averaging, fit_gamma, region)
        match = _match_chips(photo, _in_chips(scene, is_read=sent == "read"), how, report)
    report(1.0)
    return match


def _is_lamp(scene: Scene, sent: str) -> bool:
    """Whether a lamp is stated to be sent: by its light, or by one pulse that is not to be read."""
    is_lamp = blinking_lamp(scene.transmitter) is not None
    return is_lamp and (sent != "read" or scene.transmitter.light != "code")


def _in_chips(scene: Scene, *, is_read: bool) -> Scene:
    """Return a scene that sends chips; refuse another light unless the chips are to be read."""
    if is_read or scene.transmitter.light == "code":
        return scene.replace(light="code")
    raise ParameterError.of(
        "light", scene.transmitter.light,
        "code, lamp or pulses; or let what is sent be read from the photo",
        condition="where a photo is matched", parameters=("light",),
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Settings:
    """How chips are matched, as :func:`match_photo` is told."""

    estimate: str
    sent: str
    averaging: str
    fit_gamma: bool
    region: Corners | Lamp | None


def _match_chips(photo: Photo, scene: Scene, how: _Settings, report: "_Progress") -> Match:
    """Match the chips of a scene, or those that are read."""
    averaging, fit_gamma = how.averaging, how.fit_gamma
    if photo.is_linear:
        scene = scene.replace(gamma=1.0, enhancement="none")
        averaging, fit_gamma = "light", False
    stripes, scene = find_stripes(photo, how.region), with_notes(scene, photo)
    candidates = Candidates(
        stripes,
        scene,
        _cameras(stripes, scene, averaging, fit_gamma),
        fit_gamma,
        how.estimate,
        photo.exposure_time,
        report.again,
    )
    report(0.2)
    judge = Judge(stripes, correlate_rows(photo, stripes.region), blinks=how.sent == "read")
    hypotheses, unread = _hypotheses(candidates, how.sent, report)
    try:
        chosen = judge.choose(hypotheses)
    except MatchError as error:
        raise MatchError(*unread, *error.reasons) from None
    found, beside = candidates.correct(chosen)
    others = [*(one for one in hypotheses if one is not chosen), *beside]
    different = [one for one in others if not is_rotation(one, found)]
    verdict = judge.verdict(found, different, is_given=how.sent == "scene")
    report(0.9)
    match = make_match(
        photo, scene, how.estimate, stripes, found.explanation, report.again,
        was_read=found.was_read,
    )  # fmt: skip
    return replace(
        match,
        reasons=(*verdict.reasons, *match.reasons),
        exposure_reasons=(*verdict.exposure_reasons, *match.exposure_reasons),
        alternatives=tuple(
            _alternative(one, evidence, scene, how.estimate) for one, evidence in verdict.others
        ),
    )


class _Progress:
    """Reports the fraction of the work that is done, again and again while a part of it lasts."""

    def __init__(self, report: Callable[[float], object]) -> None:
        self._report, self._fraction, self._last = report, 0.0, 0.0

    def __call__(self, fraction: float) -> None:
        self._fraction, self._last = fraction, time.monotonic()
        self._report(fraction)

    def again(self) -> None:
        """Report the same fraction again after some time, so that the caller can cancel."""
        if time.monotonic() - self._last > _REPORT_INTERVAL:
            self(self._fraction)


def check_words(estimate: str, sent: str, averaging: str) -> None:
    """Refuse choices that are not allowed, before any work."""
    check_choice("estimate", estimate, ESTIMATES)
    check_choice("sent", sent, PATTERN_SOURCES)
    check_choice("averaging", averaging, ("auto", *AVERAGINGS))


def _cameras(
    stripes: Stripes, scene: Scene, averaging: str, fit_gamma: bool
) -> list[CameraResponse]:
    averagings = AVERAGINGS if averaging == "auto" else (averaging,)
    if fit_gamma:
        averagings = ("light",)
    low, high = float(np.median(stripes.low)), float(np.median(stripes.high))
    return camera_responses(scene, averagings, low, high)


def _hypotheses(
    candidates: Candidates, sent: str, report: Callable[[float], object]
) -> tuple[list[Hypothesis], list[str]]:
    """Return what may be sent, and why nothing could be read from the stripes, if so."""
    as_sent = None if sent == "read" else candidates.as_sent()
    report(0.5)
    found = [] if sent == "scene" else candidates.read(as_sent)
    report(0.8)
    explained = 0.0 if as_sent is None else as_sent.fit.correlation
    is_unread = candidates.stripes.period is None or explained < EXPLAINED_CORRELATION
    unread = [why_unread(candidates.stripes)] if is_unread and not found and sent != "scene" else []
    if as_sent is not None:
        # Both ways can lead to the scene's chips, with different timings; the better one is kept.
        agreed = [
            replace(one, sent=as_sent.sent, bits=0.0, was_read=False)
            for one in found
            if is_rotation(one, as_sent)
        ]
        best = min([as_sent, *agreed], key=lambda one: one.fit.residual)
        found = [best, *(one for one in found if not is_rotation(one, as_sent))]
    if not found:
        chips = sent_chips(candidates.scene.transmitter)
        varies = bool(chips.min() < chips.max())
        raise MatchError(*([] if sent == "read" else [why_not_as_sent(varies)]), *unread)
    return found, unread


def _alternative(other: Hypothesis, evidence: float, scene: Scene, estimate: str) -> Alternative:
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
