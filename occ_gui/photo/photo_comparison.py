"""Comparison of the photo's profile with the simulated one, as both are shown."""

import numpy as np

from occ_gui.photo.photo_part import PhotoPart
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.photo_results import PhotoProfile
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare, enhance_comparison
from occ_model.results.match import Comparison

_LEAST_SWING = 0.5
"""Swing in grey levels below which the simulated columns show no stripes."""


def compared(part: PhotoPart) -> tuple[object, ...]:
    """Return what a comparison follows from."""
    found = (part.compared_stripes, part.why_no_stripes)
    return (part.photo, part.reading, *found, part.placement, part.is_enhanced)


def photo_profile(part: PhotoPart) -> PhotoProfile | None:
    """Place the photo's profile beside the simulated one; None where there are not both."""
    photo, reading, placement = part.photo, part.reading, part.placement
    if photo is None or reading is None:
        return None
    comparison, sentence = None, part.why_no_stripes
    try:
        comparison = _compare(part, reading)
    except MatchError as error:
        sentence = str(error)
    if comparison is not None and float(np.ptp(comparison.simulated)) < _LEAST_SWING:
        # A photo scaled to no swing at all would agree with any simulation.
        comparison, sentence = None, "The simulation has no stripes there to compare."
    raw = photo.profile
    if part.is_enhanced:
        raw = enhance(raw, reading.scene.model.enhancement).astype(np.float64)
    is_outdated = reading.scene != part.scene
    place = placement.column, placement.scale
    return PhotoProfile(comparison, raw, *place, sentence, photo, is_outdated)


def _compare(part: PhotoPart, reading: Reading) -> Comparison | None:
    placement, stripes = part.placement, part.compared_stripes
    if stripes is None:
        return None
    first = placement.column + stripes.region.first_column * placement.scale
    swing = stripes.high - stripes.low
    comparison = compare(stripes.flattened, reading.profile, first, placement.scale, swing)
    if not part.is_enhanced:
        return comparison
    return enhance_comparison(comparison, reading.signal, reading.scene.model.enhancement)
