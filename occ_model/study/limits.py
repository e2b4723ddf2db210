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
    check_rate(scene, settings)
    return _SearchRunner(scene, required_rate, settings, heartbeat, progress).run(jobs)


SEARCHED_PARAMETERS = ("switching_frequency", "exposure_time")
MOST_PROCESSES = 2  # one for each parameter
_POLL_SECONDS = 0.1  # between two polls of other processes


@dataclass(frozen=True, slots=True)
class _Search:
    """A search along a parameter for one decoder."""

    name: str  # of the parameter
    decoder: str

    @property
    def description(self) -> str:
        return f"{PARAMETERS[self.name].in_sentence}, {self.decoder} decoder"


class _SearchRunner:
    """Runs searches in other processes, or in this one if they cannot be started or die.

    Each process prefers a parameter, so that it simulates the pictures of a search only once for
    all decoders. Decoders are searched in their order.
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
        self._waiting = [
            _Search(name, decoder) for decoder in settings.decoders for name in SEARCHED_PARAMETERS
        ]
        self._decoders = list(settings.decoders)  # whose limits are not complete
        self._ranges: dict[_Search, WorkingRange] = {}
        self._read = 0
        self._expected = len(self._waiting) * estimate_range_images(settings.images)

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
        while (search := self._take_next(SEARCHED_PARAMETERS[0])) is not None:
            beat = partial(self._on_image, search.description)
            self._ranges[search] = working_range(*self._arguments(search), beat)
            yield from self._take_found()

    def _run_in(self, pools: "Sequence[tuple[ProcessPool, str]]") -> Iterator[Limits]:
        idle, running = list(pools), dict[Future[JobResult], tuple[_Search, Any]]()
        try:
            while True:
                while idle and (search := self._take_next(idle[0][1])) is not None:
                    pool = idle.pop(0)
                    running[self._submit(pool[0], search)] = search, pool
                if not running:
                    return
                done, _ = wait(running, timeout=_POLL_SECONDS, return_when=FIRST_COMPLETED)
                self._read = sum(pool.count_heartbeats(0) for pool, _ in pools)
                self._report(next(iter(running.values()))[0].description)
                for future in done:
                    search, pool = running[future]
                    self._ranges[search] = _unwrap_result(future.result())
                    del running[future]
                    idle.append(pool)
                yield from self._take_found()
        finally:  # what lost processes have not done
            self._waiting[:0] = [search for search, _ in running.values()]

    def _arguments(self, search: _Search) -> tuple[Scene, str, float, RateSettings]:
        settings = replace(self._settings, decoders=(search.decoder,))
        return self._scene, search.name, self._rate, settings

    def _submit(self, pool: "ProcessPool", search: _Search) -> "Future[JobResult]":
        try:
            return pool.submit(Job(working_range, self._arguments(search)), 0, 1)
        except Exception:
            self._waiting.insert(0, search)
            raise

    def _take_next(self, name: str) -> _Search | None:
        """Take a search of the first decoder in the queue, if possible along this parameter."""
        if not self._waiting:
            return None
        wanted = _Search(name, self._waiting[0].decoder)
        return self._waiting.pop(self._waiting.index(wanted) if wanted in self._waiting else 0)

    def _take_found(self) -> Iterator[Limits]:
        settings = self._settings
        while self._decoders:
            searches = [_Search(name, self._decoders[0]) for name in SEARCHED_PARAMETERS]
            if not self._ranges.keys() >= {*searches}:
                return
            decoder, ranges = self._decoders.pop(0), (self._ranges[search] for search in searches)
            if not self._decoders:
                self._progress(1.0, "")
            yield Limits(self._scene, decoder, self._rate, settings.images, settings.seed, *ranges)

    def _on_image(self, description: str) -> None:
        self._read += 1
        self._report(description)

    def _report(self, description: str) -> None:
        self._heartbeat()
        self._progress(min(self._read / self._expected, 0.99), description)


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
