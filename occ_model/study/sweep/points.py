"""Measure the points of a sweep, here or as a worker's job, and collect them for the table."""

from collections.abc import Iterable
from dataclasses import dataclass
from time import perf_counter
from typing import TypeAlias

import numpy as np

from occ_model.errors import OccError
from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.results.sweep import SweepTable, join_lines
from occ_model.results.sweep_request import RateSettings, SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.success_rate import check_rate, count_right_and_whole

PointValues: TypeAlias = tuple[int, dict[str, ParameterValue]]  # a point's index and varied values


@dataclass(frozen=True, slots=True)
class MeasuredPoints:
    points: tuple[SweepPoint, ...]
    images: int
    seconds: float


def measure_point(
    scene: Scene,
    settings: RateSettings,
    index: int,
    values: dict[str, ParameterValue],
    heartbeat: Heartbeat = lambda: None,
) -> SweepPoint:
    """Measure one point; a refusal of the model or a plug-in's faults become its note."""
    try:
        at = scene.replace(**values)
        check_rate(at, settings)
        with Faults().counting() as faults:
            right, whole = count_right_and_whole(at, settings, heartbeat)
    except OccError as refusal:
        none = (0,) * len(settings.decoders)
        return SweepPoint(index, 0, none, join_lines(str(refusal)), none)
    sent = settings.images * at.transmitter.payload_length
    return SweepPoint(index, sent, right, join_lines(str(faults)), whole)


def measure_points(
    scene: Scene, settings: RateSettings, points: Iterable[PointValues], heartbeat: Heartbeat
) -> MeasuredPoints:
    start = perf_counter()
    found = tuple(
        measure_point(scene, settings, index, values, heartbeat) for index, values in points
    )
    return MeasuredPoints(found, settings.images, perf_counter() - start)


def rate_intervals(point: SweepPoint, images: int) -> list[tuple[float, float]]:
    """Return the 95 % interval of each decoder's rate in percent; NaN without a rate."""
    return [interval_of_pictures(right, point.sent, images) for right in point.right]


class SweepCounts:
    """The counts so far, in a few bytes per point."""

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
