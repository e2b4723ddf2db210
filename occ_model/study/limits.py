"""The limits between which decoders read a scene: of switching frequency and exposure time.

Each is searched by itself, see :mod:`occ_model.study.working_range`, and does not depend on the
other: two processes find the same answer in half of the time.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import wait
from contextlib import ExitStack, suppress
from functools import partial
from numbers import Real
from typing import TypeAlias

from occ_model.errors import ParameterError, shown
from occ_model.parallel.job import NO_PROCESSES, Heartbeat, Job, JobResult
from occ_model.receiver.decoders import DECODERS, PAPER_DECODER
from occ_model.results import Limits, RateSettings, SignalPath, WorkingRange
from occ_model.results.sweep_request import MOST_JOBS
from occ_model.scene.argument_checks import check_count
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, check_scene
from occ_model.scene.simulation_settings import TOLERANCE
from occ_model.study.success_rate import check_rate
from occ_model.study.working_range import expected_images, working_range


def limits(  # noqa: PLR0913 - a study's settings, most of them optional
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    rate: float = 99.0,
    images: int = 20,
    seed: int = 1,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: SignalPath = "auto",
    jobs: int = 1,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float, str], object] = lambda _share, _what: None,
) -> Limits:
    """Find the switching frequencies and the exposure times at which a decoder reads a scene.

    Each answer is a list of intervals: success need not fall steadily, and beyond a null stripes
    come back. A gap narrower than a step of ``STEP`` can be missed. The outermost ends and those of
    the scene's own interval are found by bisection, and each end is confirmed by images that have
    not chosen it.

    Parameters
    ----------
    scene
        The scene.
    decoder
        The decoder's name.
    rate
        Success rate in percent from which it counts as reading, above 0.
    images
        Images at each value: the more of them, the narrower the confidence interval of each end.
    seed
        Seed of each value's start times and noise.
    tolerance, force, path
        As for :func:`occ_model.success_rate`. The profile path takes a second, a sample of the rows
        some ten, whole images minutes.
    jobs
        Processes that search, two at most; the answer does not depend on their number.
    heartbeat
        Called before each image, or some times a second while other processes search; what it
        raises ends the search.
    progress
        Called with the share of the search that is done, from 0 to 1, and what is being searched.

    Raises
    ------
    ParameterError
        The rate is not from above 0 to 100 %, or another argument is not allowed.
    ProjectionError
        The scene has no picture.
    """
    (found,) = limits_of(
        scene, (decoder,), rate=rate, images=images, seed=seed, tolerance=tolerance, force=force,
        path=path, jobs=jobs, heartbeat=heartbeat, progress=progress,
    )  # fmt: skip
    return found


def limits_of(  # noqa: PLR0913 - a study's settings, most of them optional
    scene: Scene,
    decoders: Sequence[str] = tuple(DECODERS),
    *,
    rate: float = 99.0,
    images: int = 20,
    seed: int = 1,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: SignalPath = "auto",
    jobs: int = 1,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float, str], object] = lambda _share, _what: None,
    found: Callable[[Limits], object] = lambda _limits: None,
) -> tuple[Limits, ...]:
    """Find the limits of several decoders, as :func:`limits` does for each of them.

    Parameters
    ----------
    scene
        The scene.
    decoders
        Their names, by default all that are built in.
    rate, images, seed, tolerance, force, path, jobs, heartbeat, progress
        As for :func:`limits`.
    found
        Called with the limits of each decoder as soon as they are known.

    Raises
    ------
    ParameterError, ProjectionError
        As by :func:`limits`.
    """
    check_scene(scene)
    wanted = _checked(rate)
    check_count("jobs", jobs, 1, MOST_JOBS)
    asked = []
    for decoder in decoders:
        settings = RateSettings(images, (decoder,), seed, tolerance, force or {}, path)
        check_rate(scene, settings)
        asked += [(scene, name, wanted, settings) for name in SEARCHED]
    ranges: list[WorkingRange] = []
    answers: list[Limits] = []

    def take(working_range: WorkingRange) -> None:
        """Take the ranges in the order in which they are asked for."""
        ranges.append(working_range)
        if len(ranges) % len(SEARCHED) == 0:
            decoder = decoders[len(answers)]
            pair = ranges[-len(SEARCHED) :]
            answers.append(Limits(scene, decoder, wanted, images, seed, *pair))
            found(answers[-1])

    if jobs > 1:
        _search_apart(asked, heartbeat, progress, take)
    for place in range(len(ranges), len(asked)):
        report = partial(_report, progress, place, asked)
        take(working_range(*asked[place], heartbeat, report))
    progress(1.0, "")
    return tuple(answers)


SEARCHED = ("switching_frequency", "exposure_time")
"""The parameters whose limits are searched."""

_LOOK = 0.1
"""Seconds between two looks at what other processes have done."""


def search_along(
    scene: Scene, name: str, rate: float, settings: RateSettings, heartbeat: Heartbeat
) -> WorkingRange:
    """Search along one parameter, as the job of a process."""
    return working_range(scene, name, rate, settings, heartbeat)


_Asked: TypeAlias = tuple[Scene, str, float, RateSettings]


def _search_apart(
    asked: Sequence[_Asked],
    heartbeat: Heartbeat,
    progress: Callable[[float, str], object],
    take: Callable[[WorkingRange], object],
) -> None:
    """Search in two processes; what they cannot do, as where none can be had, is not taken."""
    from occ_model.parallel.process_pool import ProcessPool

    missing: tuple[type[Exception], ...] = (*NO_PROCESSES, *ProcessPool.lost_by)
    with suppress(*missing), ExitStack() as stack:
        workers = ProcessPool(2, __name__)
        stack.callback(workers.close)
        futures = [workers.submit(Job(search_along, each), 0, 1) for each in asked]
        expected = len(asked) * expected_images(asked[0][-1].images)
        for place, future in enumerate(futures):
            while not future.done():
                wait([future], timeout=_LOOK)
                heartbeat()
                progress(min(workers.counted(0) / expected, 0.99), _what(asked[place]))
            take(_value_of(future.result()))


def _value_of(result: JobResult) -> WorkingRange:
    if result.error is not None:
        raise result.error
    found: WorkingRange = result.value
    return found


def _what(asked: _Asked) -> str:
    """Say what is searched."""
    return f"{PARAMETERS[asked[1]].label.lower()}, {asked[-1].decoders[0]} decoder"


def _report(
    progress: Callable[[float, str], object], place: int, asked: Sequence[_Asked], share: float
) -> None:
    progress((place + share) / len(asked), _what(asked[place]))


def _checked(rate: object) -> float:
    number = isinstance(rate, Real) and not isinstance(rate, bool)
    if not number or not 0.0 < rate <= 100.0:  # type: ignore[operator]
        raise ParameterError(f"rate is {shown(rate)} %; allowed: above 0 % to 100 %.")
    return float(rate)  # type: ignore[arg-type]
