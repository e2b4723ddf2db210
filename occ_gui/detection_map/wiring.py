"""BackgroundRates: the worker processes of map, strips, advice and bench, and their channels."""

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.scene.scene_store import SceneStore

if TYPE_CHECKING:
    from occ_gui.background.signals import JobChannel, WorkQueue
    from occ_gui.detection_map.slider_strip_controller import (
        SceneRateController,
        SliderStripController,
    )
    from occ_model.parallel.job import Workers

PROCESSES = 2

CHANNELS = ("map", "advice", "bench", "most bits", "strips", "scene rate")
"""Users of the worker processes, each with a channel of its own."""

NICENESS = 10  # niceness of the worker processes, so that the window comes first

START_MS = 400
"""Milliseconds that the strips wait at first, so that the window and its picture come first."""


def new_workers() -> "Workers":
    # Imported only now, because it takes time.
    from occ_gui.detection_map.worker import PRELOAD
    from occ_model.parallel.process_pool import ProcessPool

    return ProcessPool(PROCESSES, PRELOAD, NICENESS)


class BackgroundRates(QObject):
    """Measures success rates in worker processes, which are started when first needed.

    The strips of the sliders and the rate of the present scene are measured from the start; map,
    advice and bench use channels of the same processes.
    """

    rate_changed = Signal(object)
    """The rate of the present scene, an :class:`SceneRate`; None if unknown."""

    def __init__(
        self, scenes: SceneStore, strips: SliderStrips, may_begin: Callable[[], bool]
    ) -> None:
        super().__init__()
        self._may_begin, self._was_ready = may_begin, False
        self._scenes, self._strips = scenes, strips
        self._start_timer = QTimer(self, singleShot=True)
        self._start_timer.setInterval(START_MS)
        self._start_timer.timeout.connect(self._begin)
        strips.visibility_changed.connect(self._follow_strips)

    @cached_property
    def queue(self) -> "WorkQueue":
        from occ_gui.background.signals import WorkQueue

        # Looked up when it is called, so that tests can replace it.
        return WorkQueue(len(CHANNELS), lambda: new_workers())

    def channel(self, user: str) -> "JobChannel":
        return self.queue.channels[CHANNELS.index(user)]

    @cached_property
    def slider_strips(self) -> "SliderStripController":
        from occ_gui.detection_map.slider_strip_controller import SliderStripController

        return SliderStripController(self._scenes, self.channel("strips"), self._strips)

    @cached_property
    def scene_rate(self) -> "SceneRateController":
        from occ_gui.detection_map.slider_strip_controller import SceneRateController

        controller = SceneRateController(self._scenes, self.channel("scene rate"))
        controller.changed.connect(self._strips.show_present_rate)
        controller.changed.connect(self.rate_changed)
        return controller

    @property
    def is_idle(self) -> bool:
        if self._start_timer.isActive():
            return False
        return "scene_rate" not in vars(self) or (
            self.slider_strips.is_idle and self.scene_rate.is_idle
        )

    def _begin(self) -> None:
        # Not in the event that delivers the picture, so that it is painted first.
        was_ready, self._was_ready = self._was_ready, self._may_begin()
        if was_ready and self._was_ready:
            self._set_visible(True)
        else:
            self._start_timer.start()

    def _set_visible(self, is_visible: bool) -> None:
        self.slider_strips.set_visible(is_visible)
        self.scene_rate.set_visible(is_visible)

    def _follow_strips(self, is_visible: bool) -> None:
        if is_visible:
            self._start_timer.start()
            return
        self._start_timer.stop()
        if "scene_rate" in vars(self):
            self._set_visible(False)

    def stop(self) -> None:
        self._start_timer.stop()
        if "queue" in vars(self):
            self.queue.stop()
