"""Find the scene whose stripes match those of a photo.

The exact exposure integral, under slowly varying light, is fitted to the column means by least
squares.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.errors import MatchError
from occ_model.photo.evidence.limits import doubts_by_limits
from occ_model.photo.fit.best_timing import Explanation, explain
from occ_model.photo.fit.camera_response import AVERAGINGS, CameraTone, camera_tones
from occ_model.photo.fit.read_pattern import read_pattern
from occ_model.photo.fitted_scene import ESTIMATES, described, with_notes
from occ_model.photo.reading.load import Photo
from occ_model.photo.reading.part import Corners
from occ_model.photo.stripes.find import find_stripes
from occ_model.results import Match, Stripes
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

__all__ = ["ESTIMATES", "PATTERN_SOURCES", "match_photo"]

PATTERN_SOURCES = ("auto", "scene", "read")
"""Where the sent pattern is taken from: the scene, the photo, or whichever of them fits."""

_EXPLAINS = 0.9
"""Correlation from which chips are taken as the sent ones; chips read from the photo need it."""

_CLEARLY = 0.03
"""Difference in correlation by which chips read from the photo must exceed the scene's chips."""

_LEAST = 0.8
"""Correlation below which the scene's chips do not explain the stripes."""

_NEAR = np.arange(-4, 5) / 8.0
"""Shifts of the last chip, in chips, of the steps that are tried near a known step."""


def match_photo(  # noqa: PLR0913 - all but the first two are words with defaults
    photo: Photo,
    scene: Scene,
    *,
    estimate: str = "readout_time",
    sent: str = "auto",
    averaging: str = "auto",
    fit_gamma: bool = False,
    region: Corners | None = None,
    progress: Callable[[float], object] | None = None,
) -> Match:
    """Find the settings whose stripes match those of a photo.

    The uncertainties are those of the fit; effects outside the model can cause larger errors.

    Parameters
    ----------
    photo
        The photo.
    scene
        The known settings: the sent code or pattern (a square wave of F cycles per second is the
        pattern "10" at a switching frequency of 2 F), and the switching frequency or readout time.
    estimate
        The unknown one of these two: ``"readout_time"`` or ``"switching_frequency"``.
    sent
        ``"scene"``: the scene's pattern was sent. ``"read"``: the shortest pattern that explains
        the stripes is read from them. ``"auto"``: it is read where the scene's does not match.
    averaging
        ``"pixel-value"`` or ``"light"``, as the scene's parameter, or ``"auto"``: the better match.
    fit_gamma
        Whether gamma is estimated too; light is then averaged.
    region
        First row, row after the last, first column and column after the last of the rectangle in
        which stripes are searched; None for the whole photo.
    progress
        Called with the share of the work that is done. What it raises ends the match.

    Raises
    ------
    MatchError
        The photo shows no stripes, or no pattern and settings in range explain them.
    ParameterError
        ``estimate``, ``sent`` or ``averaging`` is not one of these words, or ``region`` is no
        rectangle of the photo.
    """
    _check(scene, estimate, sent, averaging)
    report = progress or (lambda _share: None)
    report(0.0)
    task = _task(find_stripes(photo, region), with_notes(scene, photo), averaging, fit_gamma)
    report(0.2)
    explanation, was_read = _explanation(task, sent, report)
    report(0.9)
    match = described(photo, task.scene, estimate, task.stripes, explanation)
    report(1.0)
    return replace(match, pattern_was_read=was_read, reasons=doubts_by_limits(match))


def _check(scene: Scene, estimate: str, sent: str, averaging: str) -> None:
    check_scene(scene)
    check_choice("estimate", estimate, ESTIMATES)
    check_choice("sent", sent, PATTERN_SOURCES)
    check_choice("averaging", averaging, ("auto", *AVERAGINGS))


def _task(stripes: Stripes, scene: Scene, averaging: str, fit_gamma: bool) -> "_Task":
    averagings = AVERAGINGS if averaging == "auto" else (averaging,)
    if fit_gamma:
        averagings = ("light",)
    low, high = float(np.median(stripes.low)), float(np.median(stripes.high))
    cameras = camera_tones(scene, averagings, low, high)
    return _Task(stripes, scene, cameras, fit_gamma)


@dataclass(frozen=True, eq=False, slots=True)
class _Task:
    """The stripes to be explained, what is known of them, and the cameras that are tried."""

    stripes: Stripes
    scene: Scene
    cameras: list[CameraTone]
    fit_gamma: bool

    def explained_by(self, chips: ByteArray, steps: FloatArray | None = None) -> Explanation | None:
        """Fit the timing of given chips to the stripes."""
        gamma = self.scene.camera.gamma
        return explain(self.stripes, chips, self.cameras, gamma, self.fit_gamma, steps)

    def read(self) -> Explanation | None:
        """Read the chips from the stripes, and fit their timing."""
        if self.stripes.period is None:
            return None
        read = read_pattern(self.stripes.profile, self.stripes.flattened, self.stripes.period)
        if read is None:
            return None
        step = len(read.chips) / self.stripes.period
        return self.explained_by(read.chips, step + _NEAR / len(self.stripes.profile))


def _explanation(
    task: _Task, sent: str, report: Callable[[float], object]
) -> tuple[Explanation, bool]:
    """Explain the stripes by the scene's chips, or by those read from the photo."""
    found = None if sent == "read" else task.explained_by(sent_chips(task.scene.transmitter))
    report(0.6)
    was_read = False
    if sent != "scene" and (found is None or found.correlation < _EXPLAINS):
        read = task.read()
        if read is not None and (found is None or read.correlation > found.correlation + _CLEARLY):
            found, was_read = read, True
    if found is None or found.correlation < (_EXPLAINS if was_read else _LEAST):
        raise MatchError(*_why_unexplained(task.stripes, sent, found))
    return found, was_read


def _why_unexplained(stripes: Stripes, sent: str, found: Explanation | None) -> list[str]:
    sentences = []
    if sent != "read":
        sentences.append(
            "What the scene sends never changes: it makes no stripes."
            if found is None
            else "What the scene sends does not explain the stripes: the best correlation is "
            f"{found.correlation:.2f}; at least {_LEAST} is needed."
        )
    if sent != "scene":
        sentences.append(
            "The stripes do not repeat within the panel's image, so that what is sent cannot be "
            "read from them; come closer, raise the frequency, or say what is sent."
            if stripes.period is None
            else f"The stripes repeat after {stripes.period:.1f} columns, but no sequence of chips "
            "read from them explains them; say what is sent."
        )
    return sentences
