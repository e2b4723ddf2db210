"""Stages of a detection map: a coarse map first, then all points, then more images of each."""

from collections.abc import Iterable, Iterator
from itertools import groupby, islice

import numpy as np

from occ_gui.detection_map.rate_map import STRIDES, lattice
from occ_gui.detection_map.worker import rate_settings, theory_fields
from occ_model.arrays import IndexArray
from occ_model.parallel.job import Job, Stage
from occ_model.results.sweep_request import SweepRequest
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.sweep.points import measure_points

SHAPE = (25, 13)
"""Points along both axes: of two processes the first stage takes some 40 ms, all of them under a
second."""

IMAGES = (1, 2, 5)  # images a point, one after the other

COARSE, FINE, SURE = 0, 2, 4
"""Ranks: the first answer, all points, and more images of each. Strips go in between."""

_THEORY_SHAPES = ((7, 5), (17, 9))
"""Points along both axes at which the limits of theory are computed, at first and then."""


def map_request(
    scene: Scene,
    x: str,
    y: str,
    settings: SimulationSettings,
    decoders: tuple[str, ...],
    *,
    images: int = IMAGES[0],
    with_image_effects: bool = True,
) -> SweepRequest:
    axes = {x: lattice(x, SHAPE[0]), y: lattice(y, SHAPE[1])}
    measured = rate_settings(settings, images, decoders, with_image_effects)
    return SweepRequest(scene, axes, measured)


def map_stages(
    requests: tuple[SweepRequest, ...], images: IndexArray, with_theory: bool, slow: bool
) -> Iterator[Stage]:
    """Return the stages of a map.

    ``images``: shape (points along x, points along y): images that were read at each point
    already.
    """
    first, *others = requests
    order = list(first.in_order_of_work())
    done = images.ravel()
    for stride in STRIDES:
        on = _on_lattice(first.shape, stride)
        new = [i for i in order if on[i] and done[i] < first.settings.images]
        done = np.where(on, np.maximum(done, first.settings.images), done)
        jobs = _jobs(first, new, slow)
        coarse = stride == STRIDES[0]
        if with_theory and stride != STRIDES[-1]:
            # Last, so that it occupies a process that has no more points to measure.
            jobs = (*jobs, _theory(first, _THEORY_SHAPES[0 if coarse else 1]))
        # Slow points take too long to be completed for an older request.
        yield Stage(COARSE if coarse else FINE, jobs, uninterruptible=coarse and not slow)
    for request in others:
        new = [i for i in order if done[i] < request.settings.images]
        yield Stage(SURE, _jobs(request, new, slow))


def _theory(request: SweepRequest, shape: tuple[int, int]) -> Job:
    x, y = request.axes
    return Job(theory_fields, (request.scene, x, y, shape))


def _on_lattice(shape: tuple[int, ...], stride: int) -> IndexArray:
    along = [np.arange(n) % stride == 0 for n in shape]
    return np.asarray(np.logical_and.outer(*along).ravel())


def _jobs(request: SweepRequest, indices: list[int], slow: bool) -> tuple[Job, ...]:
    """Make a job of each line of points: along it decoders keep what they have prepared."""
    if slow:
        return tuple(_job(request, (index,)) for index in indices)
    along_y = request.shape[1]
    first, second = islice(request.in_order_of_work(), 2)
    by_x = first // along_y == second // along_y
    lines = groupby(indices, lambda i: i // along_y if by_x else i % along_y)
    return tuple(_job(request, line) for _, line in lines)


def _job(request: SweepRequest, indices: Iterable[int]) -> Job:
    points = tuple((index, request.values(index)) for index in indices)
    return Job(measure_points, (request.scene, request.settings, points))
