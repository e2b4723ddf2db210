"""Find the scene that explains a photo."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.errors import MatchError
from occ_model.photo.fit.best_timing import Explanation, explain
from occ_model.photo.fit.camera_response import AVERAGINGS, CameraTone, camera_tones
from occ_model.photo.fit.read_pattern import read_pattern
from occ_model.photo.fitted_scene import ESTIMATES, described, with_notes
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results import Match, Stripes
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

__all__ = ["ESTIMATES", "PATTERN_SOURCES", "match_photo"]

PATTERN_SOURCES = ("auto", "scene", "read")
"""What is taken as sent: what the scene sends, what is read from the photo, or what fits."""

_EXPLAINS = 0.9
"""Correlation from which chips are taken as what was sent; those that were read need it."""

_CLEARLY = 0.03
"""By how much chips that were read must explain more than what was told, to take its place."""

_LEAST = 0.8
"""Correlation below which nothing is explained."""

_NEAR = np.arange(-4, 5) / 8.0
"""Turns of the last chip that steps about a known one are tried with."""


def match_photo(
    photo: Photo,
    scene: Scene,
    *,
    estimate: str = "readout_time",
    sent: str = "auto",
    averaging: str = "auto",
    fit_gamma: bool = False,
    progress: Callable[[float], object] | None = None,
) -> Match:
    """Find the settings that explain a photo's stripes.

    The exact exposure integral is fitted to the mean of the columns, under light that varies
    slowly, by least squares. The uncertainties are those of the fit; what the model does not know,
    such as a camera's own tone curve, can be more.

    Parameters
    ----------
    photo
        The photo.
    scene
        What is known: what was sent (a code or a raw pattern; a plain square wave of F cycles per
        second is the pattern "10" at a switching frequency of 2 F), and one of the switching
        frequency and the readout time.
    estimate
        The other one: ``"readout_time"`` or ``"switching_frequency"``.
    sent
        ``"scene"``: what the scene sends. ``"read"``: the shortest repeating sequence of chips that
        explains the stripes is read from them. ``"auto"``: the second where the first explains
        nothing.
    averaging
        What the camera averaged while it exposed a column: ``"pixel-value"`` or ``"light"``, as the
        scene's parameter; ``"auto"``: what explains the photo better.
    fit_gamma
        Whether gamma is estimated too; light is then averaged.
    progress
        Is told the share that is done. What it raises ends the match.

    Returns
    -------
    Match

    Raises
    ------
    MatchError
        The photo shows no stripes, nothing that is sent explains them, or what explains them is
        outside a parameter's range.
    ParameterError
        ``estimate``, ``sent`` or ``averaging`` is none of these words.
    """
    check_scene(scene)
    check_choice("estimate", estimate, ESTIMATES)
    check_choice("sent", sent, PATTERN_SOURCES)
    check_choice("averaging", averaging, ("auto", *AVERAGINGS))
    tell = progress or (lambda _share: None)
    averagings = AVERAGINGS if averaging == "auto" else (averaging,)
    if fit_gamma:
        averagings = ("light",)
    tell(0.0)
    stripes = find_stripes(photo)
    tell(0.2)
    scene = with_notes(scene, photo)
    cameras = camera_tones(
        scene, averagings, float(np.median(stripes.low)), float(np.median(stripes.high))
    )
    task = _Task(stripes, cameras, scene.camera.gamma, fit_gamma)
    explanation, was_read = _explanation(task, scene, sent, tell)
    tell(0.9)
    match = described(photo, scene, estimate, stripes, explanation)
    tell(1.0)
    return replace(match, pattern_was_read=was_read)


@dataclass(frozen=True, eq=False, slots=True)
class _Task:
    """What is to be explained, and how."""

    stripes: Stripes
    cameras: list[CameraTone]
    gamma: float
    fit_gamma: bool

    def explained_by(self, chips: ByteArray, steps: FloatArray | None = None) -> Explanation | None:
        """Explain the stripes by chips."""
        return explain(self.stripes, chips, self.cameras, self.gamma, self.fit_gamma, steps)

    def read(self) -> Explanation | None:
        """Read the chips from the stripes, and explain the stripes by them."""
        if self.stripes.period is None:
            return None
        read = read_pattern(self.stripes.profile, self.stripes.flattened, self.stripes.period)
        if read is None:
            return None
        step = len(read.chips) / self.stripes.period
        return self.explained_by(read.chips, step + _NEAR / len(self.stripes.profile))


def _explanation(
    task: _Task, scene: Scene, sent: str, tell: Callable[[float], object]
) -> tuple[Explanation, bool]:
    """Explain the stripes by what the scene sends, or by what is read from them."""
    found = None if sent == "read" else task.explained_by(sent_chips(scene.transmitter))
    tell(0.6)
    was_read = False
    if sent != "scene" and (found is None or found.correlation < _EXPLAINS):
        read = task.read()
        if read is not None and (found is None or read.correlation > found.correlation + _CLEARLY):
            found, was_read = read, True
    if found is None or found.correlation < (_EXPLAINS if was_read else _LEAST):
        raise MatchError(_why_unexplained(task.stripes, sent, found))
    return found, was_read


def _why_unexplained(stripes: Stripes, sent: str, found: Explanation | None) -> str:
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
    return " ".join(sentences)
