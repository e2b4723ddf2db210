"""Count the bits that a sweep's points read rightly, and make the table of the counts."""

import numpy as np

from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import SweepPoint, SweepRequest
from occ_model.study.confidence import interval_of_pictures


def rate_intervals(point: SweepPoint, images: int) -> list[tuple[float, float]]:
    """Return the 95 % interval of each decoder's rate in percent, not a number without a rate."""
    return [interval_of_pictures(right, point.sent, images) for right in point.right]


class Counts:
    """The counts so far, a few bytes a point."""

    def __init__(self, request: SweepRequest) -> None:
        self._request = request
        decoders = len(request.settings.decoders)
        self._sent = np.zeros(request.points, dtype=np.int64)
        self._right = np.zeros((request.points, decoders), dtype=np.int64)
        self._whole = np.zeros((request.points, decoders), dtype=np.int64)
        self._ends = np.zeros((request.points, decoders, 2))
        self._notes: dict[int, str] = {}

    def enter(self, point: SweepPoint) -> None:
        self._sent[point.index] = point.sent
        self._right[point.index] = point.right
        self._whole[point.index] = point.whole
        self._ends[point.index] = rate_intervals(point, self._request.settings.images)
        if point.note:
            self._notes[point.index] = point.note

    def table(self) -> SweepTable:
        """Make the table, in the order of the axes."""
        shape = self._request.shape
        return SweepTable(
            self._request,
            self._sent.reshape(shape),
            self._right.reshape(*shape, -1),
            self._ends[..., 0].reshape(*shape, -1),
            self._ends[..., 1].reshape(*shape, -1),
            dict(sorted(self._notes.items())),
            self._whole.reshape(*shape, -1),
        )
