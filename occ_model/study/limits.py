"""The limits between which a decoder reads a scene: of switching frequency and exposure time.

Each is searched by itself, see :mod:`occ_model.study.working_range`, and does not depend on the
other: two processes find the same answer in half of the time.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import wait
from functools import partial
from numbers import Real

from occ_model.errors import ParameterError, shown
from occ_model.parallel.job import NO_PROCESSES, Heartbeat, Job, JobResult
from occ_model.receiver.decoders import PAPER_DECODER
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

    Each answer is the interval that holds the scene's own value, or else the nearest by ratio. Its
    ends are found by bisection; a gap narrower than a step of ``STEP`` can be missed.

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
    check_scene(scene)
    settings = RateSettings(images, (decoder,), seed, tolerance, force or {}, path)
    check_rate(scene, settings)
    wanted = _checked(rate)
    check_count("jobs", jobs, 1, MOST_JOBS)
    found = None
    if jobs > 1:
        found = _search_apart(scene, wanted, settings, heartbeat, progress)
    if found is None:
        found = [
            working_range(
                scene, name, wanted, settings, heartbeat, partial(_report, progress, place)
            )
            for place, name in enumerate(SEARCHED)
        ]
    frequency, exposure = found
    progress(1.0, "")
    return Limits(scene, decoder, wanted, images, seed, frequency, exposure)


SEARCHED = ("switching_frequency", "exposure_time")
"""The parameters whose limits are searched."""

_LOOK = 0.1
"""Seconds between two looks at what other processes have done."""


def search_along(
    scene: Scene, name: str, rate: float, settings: RateSettings, heartbeat: Heartbeat
) -> WorkingRange:
    """Search along one parameter, as the job of a process."""
    return working_range(scene, name, rate, settings, heartbeat)


def _search_apart(
    scene: Scene,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat,
    progress: Callable[[float, str], object],
) -> list[WorkingRange] | None:
    """Search in a process for each parameter; None where processes cannot be had."""
    from occ_model.parallel.process_pool import ProcessPool

    missing: tuple[type[Exception], ...] = (*NO_PROCESSES, *ProcessPool.lost_by)
    workers = None
    try:
        workers = ProcessPool(len(SEARCHED), __name__)
        futures = []
        for counter, name in enumerate(SEARCHED):
            job = Job(search_along, (scene, name, rate, settings), counter)
            futures.append(workers.submit(job, 0, 1))
        expected = len(SEARCHED) * expected_images(settings.images)
        while wait(futures, timeout=_LOOK).not_done:
            heartbeat()
            read = sum(workers.counted(counter) for counter in range(len(SEARCHED)))
            progress(min(read / expected, 0.99), _BOTH)
        return [_value_of(future.result()) for future in futures]
    except missing:
        return None
    finally:
        if workers is not None:
            workers.close()


def _value_of(result: JobResult) -> WorkingRange:
    if result.error is not None:
        raise result.error
    found: WorkingRange = result.value
    return found


_BOTH = " and ".join(PARAMETERS[name].label.lower() for name in SEARCHED)


def _report(progress: Callable[[float, str], object], place: int, share: float) -> None:
    label = PARAMETERS[SEARCHED[place]].label.lower()
    progress((place + share) / len(SEARCHED), label)


def _checked(rate: object) -> float:
    number = isinstance(rate, Real) and not isinstance(rate, bool)
    if not number or not 0.0 < rate <= 100.0:  # type: ignore[operator]
        raise ParameterError(f"rate is {shown(rate)} %; allowed: above 0 % to 100 %.")
    return float(rate)  # type: ignore[arg-type]
