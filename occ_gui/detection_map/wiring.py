"""Measuring: the processes that map, strips, advice and bench share, and the strips themselves."""

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.signals import WorkQueue
from occ_gui.detection_map.own_rate_controller import OwnRateController
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.slider_strip_controller import SliderStripController
from occ_gui.detection_map.worker import PRELOAD
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Workers

PROCESSES = 2

NICENESS = 10
"""How far the processes yield to the window."""

START_MS = 400
"""Milliseconds that the strips wait at first: the window and its first picture come before them."""


def new_workers() -> Workers:
    """Make the worker processes."""
    # Importing what starts processes takes time.
    from occ_model.parallel.process_pool import ProcessPool

    return ProcessPool(PROCESSES, PRELOAD, NICENESS)


class Measuring(QObject):
    """Channels of work in processes; the strips along the sliders use one from the start."""

    def __init__(self, scenes: SceneStore, strips: SliderStrips) -> None:
        super().__init__()
        # Looked up when it is called, so that another one can be put in its place.
        self.queue = WorkQueue(6, lambda: new_workers())
        self.for_map, for_strips, self.for_advice, self.for_bench, self.for_most, for_own = (
            self.queue.channels
        )
        self.own_rate = OwnRateController(scenes, scenes.settings, for_own)
        self.own_rate.changed.connect(strips.show_present)
        self.slider_strips = SliderStripController(
            scenes, scenes.settings, for_strips, strips, strips.strips
        )
        self._start = QTimer(self, singleShot=True)
        self._start.setInterval(START_MS)
        self._start.timeout.connect(self._begin_strips)
        strips.seen.connect(self._see_strips)

    @property
    def is_idle(self) -> bool:
        """Whether all that is seen is measured, and nothing is about to be."""
        parts = (self.slider_strips, self.own_rate)
        return not self._start.isActive() and all(part.is_idle for part in parts)

    def _begin_strips(self) -> None:
        self.slider_strips.set_seen(True)
        self.own_rate.set_seen(True)

    def _see_strips(self, seen: bool) -> None:
        if seen:
            self._start.start()
        else:
            self._start.stop()
            self.slider_strips.set_seen(False)
            self.own_rate.set_seen(False)

    def stop(self) -> None:
        """Stop measuring and end the processes."""
        self._start.stop()
        self.queue.stop()
