"""The pane of map, limits and advice, with the controllers that measure for it."""

from dataclasses import replace

from occ_gui.detection_map.map_controller import DetectionMapController
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.search_controller import AdvisorController, MostBitsController
from occ_gui.detection_map.wiring import BackgroundRates
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_model.receiver.decoders import DECODERS, QUICK_DECODERS


class MapPane(Pane[None]):
    """The map, and the searches for limits, which go on while the pane is hidden."""

    def __init__(self, scenes: SceneStore, background_rates: BackgroundRates) -> None:
        view = MapView(QUICK_DECODERS, tuple(DECODERS))
        super().__init__(view)
        self.view = view
        store, queue = scenes.store, background_rates.queue
        of_map, of_advice, of_most = map(background_rates.channel, ("map", "advice", "most bits"))
        self.map = DetectionMapController(scenes, of_map, view)
        self.advisor = AdvisorController(scenes, queue, of_advice, view.advice)
        self.most_bits = MostBitsController(scenes, queue, of_most, view.most_bits)
        self.measures = (of_map, of_advice, of_most)
        view.axes_chosen.connect(self.map.choose_axes)
        view.plots.picked.connect(self.map.go_to)
        view.plots.pointed.connect(self.map.point_at)
        view.shown.chosen.connect(lambda what: store.put(replace(store.workspace, shown=what)))
        view.frame_rate.edited.connect(
            lambda rate: store.put(replace(store.workspace, frame_rate=rate))
        )
        rate = store.select(lambda workspace: workspace.frame_rate)
        rate.changed.connect(view.advice.use_frame_rate)
        view.advice.use_frame_rate(rate.value)  # another pane may have changed it
        view.show_bits(store.workspace.shown, rate.value)
        view.image_effects.toggled.connect(self.map.use_image_effects)
        view.image_effects.toggled.connect(self.advisor.use_image_effects)
        view.advice.asked.connect(self.advisor.start)
        view.advice.cards.asked.connect(self.advisor.search_in_turn)
        view.advice.cancelled.connect(self.advisor.cancel)
        view.advice.destination_chosen.connect(self.advisor.go_to_limit)
        view.most_bits.asked.connect(self.most_bits.start)
        view.most_bits.cancelled.connect(self.most_bits.cancel)
        view.most_bits.chosen.connect(self.most_bits.go)

    def set_seen(self, seen: bool) -> None:
        self.map.set_seen(seen)
