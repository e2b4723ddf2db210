"""Find the ranges of switching frequency and exposure time in which decoders read a scene.

The two searches, see :mod:`occ_model.study.working_range`, are independent: two processes find the
same answer in half the time. All decoders read the same pictures, so one process searches along a
parameter for all of them.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import wait
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial
from itertools import cycle, islice
from typing import TYPE_CHECKING, Any, TypeVar

from occ_model.errors import ParameterError, quote
from occ_model.parallel.job import NO_PROCESSES, Heartbeat, Job, JobResult
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.limits import Advice, Limits, TheoryLimits
from occ_model.results.sweep_request import RateSettings, SignalPath
from occ_model.scene.argument_checks import check_count, is_number
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import TOLERANCE, Scene, SimulationSettings
from occ_model.study import theory
from occ_model.study.cause.cause import cause_of
from occ_model.study.cause.suspects import reads_two_headers
from occ_model.study.success_rate import check_rate
from occ_model.study.sure_ends import confirm_end, estimate_end_images, pair_ends, replace_ends
from occ_model.study.working_range import READ_RATE, estimate_range_images, working_range

if TYPE_CHECKING:
    from occ_model.parallel.process_pool import ProcessPool

_Result = TypeVar("_Result")


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
    scene's own interval are found by bisection, and each end is confirmed with images that were not
    used to find it. A bisected end has a 95 % interval, see
    :mod:`occ_model.study.sure_ends`.

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
) -> tuple[Limits, ...]:
    """Find the limits of several decoders, as :func:`limits` does for each of them."""
    required_rate = check_search(rate, jobs)
    searches = []
    for decoder in settings.decoders:
        decoder_settings = replace(settings, decoders=(decoder,))
        check_rate(scene, decoder_settings)
        searches += [(scene, name, required_rate, decoder_settings) for name in SEARCHED_PARAMETERS]
    image_count = len(searches) * estimate_images(settings.images, required_rate)
    with ExitStack() as stack:
        runner = _SearchRunner(stack, jobs, image_count, heartbeat, progress)
        searched_ranges = list(runner.run(working_range, searches, (1,) * len(SEARCHED_PARAMETERS)))
        pairs = [
            (search, pair_ends(each))
            for search, each in zip(searches, searched_ranges, strict=True)
        ]
        # Start with the slowest decoder, the last, so that nothing waits for it at the end.
        end_searches = [(*search, pair) for search, end_pairs in pairs for pair in end_pairs][::-1]
        ends = iter(list(runner.run(confirm_end, end_searches, (MOST_PROCESSES,)))[::-1])
        ranges = [
            replace_ends(each, list(islice(ends, len(end_pairs))))
            for each, (_, end_pairs) in zip(searched_ranges, pairs, strict=True)
        ]
    progress(1.0, "")
    pairs_of_ranges = zip(settings.decoders, ranges[::2], ranges[1::2], strict=True)
    return tuple(
        Limits(scene, decoder, required_rate, settings.images, settings.seed, *pair)
        for decoder, *pair in pairs_of_ranges
    )


SEARCHED_PARAMETERS = ("switching_frequency", "exposure_time")
MOST_PROCESSES = 2  # one for each parameter
_POLL_SECONDS = 0.1  # between two polls of other processes


def estimate_images(images: int, rate: float) -> int:
    """Return how many images a decoder's search along a parameter usually reads."""
    return estimate_range_images(images) + estimate_end_images(rate)


class _SearchRunner:
    """Runs searches in other processes, or in this one if they cannot be started or die."""

    def __init__(
        self,
        stack: ExitStack,
        jobs: int,
        expected: int,
        heartbeat: Heartbeat,
        progress: Callable[[float, str], object],
    ) -> None:
        self._stack, self._jobs, self._expected = stack, jobs, expected
        self._heartbeat, self._progress = heartbeat, progress
        self._pools: list[ProcessPool] = []
        self._read = 0

    def run(
        self,
        function: Callable[..., _Result],
        arguments: Sequence[tuple[Any, ...]],
        counts: Sequence[int],
    ) -> Iterator[_Result]:
        """Yield a result for each tuple of arguments, by pools of ``counts`` processes in turn."""
        from occ_model.parallel.process_pool import ProcessPool

        done = 0
        with suppress(*NO_PROCESSES, *ProcessPool.lost_by):
            pools = []
            for count in counts if self._jobs > 1 and arguments else ():
                pools.append(ProcessPool(count, __name__))
                self._stack.callback(pools[-1].close)
            self._pools += pools
            futures = [
                pool.submit(Job(function, each), 0, 1)
                for pool, each in zip(cycle(pools), arguments, strict=False)
            ]
            for each, future in zip(arguments, futures, strict=False):
                while not future.done():
                    wait([future], timeout=_POLL_SECONDS)
                    self._report(
                        self._read + sum(pool.count_heartbeats(0) for pool in self._pools), each
                    )
                yield _unwrap_result(future.result())
                done += 1
        for each in arguments[done:]:
            yield function(*each, partial(self._on_image, each))

    def _on_image(self, arguments: tuple[Any, ...]) -> None:
        self._read += 1
        self._report(self._read, arguments)

    def _report(self, read: int, arguments: tuple[Any, ...]) -> None:
        self._heartbeat()
        _, name, _, settings, *_ = arguments
        description = f"{PARAMETERS[name].in_sentence}, {settings.decoders[0]} decoder"
        self._progress(min(read / self._expected, 0.99), description)


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
