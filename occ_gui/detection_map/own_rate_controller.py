"""Controller of the rate at the scene's own values: of pictures that begin at any time."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtCore import Signal

from occ_gui.background.signals import JobChannel
from occ_gui.detection_map.resting_controller import RateRequest, RestingController
from occ_gui.detection_map.worker import UNSEEN, rate_settings
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Job, Stage
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.sweep.points import MeasuredPoints, measure_points

IMAGES = 20  # pictures of which the rate is: as many as those of the limits
_RANK = 1  # after a first answer of the map, before all else


@dataclass(frozen=True, slots=True)
class OwnRate:
    """The fraction of right bits, from 0 to 1, with its 95 % interval, in so many pictures."""

    share: float
    low: float
    high: float
    images: int
    whole: int


class OwnRateController(RestingController):
    """Measures the rate of the present scene once it rests, while it is seen."""

    changed = Signal(object)
    """The rate, an :class:`OwnRate`; None where it is not known of the present scene."""

    def __init__(self, scenes: SceneStore, channel: JobChannel) -> None:
        super().__init__(scenes, channel)
        self.rate: OwnRate | None = None

    def _forget(self) -> None:
        super()._forget()
        self._show(None)

    def _show(self, rate: OwnRate | None) -> None:
        if rate != self.rate:
            self.rate = rate
            self.changed.emit(rate)

    def _move_on(self) -> None:
        present = self._present()
        request = replace(present, scene=present.scene.replace(**UNSEEN))
        if not self._seen or request == self._asked:
            return
        self._channel.cancel()
        self._forget()
        self._asked = request
        self._resting.start()

    def _measure(self) -> None:
        if self._asked is not None:
            self._channel.put(self._asked, partial(own_rate_stages, self._asked))

    def _take(self, request: RateRequest, results: list[MeasuredPoints]) -> None:
        if request == self._asked and results:
            self._show(own_rate(results[-1]))


def own_rate_stages(request: RateRequest) -> Iterator[Stage]:
    settings = rate_settings(request.settings, IMAGES, (request.decoder,), True)
    yield Stage(_RANK, (Job(measure_points, (request.scene, settings, ((0, {}),))),))


def own_rate(measured: MeasuredPoints) -> OwnRate | None:
    """Return the rate of a single point; None where the model refuses it."""
    (point,) = measured.points
    if not point.sent:
        return None
    low, high = interval_of_pictures(point.right[0], point.sent, measured.images)
    share, (whole,) = point.right[0] / point.sent, point.whole
    return OwnRate(share, low / 100.0, high / 100.0, measured.images, whole)
