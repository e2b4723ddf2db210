"""Points of a sweep: measured one after the other, in this process or as a worker's job."""

from collections.abc import Generator, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import TypeAlias

from occ_model.errors import OccError
from occ_model.parallel.job import Heartbeat, Job
from occ_model.results.sweep_csv import one_line
from occ_model.results.sweep_request import RateSettings, SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import check_rate, right_and_whole

PointValues: TypeAlias = tuple[int, dict[str, ParameterValue]]  # a point's index and varied values


@dataclass(frozen=True, slots=True)
class MeasuredPoints:
    """Points that were measured together."""

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
    """Measure one point; an error of the model becomes the point's note."""
    try:
        at = scene.replace(**values)
        check_rate(at, settings)
        right, whole = right_and_whole(at, settings, heartbeat)
    except OccError as refusal:
        none = (0,) * len(settings.decoders)
        return SweepPoint(index, 0, none, one_line(str(refusal)), none)
    return SweepPoint(index, settings.images * at.transmitter.payload_length, right, "", whole)


def measure_points(
    scene: Scene, settings: RateSettings, points: Iterable[PointValues], heartbeat: Heartbeat
) -> MeasuredPoints:
    start = perf_counter()
    found = tuple(
        measure_point(scene, settings, index, values, heartbeat) for index, values in points
    )
    return MeasuredPoints(found, settings.images, perf_counter() - start)


class SweepWork:
    """The points of a sweep as jobs of workers."""

    what, module = "sweep", __name__

    def __init__(self, request: SweepRequest) -> None:
        self._request = request

    def job(self, indices: Sequence[int]) -> Job:
        points = tuple((index, self._request.values(index)) for index in indices)
        return Job(measure_points, (self._request.scene, self._request.settings, points))

    def here(
        self, indices: Iterable[int], heartbeat: Heartbeat
    ) -> Generator[SweepPoint, None, None]:
        """Measure points in this process."""
        request = self._request
        for index in indices:
            values = request.values(index)
            yield measure_point(request.scene, request.settings, index, values, heartbeat)
