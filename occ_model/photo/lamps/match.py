"""Match every lamp in a photo with a scene."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from occ_model.errors import MatchError, inflect
from occ_model.photo.lamps.find import find_lamps
from occ_model.photo.match import match_photo
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import lamp_profile
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match
from occ_model.scene.scene import Scene

MatchedLamp: TypeAlias = tuple[Lamp, Match | MatchError]

_SEARCH_FRACTION = 0.2  # fraction of the work that finding the lamps takes


def match_lamps(
    photo: Photo,
    scene: Scene,
    *,
    estimate: str = "readout_time",
    sent: str = "auto",
    averaging: str = "auto",
    fit_gamma: bool = False,
    progress: Callable[[float], object] | None = None,
) -> tuple[MatchedLamp, ...]:
    """Match every lamp in a photo with a scene, each by itself.

    Parameters
    ----------
    photo, scene, estimate, sent, averaging, fit_gamma
        As in :func:`occ_model.match_photo`.
    progress
        Called with the fraction of the work that is done. What it raises ends the match.

    Returns
    -------
    tuple of (Lamp, Match or MatchError)
        The lamps in the order of :func:`occ_model.find_lamps`; each with its match, or with why
        there is none.

    Raises
    ------
    ParameterError
        ``estimate``, ``sent`` or ``averaging`` is not one of its words.
    """
    report = progress or (lambda _fraction: None)
    lamps = find_lamps(photo, lambda fraction: report(_SEARCH_FRACTION * fraction))
    matched: list[MatchedLamp] = []
    each = (1.0 - _SEARCH_FRACTION) / max(len(lamps), 1)

    def match(lamp: Lamp, begin: float) -> Match:
        return match_photo(
            photo,
            scene,
            estimate=estimate,
            sent=sent,
            averaging=averaging,
            fit_gamma=fit_gamma,
            region=lamp,
            progress=lambda fraction: report(begin + each * fraction),
        )

    beside = [] if any(lamp.modulated for lamp in lamps) else _other_axis(photo)
    for number, lamp in enumerate(lamps):
        if not lamp.modulated:
            matched.append((lamp, MatchError(_why_no_stripes(photo, lamp), *beside)))
            continue
        try:
            matched.append((lamp, match(lamp, _SEARCH_FRACTION + each * number)))
        except MatchError as error:
            matched.append((lamp, error))
    report(1.0)
    return tuple(matched)


def _why_no_stripes(photo: Photo, lamp: Lamp) -> str:
    """Say what is known of a lamp without stripes: its light may be a single pulse."""
    columns, span = lamp.region.columns, float(np.ptp(lamp_profile(photo, lamp)))
    return (
        f"No stripes were found in it: its {inflect(columns, 'column')} differ by {span:.2g} grey "
        "levels."
    )


def _other_axis(photo: Photo) -> list[str]:
    """Say that lamps blink along the other axis; empty if none does."""
    turned = replace(photo, samples=np.ascontiguousarray(photo.samples.T))
    if not any(lamp.modulated for lamp in find_lamps(turned)):
        return []
    axis = "columns" if photo.turned else "lines"
    return [f"Lamps blink along the other axis: read the photo with {axis} as the scan axis."]
