"""Matches for tests of what is shown of one."""

from typing import Any

import numpy as np

import occ_model as occ
from occ_model.results.decoding import Region
from occ_model.results.match import Match, Stripes


def match_with(**changes: Any) -> Match:
    """Return a match of chips at 2 kHz in three columns, with some of its values changed."""
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


def match_of_lamp(duty: float = 0.5, **changes: Any) -> Match:
    """Return such a match of a lamp of 1 kHz, in parts of a fiftieth of its period."""
    on = round(50 * duty)
    scene = occ.Scene().replace(light="lamp", lamp_frequency=1e3, duty=on / 50)
    pulse = "1" * on + "0" * (50 - on)
    values = {"scene": scene, "pattern": pulse, "switching_frequency": 50e3, **changes}
    return match_with(**values)
