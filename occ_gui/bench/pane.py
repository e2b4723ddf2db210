"""The pane of the bench, with what measures for it."""

from dataclasses import replace

from occ_gui.background.signals import JobChannel
from occ_gui.bench.bench_controller import BenchController
from occ_gui.bench.bench_view import BenchView
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_model.receiver.decoders import decoders

FIRST_DECODERS = ("threshold", "equalizer", "sequence")


class BenchPane(Pane[None]):
    """The view and its controller, connected; a measurement goes on while the pane is hidden."""

    def __init__(self, scenes: SceneStore, channel: JobChannel) -> None:
        view = BenchView(decoders(), FIRST_DECODERS)
        super().__init__(view)
        self.view, self.measures = view, (channel,)
        self.controller = BenchController(scenes, channel, view)
        self.controller.choose(view.choice())
        view.choice_changed.connect(self.controller.choose)
        view.asked.connect(self.controller.start)
        view.cancelled.connect(self.controller.cancel)
        store = scenes.store
        view.frame_rate.edited.connect(
            lambda rate: store.put(replace(store.workspace, frame_rate=rate))
        )
