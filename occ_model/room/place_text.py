"""A camera's place in words, with the digits that its errors allow."""

import math
from collections.abc import Iterable

import numpy as np

from occ_model.room.pose_fit import Located
from occ_model.room.room import Place

AXES = tuple(Place.__dataclass_fields__)
"""The coordinates of a place and the angles of its camera, in the order of their errors."""

POSITION, ANGLES = AXES[:3], AXES[3:]


def format_place(place: Place, located: Located | None = None, axes: Iterable[str] = AXES) -> str:
    """Format a place, with the standard errors of the one that was found."""
    texts = []
    errors = np.zeros(len(AXES)) if located is None else located.errors
    for name, error in zip(AXES, errors.tolist(), strict=True):
        if name not in axes:
            continue
        value = getattr(place, name)
        scale, unit, digits = (1.0, "m", 4) if name in POSITION else (180.0 / math.pi, "°", 2)
        if error:  # show two digits of it
            digits = max(digits, 1 - math.floor(math.log10(error * scale)))
        error_text = f" ± {error * scale:.{digits}f}" if located else ""
        rounded = round(value * scale, digits) + 0.0  # no -0
        texts.append(f"{name} {rounded:.{digits}f}{error_text} {unit}")
    return ", ".join(texts)
