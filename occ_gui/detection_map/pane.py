"""The pane of map, limits and advice, with what measures for it."""

from PySide6.QtCore import Signal

from occ_gui.detection_map.advice_controller import AdvisorController
from occ_gui.detection_map.map_controller import DetectionMapController
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.most_bits_controller import MostBitsController
from occ_gui.detection_map.wiring import Measuring
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_model.receiver.decoders import DECODERS, QUICK_DECODERS


class MapPane(Pane[None]):
    """The map and the searches beside it, which go on while the pane is hidden."""

    went = Signal(str)
    """The user has gone to a limit of this decoder."""

    def __init__(self, scenes: SceneStore, frame_rate: FrameRate, measuring: Measuring) -> None:
        view = MapView(QUICK_DECODERS, tuple(DECODERS))
        super().__init__(view)
        self.view = view
        settings, queue = scenes.settings, measuring.queue
        self.map = DetectionMapController(scenes, settings, measuring.for_map, view, frame_rate)
        self.advisor = AdvisorController(scenes, settings, queue, measuring.for_advice, view.advice)
        self.most_bits = MostBitsController(
            scenes, frame_rate, queue, measuring.for_most, view.most_bits
        )
        view.axes_chosen.connect(self.map.choose_axes)
        view.picked.connect(self.map.go_to)
        view.pointed.connect(self.map.point_at)
        view.shown_chosen.connect(frame_rate.show)
        view.frame_rate_edited.connect(frame_rate.change)
        frame_rate.changed.connect(view.advice.use_frame_rate)
        view.advice.use_frame_rate(frame_rate.value)  # it may have been changed in another pane
        view.show_bits(frame_rate.shown, frame_rate.value)
        view.image_effects_switched.connect(self.map.use_image_effects)
        view.image_effects_switched.connect(self.advisor.use_image_effects)
        view.advice.asked.connect(self.advisor.start)
        view.advice.cards.asked.connect(self.advisor.search_in_turn)
        view.advice.cancelled.connect(self.advisor.cancel)
        view.advice.destination_chosen.connect(self.advisor.take_there)
        view.most_bits.asked.connect(self.most_bits.start)
        view.most_bits.cancelled.connect(self.most_bits.cancel)
        view.most_bits.chosen.connect(self.most_bits.go)
        for searcher in (self.most_bits, self.advisor):
            searcher.went.connect(self.went)

    def set_seen(self, seen: bool) -> None:
        """Measure the map while the pane is seen."""
        self.map.set_seen(seen)

    @property
    def is_measured(self) -> bool:
        """Whether all that is asked for is measured; nobody waits for it as for a picture."""
        return self.map.is_idle and self.advisor.is_idle and self.most_bits.is_idle

    def stop(self) -> None:
        """Stop the searches, which would look for progress in a pane that is gone."""
        for searcher in (self.advisor, self.most_bits):
            searcher.cancel()
