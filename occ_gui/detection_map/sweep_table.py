"""Conversion of the detection map to the table of a sweep, which figures and files use."""

from dataclasses import replace

import numpy as np

from occ_gui.detection_map.map_controller import MapRequest
from occ_gui.detection_map.map_schedule import map_request
from occ_gui.detection_map.rate_map import RateMap
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import SweepPoint
from occ_model.study.sweep.counts import rate_intervals


def table_of(
    rates: RateMap, asked: MapRequest, frames_a_second: float = FRAMES_A_SECOND
) -> SweepTable:
    """Return a complete map as a table; later points do not change it."""
    request = map_request(
        asked.scene, asked.x, asked.y, asked.settings, rates.decoders,
        images=rates.least_images, with_image_effects=asked.with_image_effects,
    )  # fmt: skip
    settings = replace(request.settings, frames_a_second=frames_a_second)
    request = replace(request, settings=settings)
    request_images = rates.least_images
    sent, right = rates.sent.copy(), rates.right.copy()
    ends = np.array(
        [
            rate_intervals(SweepPoint(index, int(bits), tuple(map(int, read))), request_images)
            for index, (bits, read) in enumerate(
                zip(sent.ravel(), right.reshape(sent.size, -1), strict=True)
            )
        ]
    ).reshape(*right.shape, 2)
    return SweepTable(
        request, sent, right, ends[..., 0], ends[..., 1], dict(rates.notes), rates.whole.copy()
    )
