"""Controller of the slider strips: it measures success rates along each of the main sliders."""

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import Protocol

from occ_gui.background.signals import JobChannel
from occ_gui.detection_map.rate_map import lattice
from occ_gui.detection_map.resting_controller import RateRequest, RestingController
from occ_gui.detection_map.slider_strip import IMAGES
from occ_gui.detection_map.worker import Along, left_out, measure_along, rate_settings
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Job, Stage
from occ_model.results.sweep_request import SweepPoint

POSITIONS = 29

STRIDES = (4, 1)  # distances between measured positions: a coarse strip first, then all positions
RANKS = (3, 3)  # after all points of a map that is seen, before further images of them


class SliderStripPane(Protocol):
    def show_shares(self, name: str, shares: tuple[float | None, ...]) -> None:
        """Show the fraction of correct bits at positions along a slider, None: not known."""

    def show_outdated(self, name: str, outdated: bool) -> None: ...


def strip_stages(
    missing: Mapping[str, tuple[RateRequest, set[int]]], present: RateRequest
) -> Iterator[Stage]:
    """Return the stages of the work that is left.

    ``present``: the request for the scene. Where its points take long, each is a job that a newer
    request ends; that is found out when the work begins, and holds up no slider.
    """
    slow = bool(left_out(present.scene, present.settings))
    done: set[int] = set()
    for stride, rank in zip(STRIDES, RANKS, strict=True):
        now = set(range(0, POSITIONS, stride)) - done
        done |= now
        jobs = tuple(
            _job(request, name, part)
            for name, (request, places) in missing.items()
            for part in _parts(sorted(now & places), slow)
        )
        yield Stage(rank, jobs, uninterruptible=stride == STRIDES[0] and not slow)


def _parts(places: list[int], slow: bool) -> list[list[int]]:
    if slow:
        return [[place] for place in places]
    return [places] if places else []


def _job(request: RateRequest, name: str, places: list[int]) -> Job:
    settings = rate_settings(request.settings, IMAGES, (request.decoder,), True)
    values = lattice(name, POSITIONS)
    points = tuple((place, {name: values[place]}) for place in places)
    return Job(measure_along, (request.scene, settings, name, points))


class SliderStripController(RestingController):
    """Connects the stores, the job channel and the strips.

    The strip under a slider does not change while that slider is moved. The others are measured
    once it rests: until then the cores are free for the picture that follows the slider.
    """

    def __init__(
        self, scenes: SceneStore, channel: JobChannel, pane: SliderStripPane, names: Iterable[str]
    ) -> None:
        self._pane = pane
        self._names = tuple(names)
        self._known: dict[str, tuple[RateRequest, dict[int, float | None]]] = {}
        self._missing: dict[str, tuple[RateRequest, set[int]]] = {}
        super().__init__(scenes, channel)

    def _move_on(self) -> None:
        if not self._seen:
            return
        request = self._present()
        if request == self._asked:
            return
        is_first, self._asked = self._asked is None, request
        for name in self._names:
            wanted = request.along(name)
            known = self._known.get(name)
            is_present = known is not None and known[0] == wanted
            self._pane.show_outdated(name, known is not None and not is_present)
            there = set(known[1]) if known is not None and is_present else set()
            self._missing[name] = (wanted, set(range(POSITIONS)) - there)
        if is_first:
            self._measure()
        else:
            self._resting.start()

    def _measure(self) -> None:
        request = self._asked
        if request is not None:
            missing, self._missing = self._missing, {}
            self._channel.put(request, partial(strip_stages, missing, request))

    def _take(self, request: RateRequest, results: list[Along]) -> None:
        for result in results:
            wanted = request.along(result.name)
            known = self._known.get(result.name)
            if known is None or known[0] != wanted:
                known = self._known[result.name] = (wanted, {})
            known[1].update({point.index: _share(point) for point in result.points})
        for name in {result.name for result in results}:
            wanted, shares = self._known[name]
            self._pane.show_outdated(name, wanted != self._present().along(name))
            self._pane.show_shares(name, tuple(_nearest(shares, p) for p in range(POSITIONS)))


def _share(point: SweepPoint) -> float | None:
    return point.right[0] / point.sent if point.sent else None


def _nearest(shares: Mapping[int, float | None], place: int) -> float | None:
    """Return a position's fraction, or that of the known one on the coarser lattice beside it."""
    if place in shares:
        return shares[place]
    return shares.get(round(place / STRIDES[0]) * STRIDES[0])
