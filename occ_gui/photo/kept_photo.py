"""Kept photo: an open photo with all that is known of it, to be shown again after another one."""

from collections.abc import Mapping
from dataclasses import dataclass

from occ_gui.photo.match_choice import MatchChoice
from occ_gui.photo.photo_controller import PhotoReading
from occ_gui.picture.placement import Placement
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match


@dataclass(frozen=True, slots=True)
class KeptRegion:
    """The lamps that were found in a photo, and what of it is matched.

    Parameters
    ----------
    lamps
        The lamps.
    chosen
        The place of the lamp that is matched; None where none is chosen.
    by_hand
        The rectangle that is matched; None where none is drawn.
    """

    lamps: tuple[Lamp, ...] = ()
    chosen: int | None = None
    by_hand: Region | None = None


@dataclass(frozen=True, slots=True)
class KeptMatch:
    """A match, and what it was made of.

    Parameters
    ----------
    match
        The match.
    region
        What of the photo was matched; None for all of it.
    """

    match: Match
    region: Lamp | Region | None


@dataclass(frozen=True, eq=False, slots=True)
class KeptPhoto:
    """An open photo, with its match and the choices that belong to it.

    Parameters
    ----------
    photo, reading
        The photo, and how it was read.
    region, match
        What of it is matched, and what was found; None before a match.
    given
        The value in SI units of the known parameter in the scene when the match was made.
    choice, certain
        The choices of the form, and the known values that the user has confirmed, in SI units by
        name.
    placement
        Where the user has placed it on the picture; None where it lies by itself.
    """

    photo: Photo
    reading: PhotoReading
    region: KeptRegion
    match: KeptMatch | None
    given: float
    choice: MatchChoice
    certain: Mapping[str, float]
    placement: Placement | None
