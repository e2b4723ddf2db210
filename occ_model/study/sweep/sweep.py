"""Measure success rates at all combinations of some parameters' values, point by point."""

from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from time import perf_counter
from typing import Any, TypeAlias

import numpy as np

from occ_model.errors import OccError
from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_csv import TITLE, PointReader, header_text, join_lines, point_text
from occ_model.results.sweep_request import (
    RateSettings,
    SignalPath,
    SweepPoint,
    SweepRequest,
)
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import TOLERANCE, Scene
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.success_rate import check_rate, count_right_and_whole, simulate_ahead
from occ_model.study.sweep.measure import Progress, measure_study
from occ_model.study.sweep.request_check import build_request, decoders_of
from occ_model.study.sweep.workers import StudyWork

PointValues: TypeAlias = tuple[int, dict[str, ParameterValue]]  # a point's index and varied values


@dataclass(frozen=True, slots=True)
class MeasuredPoints:
    points: tuple[SweepPoint, ...]
    images: int
    seconds: float
    first: int = 0  # number of the first image, which the points' counts begin with


def measure_point(
    scene: Scene,
    settings: RateSettings,
    index: int,
    values: dict[str, ParameterValue],
    heartbeat: Heartbeat = lambda: None,
    first: int = 0,
) -> SweepPoint:
    """Measure one point; a refusal of the model or a plug-in's faults become its note."""
    try:
        point_scene = scene.replace(**values)
        check_rate(point_scene, settings)
        with Faults().counting() as faults:
            right, whole = count_right_and_whole(point_scene, settings, heartbeat, first)
    except OccError as refusal:
        no_counts = (0,) * len(settings.decoders)
        return SweepPoint(index, 0, no_counts, join_lines(str(refusal)), no_counts)
    sent_bits = (settings.images - first) * point_scene.transmitter.payload_length
    return SweepPoint(index, sent_bits, right, join_lines(str(faults)), whole)


def measure_points(
    scene: Scene,
    settings: RateSettings,
    points: Iterable[PointValues],
    first: int,
    heartbeat: Heartbeat,
) -> MeasuredPoints:
    """Measure points from the image ``first`` on."""
    start = perf_counter()
    results: list[SweepPoint] = []
    remaining, count = iter(points), max(_IMAGES_AHEAD // (settings.images - first), 1)
    while part := list(islice(remaining, count)):
        if len(part) > 1:
            _simulate_points(scene, settings, [values for _, values in part], first)
        results += [
            measure_point(scene, settings, index, values, heartbeat, first)
            for index, values in part
        ]
    return MeasuredPoints(tuple(results), settings.images, perf_counter() - start, first)


_IMAGES_AHEAD = 100  # images of several points that are simulated at once


def _simulate_points(
    scene: Scene, settings: RateSettings, points: Sequence[dict[str, ParameterValue]], first: int
) -> None:
    """Simulate the images of some points at once; each refusal is left to its own point."""
    with suppress(OccError):
        scenes = [scene.replace(**values) for values in points]
        for one in scenes:
            check_rate(one, settings)
        simulate_ahead(scenes, settings, first, settings.images)


def rate_intervals(point: SweepPoint, images: int) -> list[tuple[float, float]]:
    """Return the 95 % interval of each decoder's rate in percent; NaN without a rate."""
    return [interval_of_pictures(right, point.sent, images) for right in point.right]


class SweepCounts:
    """The counts so far, in a few bytes per point."""

    def __init__(self, request: SweepRequest) -> None:
        self._request = request
        decoders = len(request.settings.decoders)
        self._sent = np.zeros(request.point_count, dtype=np.int64)
        self._right = np.zeros((request.point_count, decoders), dtype=np.int64)
        self._whole = np.zeros((request.point_count, decoders), dtype=np.int64)
        self._ends = np.zeros((request.point_count, decoders, 2))
        self._notes: dict[int, str] = {}

    def add(self, point: SweepPoint) -> None:
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


def sweep(  # noqa: PLR0913 - a study's settings, most of them optional
    scene: Scene,
    axes: Mapping[str, Iterable[ParameterValue]],
    images: int = 5,
    decoder: str | Sequence[str] = PAPER_DECODER,
    seed: int = 1,
    *,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
    results: str | Path | None = None,
    path: SignalPath = "auto",
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    frames_a_second: float = FRAMES_A_SECOND,
) -> SweepTable:
    """Measure the success rate at all combinations of some parameters' values.

    A point's rate is ``success_rate(scene.replace(**point), images, decoder, seed)``. All points
    have the same seed, and therefore start times at the same fractions of a packet.

    Parameters
    ----------
    scene
        The scene, with the values of the parameters that are not varied.
    axes
        The values of each varied parameter, by name and in SI units.
    decoder
        A decoder's name, or several, which read the same images.
    seed
        Seed of the start times and the noise.
    executor, jobs, progress, results
        As for :func:`run_sweep`.
    path, tolerance, force
        As for :func:`occ_model.success_rate`.
    frames_a_second
        Images per second from which the bits per second are computed; limited by the readout.

    Returns
    -------
    SweepTable
        The results in the order of the axes. A point whose scene the model refuses has a note and
        no rate.

    Raises
    ------
    ParameterError, OutputError
        An argument is not allowed, or the results file cannot be used.
    """
    names = decoders_of(decoder)
    settings = RateSettings(images, names, seed, tolerance, force or {}, path, frames_a_second)
    request = build_request(scene, axes, settings)
    return run_sweep(request, executor=executor, jobs=jobs, progress=progress, results=results)


def run_sweep(
    request: SweepRequest,
    *,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
    results: str | Path | None = None,
) -> SweepTable:
    """Measure the points of a sweep's request.

    ``executor``: any executor of ``concurrent.futures`` whose workers can import this package, such
    as ``ProcessPoolExecutor(2)``. If it breaks, this process finishes the sweep and issues a
    ``RuntimeWarning``. Without an executor, ``jobs`` processes are started, at most one per point
    and a few per core, and replaced if they die. With one job, the sweep runs in this process; so
    it does, with a ``RuntimeWarning``, if the system cannot start processes. The calling module
    must not call this when it is imported (``if __name__ == "__main__":``). ``progress``: called
    after each point, and several times a second during a long point, with the points done, all
    points, and the seconds left (NaN at first). An exception from it ends the sweep and is passed
    on. ``results``: a CSV file to which each point is written at once. If it contains a part of
    this same sweep, even of one that was killed, only the remainder is measured; a complete file is
    in the order of the axes.
    """
    counts = SweepCounts(request)
    measure_study(
        work_of(request), _SweepText(request), request.in_order_of_work(), counts.add,
        lambda: counts.table().csv(),
        executor=executor, jobs=jobs, progress=progress, results=results,
    )  # fmt: skip
    return counts.table()


def work_of(request: SweepRequest) -> StudyWork[SweepPoint]:
    def arguments(indices: Iterable[int]) -> tuple[Any, ...]:
        values = tuple((index, request.values(index)) for index in indices)
        return request.scene, request.settings, values, 0

    return StudyWork("sweep", measure_points, arguments)


class _SweepText:
    study_name, title = "sweep", TITLE

    def __init__(self, request: SweepRequest) -> None:
        self._request = request
        self.header, self.point_count = header_text(request), request.point_count
        self.lines_a_point = len(request.settings.decoders)
        self.read = PointReader(request).read

    def text(self, point: SweepPoint) -> str:
        intervals = rate_intervals(point, images=self._request.settings.images)
        return point_text(self._request, point, intervals)
