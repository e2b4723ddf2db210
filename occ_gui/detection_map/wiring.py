"""Wiring of the detection map, the slider strips and the advisor, which share processes."""

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.signals import WorkQueue
from occ_gui.detection_map.advice_controller import AdvisorController
from occ_gui.detection_map.map_controller import DetectionMapController
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.most_bits_controller import MostBitsController
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.slider_strip_controller import SliderStripController
from occ_gui.detection_map.worker import PRELOAD
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
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


class DetectionMapWiring(QObject):
    """The controllers, connected with their panes; they share a work queue.

    Parameters
    ----------
    scenes, settings
        What is measured.
    pane
        Shows the map and the advice.
    strips
        Show success rates along the sliders.
    frame_rate
        The pictures a second.
    """

    def __init__(
        self,
        scenes: SceneStore,
        settings: SettingsStore,
        pane: MapView,
        strips: SliderStrips,
        frame_rate: FrameRate,
    ) -> None:
        super().__init__()
        # Looked up when it is called, so that another one can be put in its place.
        self.queue = WorkQueue(5, lambda: new_workers())
        for_map, for_strips, for_advice, self.for_bench, for_most = self.queue.channels
        self.frame_rate = frame_rate
        self.map = DetectionMapController(scenes, settings, for_map, pane, self.frame_rate)
        self.slider_strips = SliderStripController(
            scenes, settings, for_strips, strips, strips.strips
        )
        self.advisor = AdvisorController(scenes, settings, self.queue, for_advice, pane.advice)
        self.most_bits = MostBitsController(
            scenes, self.frame_rate, self.queue, for_most, pane.most_bits
        )
        self._start = QTimer(self, singleShot=True)
        self._start.setInterval(START_MS)
        self._start.timeout.connect(self._begin_strips)
        strips.seen.connect(self._see_strips)
        pane.visibility_changed.connect(self.map.set_seen)
        pane.axes_chosen.connect(self.map.choose_axes)
        pane.picked.connect(self.map.go_to)
        pane.shown_chosen.connect(self.frame_rate.show)
        pane.frame_rate_edited.connect(self.frame_rate.change)
        self.frame_rate.changed.connect(pane.advice.use_frame_rate)
        pane.pointed.connect(self.map.point_at)
        pane.image_effects_switched.connect(self.map.use_image_effects)
        pane.image_effects_switched.connect(self.advisor.use_image_effects)
        pane.advice.asked.connect(self.advisor.start)
        pane.advice.cards.asked.connect(self.advisor.search_in_turn)
        pane.advice.cancelled.connect(self.advisor.cancel)
        pane.advice.destination_chosen.connect(self.advisor.take_there)
        pane.most_bits.asked.connect(self.most_bits.start)
        pane.most_bits.cancelled.connect(self.most_bits.cancel)
        pane.most_bits.chosen.connect(self.most_bits.go)

    @property
    def is_idle(self) -> bool:
        """Whether all that is seen is measured, and nothing is about to be measured."""
        parts = (self.map, self.slider_strips, self.advisor, self.most_bits)
        return not self._start.isActive() and all(part.is_idle for part in parts)

    def _begin_strips(self) -> None:
        self.slider_strips.set_seen(True)

    def _see_strips(self, seen: bool) -> None:
        if seen:
            self._start.start()
        else:
            self._start.stop()
            self.slider_strips.set_seen(False)

    def stop(self) -> None:
        """Stop measuring and end the processes."""
        self._start.stop()
        for searcher in (self.advisor, self.most_bits):
            searcher.cancel()  # it would look for progress in a pane that is gone
        self.queue.stop()
