"""Find the ranges of switching frequency and exposure time in which decoders read a scene.

The searches, see :mod:`occ_model.study.working_range`, are independent: two processes find the same
answer in half the time. All decoders read the same pictures, so one process searches along a
parameter for all of them.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from occ_model.errors import ParameterError, quote
from occ_model.parallel.job import NO_PROCESSES, Heartbeat, Job, JobResult
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
    progress: Callable[[float, str], object] = lambda _fraction, _describe_search: None,
) -> Limits:
    """Find the switching frequencies and the exposure times at which a decoder reads a scene.

    Each answer is a list of intervals, because the success rate need not fall steadily: stripes
    come back beyond a null. Values are scanned in steps of 3.6 %; a gap as wide in which half of
    the pictures are lost is found in 97 of 100 searches. The outermost ends and those of the
    scene's own interval have 95 % intervals, see :mod:`occ_model.study.range_end`, of which the
    limit nearer to the range is stated. Each end rests on images that were not used to choose it.

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
    progress: Callable[[float, str], object] = lambda _fraction, _describe_search: None,
) -> Iterator[Limits]:
    """Yield the limits of several decoders as soon as they are found, as :func:`limits` does."""
    required_rate = check_search(rate, jobs)
    searches = []
    for decoder in settings.decoders:
        decoder_settings = replace(settings, decoders=(decoder,))
        check_rate(scene, decoder_settings)
        searches.append(_DecoderSearch(scene, required_rate, decoder_settings))
    return _SearchRunner(searches, heartbeat, progress).run(jobs)


SEARCHED_PARAMETERS = ("switching_frequency", "exposure_time")
MOST_PROCESSES = 2  # one for each parameter
_POLL_SECONDS = 0.1  # between two polls of other processes


@dataclass(frozen=True, eq=False, slots=True)
class _Task:
    """A search along a parameter."""

    search: "_DecoderSearch"
    name: str  # of the parameter
    arguments: tuple[Scene, str, float, RateSettings]

    @property
    def description(self) -> str:
        return f"{PARAMETERS[self.name].in_sentence}, {self.arguments[3].decoders[0]} decoder"


class _DecoderSearch:
    """What is to be searched for a decoder, and what has been found."""

    def __init__(self, scene: Scene, rate: float, settings: RateSettings) -> None:
        self._scene, self._rate, self._settings = scene, rate, settings
        self.waiting = [
            _Task(self, name, (scene, name, rate, settings)) for name in SEARCHED_PARAMETERS
        ]
        self.ranges: dict[str, WorkingRange] = {}

    def take_next(self, name: str) -> _Task | None:
        """Take a task that waits, best along a parameter."""
        order = [task.name != name for task in self.waiting]
        return self.waiting.pop(order.index(min(order))) if order else None

    def found(self) -> Limits | None:
        """Return the limits if both ranges have been found."""
        if len(self.ranges) < len(SEARCHED_PARAMETERS):
            return None
        settings, ranges = self._settings, (self.ranges[name] for name in SEARCHED_PARAMETERS)
        return Limits(
            self._scene, settings.decoders[0], self._rate, settings.images, settings.seed, *ranges
        )


class _SearchRunner:
    """Runs searches in other processes, or in this one if they cannot be started or die.

    Each process prefers a parameter, so that it simulates the pictures of a search only once for
    all decoders. Decoders are searched in their order.
    """

    def __init__(
        self,
        searches: Sequence[_DecoderSearch],
        heartbeat: Heartbeat,
        progress: Callable[[float, str], object],
    ) -> None:
        self._searches = list(searches)
        self._heartbeat, self._progress = heartbeat, progress
        self._read = 0
        self._expected = sum(
            estimate_range_images(each.arguments[3].images)
            for search in searches
            for each in search.waiting
        )

    def run(self, jobs: int) -> Iterator[Limits]:
        """Yield the limits of each decoder, by so many processes."""
        if jobs > 1:
            from occ_model.parallel.process_pool import ProcessPool

            with suppress(*NO_PROCESSES, *ProcessPool.lost_by), ExitStack() as stack:
                pools = []
                for name in SEARCHED_PARAMETERS:
                    pools.append((ProcessPool(1, __name__), name))
                    stack.callback(pools[-1][0].close)
                yield from self._run_in(pools)
        while (task := self._take_next(SEARCHED_PARAMETERS[0])) is not None:
            beat = partial(self._on_image, task.description)
            task.search.ranges[task.name] = working_range(*task.arguments, beat)
            yield from self._take_found()

    def _run_in(self, pools: "Sequence[tuple[ProcessPool, str]]") -> Iterator[Limits]:
        idle, running = list(pools), dict[Future[JobResult], tuple[_Task, Any]]()
        try:
            while True:
                while idle and (task := self._take_next(idle[0][1])) is not None:
                    pool = idle.pop(0)
                    running[_submit(pool[0], task)] = task, pool
                if not running:
                    return
                done, _ = wait(running, timeout=_POLL_SECONDS, return_when=FIRST_COMPLETED)
                self._read = sum(pool.count_heartbeats(0) for pool, _ in pools)
                self._report(next(iter(running.values()))[0].description)
                for future in done:
                    task, pool = running[future]
                    task.search.ranges[task.name] = _unwrap_result(future.result())
                    del running[future]
                    idle.append(pool)
                yield from self._take_found()
        finally:  # what lost processes have not done
            for task, _ in running.values():
                task.search.waiting.insert(0, task)

    def _take_next(self, name: str) -> _Task | None:
        tasks = (search.take_next(name) for search in self._searches)
        return next((task for task in tasks if task is not None), None)

    def _take_found(self) -> Iterator[Limits]:
        while self._searches and (found := self._searches[0].found()) is not None:
            self._searches.pop(0)
            if not self._searches:
                self._progress(1.0, "")
            yield found

    def _on_image(self, description: str) -> None:
        self._read += 1
        self._report(description)

    def _report(self, description: str) -> None:
        self._heartbeat()
        self._progress(min(self._read / self._expected, 0.99), description)


def _submit(pool: "ProcessPool", task: _Task) -> "Future[JobResult]":
    try:
        return pool.submit(Job(working_range, task.arguments), 0, 1)
    except Exception:
        task.search.waiting.insert(0, task)
        raise


def _unwrap_result(result: JobResult) -> Any:
    if result.error is not None:
        raise result.error
    return result.value


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
