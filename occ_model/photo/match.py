"""Find the scene that explains a photo."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.checks import check_choice
from occ_model.errors import MatchError, ParameterError
from occ_model.photo.explanation import Explanation, explain
from occ_model.photo.fitted_scene import at_the_photo, with_chips, with_levels, with_notes
from occ_model.photo.load import Photo
from occ_model.photo.pattern import read_pattern
from occ_model.photo.stripe_fit import StripeFit
from occ_model.photo.stripes import find_stripes
from occ_model.photo.tone import AVERAGINGS, CameraTone, camera_tones
from occ_model.results import Match, Stripes
from occ_model.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

ESTIMATES = ("readout_time", "switching_frequency")
"""Which of the two is estimated; the other one is known."""

SENT = ("auto", "scene", "read")
"""What is taken as sent: what the scene sends, what is read from the photo, or what fits."""

_EXPLAINS = 0.9
"""Correlation from which what the scene sends is taken as what was sent."""

_LEAST = 0.6
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
    check_choice("sent", sent, SENT)
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
    noted = photo.exposure_time
    fit = explanation.nearest(lambda one: _exposure_time(one, scene, estimate), noted)
    match = _described(photo, scene, estimate, stripes, explanation, fit)
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
        read = read_pattern(self.stripes.evened, self.stripes.period)
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
        if read is not None and (found is None or read.correlation > found.correlation):
            found, was_read = read, True
    if found is None or found.correlation < _LEAST:
        raise MatchError(_why_unexplained(task.stripes, sent, found))
    return found, was_read


def _why_unexplained(stripes: Stripes, sent: str, found: Explanation | None) -> str:
    if sent == "scene":
        if found is None:
            return "What the scene sends never changes: it makes no stripes."
        return (
            "What the scene sends does not explain the stripes: the best correlation is "
            f"{found.correlation:.2f}; at least {_LEAST} is needed."
        )
    if stripes.period is None:
        return (
            "The stripes do not repeat within the panel's image, so that what is sent cannot be "
            "read from them; come closer, raise the frequency, or say what is sent."
        )
    return (
        f"The stripes repeat after {stripes.period:.1f} columns, but no sequence of chips explains "
        "them; say what is sent."
    )


def _exposure_time(fit: StripeFit, scene: Scene, estimate: str) -> float:
    """Give a fit's exposure time in seconds."""
    if estimate == "readout_time":
        return fit.timing.exposure * scene.transmitter.switching_period
    return fit.timing.exposure / fit.timing.step * scene.camera.readout_time


def _described(
    photo: Photo,
    scene: Scene,
    estimate: str,
    stripes: Stripes,
    explanation: Explanation,
    fit: StripeFit,
) -> Match:
    """Put what was found in SI units, and in a scene."""
    timing, region = fit.timing, stripes.region
    if estimate == "readout_time":
        frequency = scene.transmitter.switching_frequency
        readout = timing.step / frequency
    else:
        readout = scene.camera.readout_time
        frequency = timing.step / readout
    scene, turned = with_chips(scene, explanation.chips)
    period = len(explanation.chips)
    first = timing.start(len(stripes.profile)) - timing.step * region.first_column - turned
    try:
        scene = scene.replace(
            readout_time=readout,
            switching_frequency=frequency,
            exposure_time=timing.exposure / frequency,
            start_time=first % period / frequency,
            gamma=timing.gamma,
            averaging=explanation.camera.averaging,
            enhancement=explanation.camera.enhancement,
        )
    except ParameterError as error:
        raise MatchError(f"What explains the stripes cannot be: {error}") from None
    scene = with_levels(at_the_photo(scene, photo, region), fit)
    camera = scene.camera
    return Match(
        scene=scene,
        stripes=replace(stripes, low=fit.low, high=fit.low + fit.swing),
        readout_time=camera.readout_time,
        switching_frequency=frequency,
        exposure_time=camera.exposure_time,
        start_time=scene.model.start_time,
        gamma=camera.gamma,
        uncertainties=_uncertainties(fit, estimate, scene, region.first_column),
        pattern="".join(map(str, sent_chips(scene.transmitter).tolist())),
        pattern_was_read=False,
        profile=fit.profile,
        correlation=fit.correlation,
        other_exposures=tuple(
            _exposure_time(other, scene, estimate) for other in explanation.fits if other is not fit
        ),
    )


def _uncertainties(
    fit: StripeFit, estimate: str, scene: Scene, first_column: int
) -> dict[str, float]:
    """Carry the fit's covariance over to what was estimated, in SI units."""
    timing = fit.timing
    frequency = scene.transmitter.switching_frequency
    # The first column's start in chips, as it depends on step, exposure and middle.
    half = 0.5 * (len(fit.profile) - 1) + first_column
    start = np.array([-half, -0.5, 1.0, 0.0])
    step = np.array([1.0, 0.0, 0.0, 0.0])
    exposure = np.array([0.0, 1.0, 0.0, 0.0])
    if estimate == "readout_time":
        slopes = {
            "readout_time": step / frequency,
            "exposure_time": exposure / frequency,
            "start_time": start / frequency,
        }
    else:
        readout = scene.camera.readout_time
        begin = scene.model.start_time * frequency
        slopes = {
            "switching_frequency": step / readout,
            # In seconds these are chips times t_r / step: they share the step's uncertainty.
            "exposure_time": (exposure - step * (timing.exposure / timing.step)) / frequency,
            "start_time": (start - step * (begin / timing.step)) / frequency,
        }
    if fit.covariance[3, 3] > 0.0:
        slopes["gamma"] = np.array([0.0, 0.0, 0.0, 1.0])
    return {
        name: float(np.sqrt(max(slope @ fit.covariance @ slope, 0.0)))
        for name, slope in slopes.items()
    }
