"""A detection map as background work: its request, its jobs from coarse to fine, and its table."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import groupby, islice, pairwise

import numpy as np

from occ_gui.detection_map.rate_map import STRIDES, RateMap, make_lattice
from occ_gui.detection_map.worker import compute_theory_fields, make_rate_settings
from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.parallel.job import Job
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import SweepRequest
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.sweep.sweep import SweepCounts, measure_points

SHAPE = (25, 13)
"""Points along both axes."""

IMAGES = (1, 2, 5)  # images of each point, in successive stages

COARSE, FINE, MORE_IMAGES = 0, 2, 4
"""Priorities: first points, all points, more images of each point. Strips come in between."""

_THEORY_SHAPE = (17, 9)  # points along both axes at which theoretical limits are computed


@dataclass(frozen=True, slots=True)
class MapRequest:
    scene: Scene  # with every parameter that the map does not depend on at its default
    x: str
    y: str
    settings: SimulationSettings
    # Whether rows of the picture are simulated if the scene needs it
    with_image_effects: bool = True

    def make_empty_map(self) -> RateMap:
        values = (make_lattice(self.x, SHAPE[0]), make_lattice(self.y, SHAPE[1]))
        camera = self.scene.camera
        readout: list[FloatArray] = [
            np.array(axis_values) if name == "readout_time" else np.array([camera.readout_time])
            for name, axis_values in zip((self.x, self.y), values, strict=True)
        ]
        # Only one of the axes can be the readout time.
        times = readout[0][:, None] * readout[1] / camera.readout_time * camera.columns
        return RateMap(self.x, self.y, *values, QUICK_DECODERS, times, IMAGES[-1])

    def make_sweep(self, images: int, decoders: tuple[str, ...] = QUICK_DECODERS) -> SweepRequest:
        axes = {self.x: make_lattice(self.x, SHAPE[0]), self.y: make_lattice(self.y, SHAPE[1])}
        settings = make_rate_settings(self.settings, images, decoders, self.with_image_effects)
        return SweepRequest(self.scene, axes, settings)

    def jobs(self, images: IndexArray, with_theory: bool) -> Iterator[Job]:
        """Yield the remaining jobs of a map.

        ``images``: the number of images read so far at each point, shape (along x, along y).
        """
        requests = tuple(map(self.make_sweep, IMAGES))
        first, order = requests[0], list(requests[0].in_order_of_work())
        image_counts = images.ravel().copy()
        for stride in STRIDES:
            is_new = _find_lattice_points(SHAPE, stride) & (image_counts == 0)
            image_counts[is_new] = first.settings.images
            is_coarse = stride == STRIDES[0]
            jobs = _make_jobs(first, [i for i in order if is_new[i]], 0)
            if with_theory and is_coarse:
                # Last, so that it runs in a process that has no more points to measure.
                jobs.append(Job(compute_theory_fields, (self.scene, self.x, self.y, _THEORY_SHAPE)))
            for job in jobs:
                yield replace(job, rank=COARSE if is_coarse else FINE, uninterruptible=is_coarse)
        for known, request in pairwise(requests):
            is_new = image_counts == known.settings.images
            image_counts[is_new] = request.settings.images
            for job in _make_jobs(request, [i for i in order if is_new[i]], known.settings.images):
                yield replace(job, rank=MORE_IMAGES)


def make_table(
    rates: RateMap, map_request: MapRequest, frames_a_second: float = FRAMES_A_SECOND
) -> SweepTable:
    """Return a complete map as a table, a copy that later points do not change."""
    request = map_request.make_sweep(rates.least_images, rates.decoders)
    settings = replace(request.settings, frames_a_second=frames_a_second)
    counts = SweepCounts(replace(request, settings=settings))
    for index in range(request.point_count):
        counts.add(rates.point(index))
    return counts.table()


def _find_lattice_points(shape: tuple[int, ...], stride: int) -> BoolArray:
    on_axes = [np.arange(n) % stride == 0 for n in shape]
    return np.asarray(np.logical_and.outer(*on_axes).ravel())


def _make_jobs(request: SweepRequest, indices: list[int], first: int) -> list[Job]:
    """Make a job of each line of points, whose pictures are simulated at once."""
    y_count = request.shape[1]
    start, second = islice(request.in_order_of_work(), 2)
    is_x_constant = start // y_count == second // y_count
    lines = groupby(indices, lambda i: i // y_count if is_x_constant else i % y_count)
    points = (tuple((index, request.values(index)) for index in line) for _, line in lines)
    return [Job(measure_points, (request.scene, request.settings, each, first)) for each in points]
