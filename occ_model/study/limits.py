"""The limits between which decoders read a scene: of switching frequency and exposure time.

Each is searched by itself, see :mod:`occ_model.study.working_range`, and does not depend on the
other: two processes find the same answer in half of the time. All decoders read the same pictures,
so that one process searches along one parameter for all of them.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import wait
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial
from itertools import cycle, islice
from typing import TYPE_CHECKING, Any, TypeVar

from occ_model.errors import ParameterError, shown
from occ_model.parallel.job import NO_PROCESSES, Heartbeat, Job, JobResult
from occ_model.results.advice import Advice, TheoryLimits
from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.limits import Limits
from occ_model.results.sweep_request import RateSettings, SignalPath
from occ_model.scene.argument_checks import check_count, is_number
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import TOLERANCE, SimulationSettings
from occ_model.study import theory
from occ_model.study.cause.cause import cause_of
from occ_model.study.cause.timing import reads_two_headers
from occ_model.study.success_rate import check_rate
from occ_model.study.sure_ends import images_about_an_end, pairs_of, sure_end, with_ends
from occ_model.study.working_range import READ_RATE, expected_images, working_range

if TYPE_CHECKING:
    from occ_model.parallel.process_pool import ProcessPool

_Answer = TypeVar("_Answer")


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
    progress: Callable[[float, str], object] = lambda _fraction, _what: None,
) -> Limits:
    """Find the switching frequencies and the exposure times at which a decoder reads a scene.

    Each answer is a list of intervals: success need not fall steadily, and beyond a null stripes
    come back. A gap narrower than a step of ``STEP`` can be missed. The outermost ends and those of
    the scene's own interval are found by bisection, and each end is confirmed by images that have
    not chosen it. A bisected end has a 95 % interval, see :mod:`occ_model.study.sure_ends`.

    Parameters
    ----------
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
        Called with the completed fraction of the search, from 0 to 1, and its present object.

    Raises
    ------
    ParameterError
        The rate is not from above 0 to 100 %, or another argument is not allowed.
    ProjectionError
        The scene has no picture.
    """
    settings = RateSettings(images, (decoder,), seed, tolerance, force or {}, path)
    (found,) = limits_of(scene, settings, rate, jobs=jobs, heartbeat=heartbeat, progress=progress)
    return found


def limits_of(
    scene: Scene,
    settings: RateSettings,
    rate: float,
    *,
    jobs: int = 1,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float, str], object] = lambda _fraction, _what: None,
) -> tuple[Limits, ...]:
    """Find the limits of several decoders, as :func:`limits` does for each of them."""
    wanted = _checked(rate)
    check_count("jobs", jobs, 1, MOST_PROCESSES)
    asked = []
    for decoder in settings.decoders:
        own = replace(settings, decoders=(decoder,))
        check_rate(scene, own)
        asked += [(scene, name, wanted, own) for name in SEARCHED]
    usual = len(asked) * usual_images(settings.images, wanted)
    with ExitStack() as stack:
        ways = _Ways(stack, jobs, usual, heartbeat, progress)
        searched = list(ways.answers(working_range, asked, (1,) * len(SEARCHED)))
        pairs = [(one, pairs_of(each)) for one, each in zip(asked, searched, strict=True)]
        # The slowest decoder, which is the last, first: nothing else waits for it then.
        again = [(*one, pair) for one, several in pairs for pair in several][::-1]
        ends = iter(list(ways.answers(sure_end, again, (MOST_PROCESSES,)))[::-1])
        ranges = [
            with_ends(each, list(islice(ends, len(several))))
            for each, (_, several) in zip(searched, pairs, strict=True)
        ]
    progress(1.0, "")
    pairs_of_ranges = zip(settings.decoders, ranges[::2], ranges[1::2], strict=True)
    return tuple(
        Limits(scene, one, wanted, settings.images, settings.seed, *pair)
        for one, *pair in pairs_of_ranges
    )


SEARCHED = ("switching_frequency", "exposure_time")  # the parameters whose limits are searched
MOST_PROCESSES = 2  # processes that search: one along each parameter
_POLL_SECONDS = 0.1  # between two polls of other processes


def usual_images(images: int, rate: float) -> int:
    """Return how many images a decoder's search along a parameter usually reads."""
    return expected_images(images) + images_about_an_end(rate)


class _Ways:
    """Work is done in other processes, or here where these cannot be had or are lost."""

    def __init__(
        self,
        stack: ExitStack,
        jobs: int,
        usual: int,
        heartbeat: Heartbeat,
        progress: Callable[[float, str], object],
    ) -> None:
        self._stack, self._jobs, self._usual = stack, jobs, usual
        self._heartbeat, self._progress = heartbeat, progress
        self._pools: list[ProcessPool] = []
        self._read = 0

    def answers(
        self, work: Callable[..., _Answer], asked: Sequence[tuple[Any, ...]], counts: Sequence[int]
    ) -> Iterator[_Answer]:
        """Yield the answers to requests, which pools of so many processes take in turn."""
        from occ_model.parallel.process_pool import ProcessPool

        done = 0
        with suppress(*NO_PROCESSES, *ProcessPool.lost_by):
            pools = []
            for count in counts if self._jobs > 1 and asked else ():
                pools.append(ProcessPool(count, __name__))
                self._stack.callback(pools[-1].close)
            self._pools += pools
            futures = [
                pool.submit(Job(work, each), 0, 1)
                for pool, each in zip(cycle(pools), asked, strict=False)
            ]
            for each, future in zip(asked, futures, strict=False):
                while not future.done():
                    wait([future], timeout=_POLL_SECONDS)
                    self._look(self._read + sum(pool.counted(0) for pool in self._pools), each)
                yield _value_of(future.result())
                done += 1
        for each in asked[done:]:
            yield work(*each, partial(self._on_image, each))

    def _on_image(self, asked: tuple[Any, ...]) -> None:
        self._read += 1
        self._look(self._read, asked)

    def _look(self, read: int, asked: tuple[Any, ...]) -> None:
        self._heartbeat()
        self._progress(min(read / self._usual, 0.99), _what(asked))


def _value_of(result: JobResult) -> Any:
    if result.error is not None:
        raise result.error
    return result.value


def _what(asked: tuple[Any, ...]) -> str:
    return f"{PARAMETERS[asked[1]].in_sentence}, {asked[3].decoders[0]} decoder"


def _checked(rate: object) -> float:
    if not is_number(rate) or not 0.0 < rate <= 100.0:
        raise ParameterError.of("rate", f"{shown(rate)} %", "above 0 % to 100 %")
    return float(rate)


def advice_of(limits: Limits) -> Advice:
    """Return the limits found by trial, those of theory, and why the scene itself is not read."""
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
