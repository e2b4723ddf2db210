"""Hypotheses about what was sent, with chosen figures of their fits."""

from typing import Any

import numpy as np

from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.camera_response import CameraResponse, PixelResponse
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.fit.timing import Timing


def hypothesis(
    chips: np.ndarray | str, timing: Timing, columns: int, *, information: float | None = None,
    was_read: bool = True, read_again: bool = False, **changes: Any,
) -> Hypothesis:  # fmt: skip
    """Return a hypothesis whose fit has some values, and as many bits as leave its information."""
    sent, flat = np.array(list(chips), dtype=np.uint8), np.ones(columns)
    known = {"low": 40.0 * flat, "swing": 100.0 * flat, "profile": flat, "correlation": 0.99,
             "residual": 1.0, "is_possible": True}  # fmt: skip
    fit = StripeFit(timing, np.zeros((4, 4)), **{**known, **changes})
    camera = CameraResponse("light", "none", PixelResponse())
    bits, explanation = 0.0, Explanation(sent, (fit,), camera)
    if information is not None:
        bits = Hypothesis("", explanation, fit, bits, was_read).information - information
    return Hypothesis("what is tried", explanation, fit, bits, was_read, read_again)
