"""Matches for tests of what is shown of one."""

from typing import Any

import numpy as np

import occ_model as occ
from occ_model.results.decoding import Region
from occ_model.results.match import Match, Stripes


def match_with(**changes: Any) -> Match:
    """Return a match of a lamp of 2 kHz in three columns, with some of its values changed."""
    profile = np.array([10.0, 20.0, 30.0])
    stripes = Stripes(Region(0, 9, 0, 3), profile, profile, profile + 1, 2.0, 0.1, 0.125)
    values: dict[str, Any] = {
        "scene": occ.Scene(), "stripes": stripes, "readout_time": 14.5777e-6,
        "switching_frequency": 2e3, "exposure_time": 62.5e-6, "start_time": 1e-4, "gamma": 2.22,
        "uncertainties": {"readout_time": 2.7e-10, "exposure_time": 2.1e-7, "start_time": 3e-7},
        "pattern": "1010", "pattern_was_read": True, "profile": profile + 2.0,
        "correlation": 0.99123,
    }  # fmt: skip
    return Match(**{**values, **changes})
