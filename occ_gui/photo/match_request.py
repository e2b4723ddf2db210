"""Request for a match of a photo, built from the user's choices, and the work that answers it."""

from dataclasses import dataclass

import occ_model as occ
from occ_gui.background.task import Report
from occ_gui.photo.match_choice import MatchChoice
from occ_model.errors import MatchError
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match
from occ_model.scene.scene import Scene
from occ_model.scene.square_wave import blinking


@dataclass(frozen=True, eq=False, slots=True)
class MatchRequest:
    """The arguments of a match in the background."""

    photo: Photo
    scene: Scene
    estimate: str
    sent: str
    fit_gamma: bool
    region: Lamp | Region | None = None


@dataclass(frozen=True, slots=True)
class Refusal:
    """No scene explains the photo's stripes: the reasons, each a sentence."""

    reasons: tuple[str, ...]


def request_of(
    photo: Photo, scene: Scene, choice: MatchChoice, region: Lamp | Region | None = None
) -> MatchRequest:
    """Build the request for a match from the user's choices.

    Raises
    ------
    ParameterError
        The frequency of the square wave is out of range.
    """
    scene, sent = known_scene(scene, choice)
    return MatchRequest(photo, scene, choice.estimate, sent, choice.fit_gamma, region)


def known_scene(scene: Scene, choice: MatchChoice) -> tuple[Scene, str]:
    """Give the scene with what the user knows, and where the sent pattern is taken from.

    Raises
    ------
    ParameterError
        The frequency of the square wave is out of range.
    """
    if choice.sent != "square":
        return scene, choice.sent
    return blinking(scene, choice.square_frequency), "scene"


def match(request: MatchRequest, report: Report) -> Match | Refusal:
    """Match a photo."""
    report(0.0)
    try:
        return occ.match_photo(  # imported now: the window starts sooner without it
            request.photo,
            request.scene,
            estimate=request.estimate,
            sent=request.sent,
            fit_gamma=request.fit_gamma,
            region=request.region,
            progress=report,
        )
    except MatchError as error:
        return Refusal(error.reasons)
