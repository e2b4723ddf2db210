"""Light of slow LED edges, against rational arithmetic."""

import math
from fractions import Fraction
from itertools import product

from each_case import each_case
from hypothesis import strategies as st

from hard_cases.laws import cases, record
from hard_cases.references import PATTERNS, STARTS, ExactTimes, decades, some_columns, within
from occ_model.effects.light_effects import lit_fraction_with_edges
from occ_model.scene.scene import Scene

LONG = ["1" * 2048 + "0" * 2048, "10" * 2048, "1" + "0" * 4095, ("1" * 63 + "0") * 64]
"""Patterns with the most chips: slow, fast, rarely lit, rarely dark."""

FREQUENCY = 1e6

EDGED = "lit fraction with LED edges"
WIDE = "edges 1e-300 to 1e6 chips, t 1e-3 to 1e6, packets to 4096 chips"


def edged_scene(edge: float, exposure: float, **changes: float | str) -> Scene:
    """Make a scene with times in chips."""
    return Scene().replace(
        edge_time=within("edge_time", edge / FREQUENCY),
        exposure_time=within("exposure_time", exposure / FREQUENCY), switching_frequency=FREQUENCY,
        readout_time=0.737e-6, columns=300,
    ).replace(**changes)  # fmt: skip


def edge_error(scene: Scene) -> float:
    """Return the largest error of a column's lit fraction against rational arithmetic."""
    exact, found = ExactTimes(scene), lit_fraction_with_edges(scene)
    assert 0.0 <= found.min() <= found.max() <= 1.0
    columns = some_columns(scene)
    return max(
        float(abs(Fraction(float(found[column])) - exact.edged_fraction(column)))
        for column in columns
    )


@cases(
    edge=st.one_of(
        decades(1e-12, 1e6), decades(1e-300, 1e-12), st.integers(1, 4800).map(float)
    ),
    exposure=decades(1e-3, 1e6), start=STARTS, readout=decades(1e-9, 10.0), pattern=PATTERNS,
)  # fmt: skip
def test_edged_light_is_that_of_rational_arithmetic(
    edge: float, exposure: float, start: float, readout: float, pattern: str
) -> None:
    scene = edged_scene(edge, exposure, start_time=start, readout_time=readout, pattern=pattern)
    error = edge_error(scene)
    record(EDGED, WIDE, error, 1e-12)


EDGES: dict[str, dict[str, float | str]] = {
    # Windows of 1/1000 of a chip, on sums that oscillate by a million chips^2.
    "a slow pattern of 4096 chips": {"edge_time": 5.5e-6, "exposure_time": 1e-9,
                                     "pattern": LONG[0]},
    # Light goes up and down a thousand times during the edge, so that 1 part in 1000 is left.
    "a fast pattern of 4096 chips": {"edge_time": 999.5e-6, "exposure_time": 1e-9,
                                     "pattern": LONG[1]},
    # An edge of whole packets leaves exactly no stripes: two equal windows cancel.
    "whole packets": {"switching_frequency": 2.0**20, "edge_time": 24 * 2.0**-20},
    # One ulp more than that: the windows differ by an ulp only.
    "whole packets and an ulp": {
        "switching_frequency": 2.0**20, "edge_time": math.nextafter(24 * 2.0**-20, 1)},
    # At one chip exactly the closed form changes.
    "one chip": {"switching_frequency": 2.0**20, "edge_time": 2.0**-20},
    # Just below one chip, where the ramps nearly meet.
    "one chip less an ulp": {
        "switching_frequency": 2.0**20, "edge_time": math.nextafter(2.0**-20, 0)},
    # A billion chips in one edge, a billion seconds from time zero.
    "a second at 1 GHz": {
        "switching_frequency": 1e9, "edge_time": 1.0, "exposure_time": 1e-9, "start_time": 1e9},
    # Edge and exposure are equal averages, which together give a triangle.
    "an edge as long as the exposure": {"edge_time": 7.3e-6, "exposure_time": 7.3e-6},
    # So short that its square underflows.
    "the smallest number there is": {"edge_time": 5e-324},
}  # fmt: skip


@each_case(product(EDGES, (0.0, 1e9 - 1 / 7)))
def test_edged_light_of_hard_scenes_is_that_of_exact_arithmetic(name: str, start: float) -> None:
    scene = edged_scene(0.0, 1.7, **({"start_time": start} | EDGES[name]))
    error = edge_error(scene)
    record(EDGED, WIDE, error, 1e-12)
