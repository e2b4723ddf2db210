"""The paper's experiment: the success rate over frequency and distance for each exposure time."""

from collections.abc import Sequence

import numpy as np

from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import RateSettings, SweepRequest
from occ_model.scene.presets import load_preset
from occ_model.study.sweep.request_check import build_request

FREQUENCIES = tuple(2000.0 * step for step in range(1, 11))  # 2 to 20 kHz (II.A)
DISTANCES = tuple(round(0.6 + 0.2 * step, 1) for step in range(8))  # 60 to 200 cm (II.A)
IMAGES = 5  # for each frequency, exposure time and distance (II.A)

DEVICES = {  # the presets of each device, the shorter exposure time first
    "phone": ("phone-68us", "phone-136us"),
    "tablet": ("tablet-61us", "tablet-122us"),
}


def grid_request(
    preset: str, decoders: Sequence[str], images: int = IMAGES, seed: int = 1
) -> SweepRequest:
    """Return the request for a sweep over all frequencies and distances of the experiment."""
    axes = {"switching_frequency": FREQUENCIES, "distance": DISTANCES}
    return build_request(load_preset(preset), axes, RateSettings(images, tuple(decoders), seed))


def find_detection_limit(
    table: SweepTable, decoder: str, readable: float = 60.0
) -> tuple[float | None, float | None]:
    """Find the highest frequency in Hz that is read at some distance, and the next of the grid.

    Detection ceases between them. Either is None if the grid has no such frequency.

    ``readable``: success rate in percent from which a distance counts as read.
    """
    read_indices = np.flatnonzero(table.rates(decoder).max(axis=1) >= readable)
    steps = (None, *FREQUENCIES, None)
    next_index = int(read_indices[-1]) + 1 if read_indices.size else 0
    return steps[next_index], steps[next_index + 1]
