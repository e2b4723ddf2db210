"""Find the ranges of switching frequency and exposure time in which decoders read a scene.

The searches, see :mod:`occ_model.study.working_range`, are independent: two processes find the same
answer in about half the time.
"""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, wait
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, cast

from occ_model.errors import ParameterError, quote
from occ_model.parallel.job import Heartbeat, Job, JobResult
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.limits import Advice, Limits, TheoryLimits, WorkingRange
from occ_model.results.sweep_request import RateSettings, SignalPath
from occ_model.scene.argument_checks import check_count, is_number
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import TOLERANCE, Scene, SimulationSettings
from occ_model.study import theory
from occ_model.study.cause.cause import cause_of
from occ_model.study.cause.suspects import reads_two_headers
from occ_model.study.success_rate import check_rate
from occ_model.study.working_range import READ_RATE, estimate_range_images, working_range

if TYPE_CHECKING:
    from occ_model.parallel.process_pool import ProcessPool


def limits(  # noqa: PLR0913 - a study's settings, most of them optional
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    rate: float = READ_RATE,
    images: int = 20,
    seed: int = 1,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: SignalPath = "auto",
    jobs: int = 1,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float, str], object] = lambda _fraction, _search: None,
) -> Limits:
    """Find the switching frequencies and the exposure times at which a decoder reads a scene.

    Each answer is a list of intervals, because the success rate need not fall steadily: stripes
    come back beyond a null. Values are scanned in steps of 3.6 %; a gap of this width in which
    half of the pictures are lost is found in 97 of 100 searches. The outermost ends and those of
    the scene's own interval have 95 % confidence limits, see :mod:`occ_model.study.range_end`; the
    one nearer to the range is stated. Each end rests on images that were not used to choose it.

    Parameters
    ----------
    decoder
        The decoder's name.
    rate
        Smallest success rate in percent at which the scene counts as read; above 0.
    images
        Images at each value; more of them narrow the confidence interval of each end.
    seed
        Seed of each value's start times and noise.
    tolerance, force, path
        As for :func:`occ_model.success_rate`. With whole images a search takes many times as
        long.
    jobs
        Number of processes, two at most; the answer does not depend on it.
    heartbeat
        Called for each image, or several times a second while other processes search; an
        exception from it ends the search.
    progress
        Called with the completed fraction of the search, from 0 to 1, and what is being searched.

    Raises
    ------
    ParameterError
        The rate is not from above 0 to 100 %, another argument is not allowed, or no code is sent.
    ProjectionError
        The scene has no picture.
    """
    settings = RateSettings(images, (decoder,), seed, tolerance, force or {}, path)
    (result,) = limits_of(scene, settings, rate, jobs=jobs, heartbeat=heartbeat, progress=progress)
    return result


def limits_of(
    scene: Scene,
    settings: RateSettings,
    rate: float,
    *,
    jobs: int = 1,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float, str], object] = lambda _fraction, _search: None,
) -> Iterator[Limits]:
    """Yield the limits of several decoders as soon as they are found, as :func:`limits` does."""
    required_rate = check_search(rate, jobs)
    check_rate(scene, settings)
    return _SearchRunner(scene, required_rate, settings, heartbeat, progress).run(jobs)


SEARCHED_PARAMETERS = ("switching_frequency", "exposure_time")
MOST_PROCESSES = 2  # one for each parameter
_POLL_SECONDS = 0.1  # between two polls of other processes


class _SearchRunner:
    """Runs searches in other processes, or in this one if they cannot be started or die.

    Each process searches along one parameter for all decoders in their order, so that it simulates
    the pictures only once.
    """

    def __init__(
        self,
        scene: Scene,
        rate: float,
        settings: RateSettings,
        heartbeat: Heartbeat,
        progress: Callable[[float, str], object],
    ) -> None:
        self._scene, self._rate, self._settings = scene, rate, settings
        self._heartbeat, self._progress = heartbeat, progress
        self._pools: dict[str, ProcessPool] = {}  # by parameter
        self._futures: dict[tuple[str, str], Future[JobResult]] = {}  # by parameter and decoder
        self._read_here = 0  # images that this process has read
        searches = len(SEARCHED_PARAMETERS) * len(settings.decoders)
        self._expected = searches * estimate_range_images(settings.images)

    def run(self, jobs: int) -> Iterator[Limits]:
        """Yield the limits of each decoder, by so many processes."""
        settings = self._settings
        with ExitStack() as stack:
            if jobs > 1:
                self._start_processes(stack)
            for decoder in settings.decoders:
                ranges = [self._find(name, decoder) for name in SEARCHED_PARAMETERS]
                if decoder == settings.decoders[-1]:
                    self._progress(1.0, "")
                yield Limits(
                    self._scene, decoder, self._rate, settings.images, settings.seed, *ranges
                )

    def _start_processes(self, stack: ExitStack) -> None:
        from occ_model.parallel.process_pool import ProcessPool

        with suppress(*ProcessPool.lost_by):
            for name in SEARCHED_PARAMETERS:
                self._pools[name] = pool = ProcessPool(1, __name__)
                stack.callback(pool.close)
                for decoder in self._settings.decoders:
                    job = Job(working_range, self._arguments(name, decoder))
                    self._futures[name, decoder] = pool.submit(job, 0, 1)

    def _arguments(self, name: str, decoder: str) -> tuple[Scene, str, float, RateSettings]:
        return self._scene, name, self._rate, replace(self._settings, decoders=(decoder,))

    def _find(self, name: str, decoder: str) -> WorkingRange:
        """Wait for the process that searches along a parameter, or search in this one."""
        description = f"{PARAMETERS[name].in_sentence}, {decoder} decoder"
        future = self._futures.get((name, decoder))
        while future is not None:
            wait([future], timeout=_POLL_SECONDS)
            self._report(description)
            if future.done():
                try:
                    result = future.result()
                except self._pools[name].lost_by:
                    break
                if result.error is not None:
                    raise result.error
                return cast("WorkingRange", result.value)
        return working_range(
            *self._arguments(name, decoder), partial(self._read_image, description)
        )

    def _read_image(self, description: str) -> None:
        self._read_here += 1
        self._report(description)

    def _report(self, description: str) -> None:
        self._heartbeat()
        read = self._read_here + sum(pool.count_heartbeats(0) for pool in self._pools.values())
        self._progress(min(read / self._expected, 0.99), description)


def check_search(rate: object, jobs: object) -> float:
    """Return the rate that counts as read; raise ParameterError if it or ``jobs`` is refused."""
    check_count("jobs", jobs, 1, MOST_PROCESSES)
    if not is_number(rate) or not 0.0 < rate <= 100.0:
        raise ParameterError.of("rate", f"{quote(rate)} %", "above 0 % to 100 %")
    return float(rate)


def advice_of(limits: Limits) -> Advice:
    """Return the limits found by simulation and by theory, and why the scene itself is not read."""
    scene, period = limits.scene, limits.scene.transmitter.switching_period
    reads_two = reads_two_headers(scene, limits.decoder)
    frequencies = TheoryLimits(
        band_model=theory.band_model_frequency(scene),
        null=theory.null_frequency(scene),
        two_packets=theory.two_packets_frequency(scene) if reads_two else None,
    )
    exposures = TheoryLimits(
        band_model=period, null=2.0 * period, saturation=theory.saturation_exposure(scene)
    )
    cause = None
    if limits.frequency.own.rate < limits.rate:
        cause = cause_of(scene, limits.decoder, SimulationSettings(seed=limits.seed))
    return Advice(limits, frequencies, exposures, "" if cause is None else str(cause))
